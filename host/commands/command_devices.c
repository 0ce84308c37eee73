/* breccia devices: what can run here. */
#include "command.h"
#include "../device/device_list.h"

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    (void)arguments;
    brc_device_list *list;
    BRC_TRY(brc_device_list_create(session->context, &list));
    brc_device_list_print(list, stdout);
    brc_device_list_free(&list);
    return BRC_OK;
}

const brc_command brc_command_devices = {.name = "devices",
                                         .operands = "",
                                         .summary = "what can run here, and which device `auto` takes and why",
                                         .details = "",
                                         .run = run};
