/* Every kernel, in one translation unit: what an instance of the C builds and an OpenCL program are made of. */
#include "core/portable.h"
#include "core/records.h"
#include "core/svec.h"
#include "models/dlsm/elastic_svk.h"
#include "models/dlsm/dlsm_gradient.h"
#include "models/dlsm/dlsm_compaction.h"
#include "models/dlsm/dlsm_flux.h"
#include "models/dlsm/dlsm_bond.h"
#include "core/quaternion.h"
#include "core/rigid.h"
#include "models/published/published_bond.h"
#include "models/cbm/cbm_beam.h"
#include "effects/fracture/failure.h"
#include "effects/fracture/failure_bound.h"
#include "models/dlsm/cell_normal.h"
#include "effects/contact/convex_body.h"
#include "effects/contact/convex_overlap.h"
#include "effects/contact/contact_law.h"
#include "effects/contact/contact_sift.h"
#include "effects/contact/convex_wall.h"
#include "effects/contact/convex_sphere.h"
#include "effects/fracture/softening.h"
#include "models/dlsm/sliding.h"
#include "statics/multigrid_bond.h"
#include "models/dlsm/closed_face.h"
#include "core/vector.cl"
#include "core/motion.cl"
#include "effects/gravity.cl"
#include "effects/damping.cl"
#include "effects/guard.cl"
#include "core/rotation.cl"
#include "effects/loads/element_loads.cl"
#include "statics/precondition.cl"
#include "effects/strikers/strikers.cl"
#include "core/members.cl"
#include "statics/multigrid.cl"
#include "models/dlsm/dlsm.cl"
#include "models/dlsm/dlsm_faces.cl"
#include "models/published/published.cl"
#include "models/cbm/cbm.cl"
#include "effects/fracture/fracture.cl"
#include "effects/fracture/cells.cl"
#include "models/dlsm/dlsm_elements.cl"
#include "models/dlsm/dlsm_held.cl"
#include "core/scan.cl"
#include "core/rings.cl"
#include "models/dlsm/rims.cl"
#include "effects/contact/contact_place.cl"
#include "effects/contact/contact_motion.cl"
#include "effects/contact/contact_search.cl"
#include "effects/contact/contact.cl"
#include "effects/fracture/cell_criteria.cl"
#include "models/dlsm/dlsm_record.cl"
#include "models/published/published_breaks.cl"
#include "effects/contact/contact_cells.cl"
#include "effects/contact/contact_rigid.cl"
#include "models/dlsm/softening_record.cl"
#include "models/dlsm/softening_face.cl"
#include "models/dlsm/softening.cl"
#include "models/dlsm/softening_screen.cl"
#include "models/dlsm/softening_interfaces.cl"
#include "models/dlsm/softening_onset.cl"
#include "models/dlsm/brittle_interfaces.cl"
#include "models/dlsm/closed_faces.cl"
#include "models/cbm/beam_carried.h"
#include "models/cbm/beam_softening.cl"
#include "models/cbm/beam_onset.cl"
#include "models/cbm/beam_alone.cl"
#include "models/cbm/beam_bridges.cl"
#include "models/cbm/beam_closure.cl"
#include "models/cbm/cbm_breaks.cl"

/* Passes are compiled twice from one text: over all elements ... */
#define PASS(name) name
#define PASS_ITEMS int n_items
#define PASS_MEMBERS(item, row_start) members_of_group(item, row_start)
#define PASS_ELEMENT(item, l) ((item)*W + (l))
#include "models/dlsm/dlsm_passes.cl"
#include "models/dlsm/softening_passes.cl"
#include "models/published/published_passes.cl"
#undef PASS
#undef PASS_ITEMS
#undef PASS_MEMBERS
#undef PASS_ELEMENT
/* ... and, `_listed` behind their names, over the n elements of a list, whose last stands in for those behind it. */
#define PASS(name) name##_listed
#define PASS_ITEMS int n_items, int n, OWN(int) list
#define PASS_MEMBERS(item, row_start) members_of_list(item, n, list, row_start)
#define PASS_ELEMENT(item, l) list[(item)*W + (l) < n ? (item)*W + (l) : n - 1]
#include "models/dlsm/dlsm_passes.cl"
#include "models/dlsm/softening_passes.cl"
#include "models/published/published_passes.cl"
#undef PASS
#undef PASS_ITEMS
#undef PASS_MEMBERS
#undef PASS_ELEMENT
