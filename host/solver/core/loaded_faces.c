#include "loaded_faces.h"
#include "../../../preprocess/domain/set_share.h"
#include "../../base/memory.h"
#include <string.h>

/* Where the scene asks for this set; NULL: it does not. */
static const brc_predicate *asked_for(const brc_scene *scene, const brc_set *set)
{
    for (int32_t k = 0; k < scene->n_sets; ++k)
        if (scene->sets[k].kind == set->kind &&
            strncmp(scene->sets[k].name, set->name, sizeof scene->sets[k].name) == 0)
            return &scene->sets[k].where;
    return NULL;
}

brc_status brc_loaded_faces(brc_context *context, const brc_scene *scene, const brc_domain *domain, const brc_set *set,
                            brc_loaded_face **out, int64_t *n)
{
    const brc_predicate *where = asked_for(scene, set);
    const bool cuts = where && brc_predicate_cuts(where);
    const int64_t most = cuts ? domain->n_free_faces : set->n_members;
    *n = 0;
    BRC_TRY(BRC_ALLOCATE(context, out, most, "loaded faces"));
    for (int64_t k = 0; k < most; ++k) {
        const int64_t f = cuts ? k : set->members[k];
        brc_loaded_face *face = *out + *n;
        if (cuts && brc_predicate_share(where, domain, f, face->area, face->centroid) == 0) continue;
        face->face = (int32_t)f;
        *n += 1;
        if (cuts) continue;
        memcpy(face->area, domain->free_area_vector + 3 * f, sizeof face->area);
        memcpy(face->centroid, domain->free_centroid + 3 * f, sizeof face->centroid);
    }
    return BRC_OK;
}
