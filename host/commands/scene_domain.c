/* From what a scene asks to a domain. */
#include "scene_domain.h"
#include "../../preprocess/domain_file.h"
#include "../../preprocess/pose.h"
#include "../../preprocess/quality.h"
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
        if ((*out)->region[e] < 0 || (*out)->region[e] > brc_body_n_regions(body))
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "body '%s': %s holds region %d, the scene gives the body %d region(s); state them as when the "
                            "file was built", body->name, body->domain_file, (*out)->region[e], brc_body_n_regions(body));
    brc_pose_apply(body->shape.origin, body->rotation, body->translation, *out);
    return brc_quality_judge(context, *out, scene->n_limits, scene->limits);
}

/* A path of the scene as the builder needs it: relative to the scene's folder. */
static brc_status resolve(brc_context *context, const brc_scene *scene, char *path, size_t room)
{
    if (path[0] == '\0' || path[0] == '/') return BRC_OK;
    char *joined = NULL;
    BRC_TRY(brc_file_join(context, scene->folder, path, &joined));
    brc_status status = BRC_OK;
    if (strlen(joined) >= room)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: the path has %zu bytes, at most %zu are kept; use a shorter one", joined,
                          strlen(joined), room - 1);
    else
        memcpy(path, joined, strlen(joined) + 1);
    brc_memory_free(joined);
    return status;
}

void brc_scene_request_free(brc_scene_request *request)
{
    brc_memory_free(request->regions);
    brc_memory_free(request->fractions);
    brc_memory_free(request->parts);
    memset(request, 0, sizeof *request);
}

brc_status brc_scene_request_make(brc_context *context, const brc_scene *scene, int32_t index, int n_threads, brc_scene_request *out)
{
    const brc_body *body = &scene->bodies[index];
    brc_status status = BRC_OK;
    memset(out, 0, sizeof *out);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->regions, body->n_regions, "regions of a body"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->fractions, body->n_phases, "phases of a body"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->parts, body->shape.n_parts, "parts of a shape"));
    for (int32_t r = 0; r < body->n_regions; ++r)
        out->regions[r] = body->regions[r].where;
    for (int32_t p = 0; p < body->n_phases; ++p)
        out->fractions[p] = body->phases[p].fraction;
    brc_build_request *build = &out->build;
    *build = (brc_build_request){.shape = body->shape, .fill = body->fill, .beams = body->beams,
                                 .n_cracks = body->n_cracks, .cracks = body->cracks, .grains = body->grains,
                                 .n_limits = scene->n_limits, .limits = scene->limits, .n_regions = body->n_regions,
                                 .regions = out->regions, .tiny_face_threshold = body->tiny_face_threshold,
                                 .n_threads = n_threads, .body = index};
    memcpy(build->translation, body->translation, sizeof build->translation);
    memcpy(build->rotation, body->rotation, sizeof build->rotation);
    build->grains.n_phases = body->n_phases;
    build->grains.fraction = out->fractions;
    BRC_TRY_OR(cleanup, resolve(context, scene, build->fill.file, sizeof build->fill.file));
    BRC_TRY_OR(cleanup, resolve(context, scene, build->shape.file, sizeof build->shape.file));
    if (body->shape.n_parts > 0) memcpy(out->parts, body->shape.parts, (size_t)body->shape.n_parts * sizeof *out->parts);
    for (int32_t p = 0; p < body->shape.n_parts; ++p)
        BRC_TRY_OR(cleanup, resolve(context, scene, out->parts[p].shape.file, sizeof out->parts[p].shape.file));
    build->shape.parts = out->parts;
cleanup:
    if (status != BRC_OK) brc_scene_request_free(out);
    return status;
}

static brc_status make_body(brc_context *context, const brc_scene *scene, int32_t index, int n_threads, brc_domain **out)
{
    if (scene->bodies[index].domain_file[0]) return read_body(context, scene, index, out);
    brc_scene_request request;
    BRC_TRY(brc_scene_request_make(context, scene, index, n_threads, &request));
    const brc_status status = brc_domain_build(context, &request.build, out);
    brc_scene_request_free(&request);
    return status;
}

brc_status brc_scene_domain_build(brc_context *context, const brc_scene *scene, int n_threads, brc_domain **out)
{
    brc_status status = BRC_OK;
    brc_domain **parts = NULL;
    const char **name = NULL;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &parts, scene->n_bodies, "bodies of a scene"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &name, scene->n_bodies, "bodies of a scene"));
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        name[b] = scene->bodies[b].name;
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        BRC_TRY_OR(cleanup, make_body(context, scene, b, n_threads, &parts[b]));
    if (scene->n_bodies == 1) {
        *out = parts[0];
        parts[0] = NULL;
    } else {
        BRC_TRY_OR(cleanup, brc_domain_join(context, scene->n_bodies, (const brc_domain *const *)parts, name, out));
    }
    BRC_TRY_OR(cleanup, brc_sets_build(context, scene->n_sets, scene->sets, *out));
cleanup:
    for (int32_t b = 0; parts && b < scene->n_bodies; ++b)
        brc_domain_free(&parts[b]);
    brc_memory_free(parts);
    brc_memory_free(name);
    if (status != BRC_OK) brc_domain_free(out);
    return status;
}
