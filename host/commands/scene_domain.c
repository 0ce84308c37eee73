/* From what a scene asks to a domain. */
#include "scene_domain.h"
#include "../../preprocess/domain_file.h"
#include "../../preprocess/pose.h"
#include "../../preprocess/sets.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <string.h>

static brc_status read_body(brc_context *context, const brc_scene *scene, int32_t index, brc_domain **out)
{
    const brc_body *body = &scene->bodies[index];
    char *path = NULL;
    if (body->domain_file[0] != '/') BRC_TRY(brc_file_join(context, scene->folder, body->domain_file, &path));
    const brc_status status = brc_domain_read(context, path ? path : body->domain_file, out);
    brc_memory_free(path);
    if (status != BRC_OK) return status;
    for (int64_t e = 0; e < (*out)->n_elements; ++e)
        (*out)->body[e] = index;
    for (int64_t e = 0; e < (*out)->n_elements; ++e)
        if ((*out)->region[e] < 0 || (*out)->region[e] > body->n_regions)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "body '%s': %s holds region %d, the scene gives the body %d region(s); state them as when the "
                            "file was built", body->name, body->domain_file, (*out)->region[e], body->n_regions);
    brc_pose_apply(body->shape.origin, body->rotation, body->translation, *out);
    return BRC_OK;
}

static brc_status make_body(brc_context *context, const brc_scene *scene, int32_t index, int n_threads, brc_domain **out)
{
    const brc_body *body = &scene->bodies[index];
    if (body->domain_file[0]) return read_body(context, scene, index, out);
    brc_build_request request = {.shape = body->shape, .fill = body->fill, .n_regions = body->n_regions,
                                 .tiny_face_threshold = body->tiny_face_threshold, .n_threads = n_threads, .body = index};
    memcpy(request.translation, body->translation, sizeof request.translation);
    memcpy(request.rotation, body->rotation, sizeof request.rotation);
    brc_predicate *regions;
    BRC_TRY(BRC_ALLOCATE(context, &regions, body->n_regions, "regions of a body"));
    for (int32_t r = 0; r < body->n_regions; ++r)
        regions[r] = body->regions[r].where;
    request.regions = regions;
    const brc_status status = brc_domain_build(context, &request, out);
    brc_memory_free(regions);
    return status;
}

/* Make the sets of the scene on the finished domain and keep those it has that the scene does not name. */
static brc_status name_sets(brc_context *context, const brc_scene *scene, brc_domain *domain)
{
    brc_set *old = domain->sets;
    const int32_t n_old = domain->n_sets;
    domain->sets = NULL;
    domain->n_sets = 0;
    brc_status status = brc_sets_build(context, scene->n_sets, scene->sets, domain);
    if (status == BRC_OK)
        status = brc_memory_resize(context, (void **)&domain->sets, (int64_t)domain->n_sets + n_old, sizeof *domain->sets, "sets");
    for (int32_t s = 0; s < n_old; ++s) {
        if (status == BRC_OK && brc_domain_find_set(domain, old[s].name) < 0) {
            domain->sets[domain->n_sets++] = old[s];
            continue;
        }
        brc_memory_free(old[s].name);
        brc_memory_free(old[s].members);
    }
    brc_memory_free(old);
    return status;
}

brc_status brc_scene_domain_build(brc_context *context, const brc_scene *scene, int n_threads, brc_domain **out)
{
    brc_status status = BRC_OK;
    brc_domain **parts = NULL;
    *out = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &parts, scene->n_bodies, "bodies of a scene"));
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        BRC_TRY_OR(cleanup, make_body(context, scene, b, n_threads, &parts[b]));
    if (scene->n_bodies == 1) {
        *out = parts[0];
        parts[0] = NULL;
    } else {
        BRC_TRY_OR(cleanup, brc_domain_join(context, scene->n_bodies, (const brc_domain *const *)parts, out));
    }
    BRC_TRY_OR(cleanup, name_sets(context, scene, *out));
cleanup:
    for (int32_t b = 0; parts && b < scene->n_bodies; ++b)
        brc_domain_free(&parts[b]);
    brc_memory_free(parts);
    if (status != BRC_OK) brc_domain_free(out);
    return status;
}
