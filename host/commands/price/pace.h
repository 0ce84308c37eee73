/* The price of explicit dynamics on the elements of a run, whatever the run itself did with them. */
#ifndef BRC_COMMANDS_PACE_H
#define BRC_COMMANDS_PACE_H

#include "../reproduce/reproduce.h"

/* Seconds of a device: processor time of a cpu device with one thread, which other programs on the machine do not
 * lengthen; else wall time. */
bool brc_pace_is_processor(const brc_device_request *device); /* the former */
double brc_pace_clock_s(const brc_device_request *device);
/* What that clock showed when the program began, had it never waited since: loading it (its libraries: some 30 ms) is
 * part of what a run takes. */
double brc_pace_start_s(const brc_device_request *device);
const char *brc_pace_clock_name(const brc_device_request *device);
/* Step a simulation of the same scene and domain, its own on a device of its own, without loads, for a tenth of a
 * second or more at 0.8 of the critical step (a last stage that is dynamic: at its own rule) and add pace_bond_update
 * (seconds of a bond update), pace_step (the time step), pace_crossing (time in which a pressure wave runs the longest
 * edge of the domain's box; of the first material) and pace_spacing (mean spacing over that edge). */
brc_status brc_pace_values(brc_context *context, brc_simulation *simulation, const brc_device_request *device,
                           brc_outcome *outcome);

#endif
