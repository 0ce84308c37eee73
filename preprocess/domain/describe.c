/* Text grows as it is written, so that a shape of any number of parts is told in full. */
#include "describe.h"

#include "../../host/base/memory.h"
#include "../../host/base/version.h"
#include "../shapes/shape_type.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct text {
    brc_context *context;
    char *start;
    int64_t length, room;
    brc_status status;
} text;

static void say(text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void say(text *t, const char *format, ...)
{
    char piece[1024];
    va_list arguments;
    va_start(arguments, format);
    const int written = vsnprintf(piece, sizeof piece, format, arguments);
    va_end(arguments);
    const int64_t n = written < (int)sizeof piece ? written : (int)sizeof piece - 1;
    if (t->status == BRC_OK && t->length + n + 1 > t->room) {
        t->room = 2 * (t->length + n + 1);
        t->status = brc_memory_resize(t->context, (void **)&t->start, t->room, 1, "provenance");
    }
    if (t->status != BRC_OK) return;
    memcpy(t->start + t->length, piece, (size_t)n + 1);
    t->length += n;
}

static void say_leaf(text *t, const brc_shape *s)
{
    char words[768];
    brc_shape_type_of(s->kind)->words(s, words, sizeof words);
    say(t, "%s", words);
    say(t, " at (%.17g, %.17g, %.17g) m", s->origin[0], s->origin[1], s->origin[2]);
}

static void say_pose(text *t, const double translation[3], const double rotation[3])
{
    say(t, "translation (%.17g, %.17g, %.17g) m, rotation (%.17g, %.17g, %.17g) rad", translation[0], translation[1],
        translation[2], rotation[0], rotation[1], rotation[2]);
}

static void say_shape(text *t, const brc_shape *s)
{
    static const char *const role[] = {"add", "remove", "keep"};
    if (s->kind != BRC_SHAPE_PARTS) {
        say_leaf(t, s);
        return;
    }
    for (int32_t p = 0; p < s->n_parts; ++p) {
        const brc_shape_part *part = &s->parts[p];
        say(t, "%s%s ", p > 0 ? ", " : "", role[part->role]);
        say_leaf(t, &part->shape);
        say(t, " ");
        say_pose(t, part->translation, part->rotation);
    }
}

static void say_fill(text *t, const brc_fill *f, const brc_grid *grid)
{
    const unsigned long long seed = f->seed;
    switch (f->kind) {
    case BRC_FILL_NOISY_GRID:
        say(t, "noisy grid %lld x %lld x %lld, spread %.17g, seed %llu", (long long)grid->cells[0],
            (long long)grid->cells[1], (long long)grid->cells[2], f->spread, seed);
        break;
    case BRC_FILL_PACKING:
        say(t, f->cut ? "packing of spheres cut by the walls, " : "packing of spheres, ");
        if (f->n_radii > 0)
            say(t, "radii by a table of %d points from %.17g to %.17g, ", f->n_radii, f->radii[0].radius,
                f->radii[f->n_radii - 1].radius);
        else
            say(t, "radii spread by %.17g, ", f->radius_spread);
        if (f->coordination > 0.0)
            say(t, "coordination number %.17g", f->coordination);
        else
            say(t, "volume fraction %.17g", f->volume_fraction);
        say(t, ", seed %llu", seed);
        break;
    case BRC_FILL_POINTS: say(t, "points of %s, %.17g m per unit", f->file, f->scale); break;
    }
    say(t, ", %d Lloyd sweeps", f->lloyd_sweeps);
}

brc_status brc_describe(brc_context *context, const brc_build_request *request, const brc_grid *grid,
                        brc_domain *domain)
{
    text t = {.context = context, .status = BRC_OK};
    say(&t, "breccia %s; ", brc_version());
    say_shape(&t, &request->shape);
    say(&t, "; ");
    say_fill(&t, &request->fill, grid);
    if (request->beams > 0.0) say(&t, "; beams, coordination number %.17g", request->beams);
    if (request->n_cracks > 0) say(&t, "; %d cracks", request->n_cracks);
    if (request->grains.n > 0 || request->grains.size > 0.0)
        say(&t, "; grains, seed %llu", (unsigned long long)request->grains.seed);
    say(&t, "; ");
    say_pose(&t, request->translation, request->rotation);
    if (request->beams == 0.0) say(&t, "; Voro++ 0.4.6");
    domain->provenance = t.start;
    return t.status;
}
