/* Output that contradicts itself. */
#include "reader_internal.h"
#include <string.h>

void brc_reader_check_output(brc_reader *reader)
{
    const brc_output *output = &reader->scene->output;
    const double *from = output->picture_from;
    if (!output->has_picture_camera) return;
    if (strcmp(output->picture_view, "corner") != 0)
        COMPLAIN(reader, output->picture_view, output,
                 "view: `camera` says already where the viewer stands; leave out one of them");
    if (memcmp(from, output->picture_towards, sizeof output->picture_from) == 0)
        COMPLAIN(reader, output->picture_from, output,
                 "from: is the point looked at ([%g, %g, %g] m), which gives no direction; move it or `towards`",
                 from[0], from[1], from[2]);
}
