/* Interfaces whose faces break at once (brittle_interfaces.cl). Where there is none every function here does
 * nothing. */
#ifndef BRC_SOLVER_BRITTLE_INTERFACES_H
#define BRC_SOLVER_BRITTLE_INTERFACES_H

#include "../../effects/fracture/breaking.h"

extern const brc_field_table brc_brittle_interface_fields;

/* Arrays and kernels, once the limits of bonds are there. BRC_NO_MEMORY. */
brc_status brc_brittle_interfaces_create(brc_simulation *s);
void brc_brittle_interfaces_free(brc_simulation *s);

/* Their normals `along`, where `joined`, under `outer`, which must outlive it. */
brc_scope brc_scope_of_brittle_interfaces(const brc_simulation *s, const brc_scope *outer);

/* More marks, after those by the normal stress; more in ratio [n_rows], as brc_model_breaking says. */
brc_status brc_brittle_interfaces_mark(brc_simulation *s, double share);
/* Of criteria of elements: only those that others pushed, as brc_model_breaking.mark_beside says. */
brc_status brc_brittle_interfaces_follow(brc_simulation *s);
brc_status brc_brittle_interfaces_ratio(brc_simulation *s, brc_buffer *ratio);

#endif
