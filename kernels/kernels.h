/* Every kernel, in one translation unit: what an instance of the C builds and an OpenCL program are made of. */
#include "portable.h"
#include "records.h"
#include "svec.h"
#include "elastic_svk.h"
#include "dlsm_gradient.h"
#include "dlsm_compaction.h"
#include "dlsm_flux.h"
#include "dlsm_bond.h"
#include "quaternion.h"
#include "rigid.h"
#include "published_bond.h"
#include "cbm_beam.h"
#include "failure.h"
#include "failure_bound.h"
#include "cell_normal.h"
#include "convex_body.h"
#include "convex_overlap.h"
#include "contact_law.h"
#include "contact_sift.h"
#include "convex_wall.h"
#include "convex_sphere.h"
#include "softening.h"
#include "sliding.h"
#include "multigrid_bond.h"
#include "closed_face.h"
#include "vector.cl"
#include "motion.cl"
#include "guard.cl"
#include "rotation.cl"
#include "strikers.cl"
#include "members.cl"
#include "multigrid.cl"
#include "dlsm.cl"
#include "dlsm_faces.cl"
#include "published.cl"
#include "cbm.cl"
#include "fracture.cl"
#include "cells.cl"
#include "scan.cl"
#include "rings.cl"
#include "rims.cl"
#include "contact_place.cl"
#include "contact_motion.cl"
#include "contact_search.cl"
#include "contact.cl"
#include "cell_criteria.cl"
#include "published_breaks.cl"
#include "contact_cells.cl"
#include "contact_rigid.cl"
#include "softening_record.cl"
#include "softening.cl"
#include "softening_onset.cl"
#include "closed_faces.cl"
#include "beam_carried.h"
#include "beam_softening.cl"
#include "beam_closure.cl"

/* Passes are compiled twice from one text: over all elements ... */
#define PASS(name) name
#define PASS_ITEMS int n_items
#define PASS_MEMBERS(item, row_start) members_of_group(item, row_start)
#define PASS_ELEMENT(item, l) ((item)*W + (l))
#include "dlsm_passes.cl"
#include "published_passes.cl"
#undef PASS
#undef PASS_ITEMS
#undef PASS_MEMBERS
#undef PASS_ELEMENT
/* ... and, `_listed` behind their names, over the n elements of a list, whose last stands in for those behind it. */
#define PASS(name) name##_listed
#define PASS_ITEMS int n_items, int n, OWN(int) list
#define PASS_MEMBERS(item, row_start) members_of_list(item, n, list, row_start)
#define PASS_ELEMENT(item, l) list[(item)*W + (l) < n ? (item)*W + (l) : n - 1]
#include "dlsm_passes.cl"
#include "published_passes.cl"
#undef PASS
#undef PASS_ITEMS
#undef PASS_MEMBERS
#undef PASS_ELEMENT
