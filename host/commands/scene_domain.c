/* From what a scene asks to a domain. */
#include "scene_domain.h"
#include "../../preprocess/domain/domain_file.h"
#include "../../preprocess/domain/overlap.h"
#include "../../preprocess/domain/pose.h"
#include "../../preprocess/domain/quality.h"
#include "../../preprocess/domain/set_share.h"
#include "../../preprocess/domain/sets.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <string.h>

/* Number and pose of the body. Pages of the file are kept where nothing changes. */
static brc_status place_body(brc_context *context, const brc_body *body, int32_t index, brc_domain *d)
{
    bool other = false;
    for (int64_t e = 0; e < d->n_elements; ++e)
        other = other || d->body[e] != index;
    for (int k = 0; k < 3; ++k)
        other = other || body->rotation[k] != 0.0 || body->translation[k] != 0.0;
    if (!other) return BRC_OK;
    BRC_TRY(brc_domain_take_pages(context, d));
    for (int64_t e = 0; e < d->n_elements; ++e)
        d->body[e] = index;
    brc_pose_apply(body->shape.origin, body->rotation, body->translation, d);
    return BRC_OK;
}

static brc_status read_body(brc_context *context, const brc_scene *scene, int32_t index, brc_domain **out)
{
    const brc_body *body = &scene->bodies[index];
    char *path = NULL;
    if (body->domain_file[0] != '/') BRC_TRY(brc_file_join(context, scene->folder, body->domain_file, &path));
    const brc_status status = brc_domain_read(context, path ? path : body->domain_file, out);
    brc_memory_free(path);
    if (status != BRC_OK) return status;
    BRC_TRY(place_body(context, body, index, *out));
    for (int64_t e = 0; e < (*out)->n_elements; ++e)
        if ((*out)->region[e] < 0 || (*out)->region[e] > brc_body_n_regions(body))
            return BRC_FAIL(
                context, BRC_BAD_INPUT,
                "body '%s': %s holds region %d, the scene gives the body %d region(s); state them as when the "
                "file was built",
                body->name, body->domain_file, (*out)->region[e], brc_body_n_regions(body));
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
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: the path has %zu bytes, at most %zu are kept; use a shorter one",
                          joined, strlen(joined), room - 1);
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

brc_status brc_scene_request_make(brc_context *context, const brc_scene *scene, int32_t index, int n_threads,
                                  brc_scene_request *out)
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
    *build = (brc_build_request){.shape = body->shape,
                                 .fill = body->fill,
                                 .beams = body->beams,
                                 .balanced = scene->model.polish,
                                 .n_cracks = body->n_cracks,
                                 .cracks = body->cracks,
                                 .grains = body->grains,
                                 .n_limits = scene->n_limits,
                                 .limits = scene->limits,
                                 .n_regions = body->n_regions,
                                 .regions = out->regions,
                                 .tiny_face_threshold = body->tiny_face_threshold,
                                 .n_threads = n_threads,
                                 .body = index};
    memcpy(build->translation, body->translation, sizeof build->translation);
    memcpy(build->rotation, body->rotation, sizeof build->rotation);
    build->grains.n_phases = body->n_phases;
    build->grains.fraction = out->fractions;
    BRC_TRY_OR(cleanup, resolve(context, scene, build->fill.file, sizeof build->fill.file));
    BRC_TRY_OR(cleanup, resolve(context, scene, build->shape.file, sizeof build->shape.file));
    if (body->shape.n_parts > 0)
        memcpy(out->parts, body->shape.parts, (size_t)body->shape.n_parts * sizeof *out->parts);
    for (int32_t p = 0; p < body->shape.n_parts; ++p)
        BRC_TRY_OR(cleanup, resolve(context, scene, out->parts[p].shape.file, sizeof out->parts[p].shape.file));
    build->shape.parts = out->parts;
cleanup:
    if (status != BRC_OK) brc_scene_request_free(out);
    return status;
}

static brc_status make_body(brc_context *context, const brc_scene *scene, int32_t index, int n_threads,
                            brc_together together, brc_domain **out)
{
    if (scene->bodies[index].domain_file[0]) return read_body(context, scene, index, out);
    brc_scene_request request;
    BRC_TRY(brc_scene_request_make(context, scene, index, n_threads, &request));
    request.build.together = together;
    const brc_status status = brc_domain_build(context, &request.build, out);
    brc_scene_request_free(&request);
    return status;
}

/* The bodies of a scene, each by itself, and their names. */
typedef struct bodies {
    int32_t n;
    brc_domain **domain; /* [n] */
    const char **name;   /* [n] */
} bodies;

static void free_bodies(bodies *b)
{
    for (int32_t k = 0; b->domain && k < b->n; ++k)
        brc_domain_free(&b->domain[k]);
    brc_memory_free(b->domain);
    brc_memory_free(b->name);
    *b = (bodies){0};
}

static brc_status make_bodies(brc_context *context, const brc_scene *scene, int n_threads, brc_together together,
                              bodies *out)
{
    *out = (bodies){.n = scene->n_bodies};
    BRC_TRY(BRC_ALLOCATE(context, &out->domain, scene->n_bodies, "bodies of a scene"));
    BRC_TRY(BRC_ALLOCATE(context, &out->name, scene->n_bodies, "bodies of a scene"));
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        out->name[b] = scene->bodies[b].name;
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        brc_context_set_place(context, scene->bodies[b].place);
        const brc_status status = make_body(context, scene, b, n_threads, together, &out->domain[b]);
        brc_context_set_place(context, NULL);
        BRC_TRY(status);
    }
    return BRC_OK;
}

/* One domain of all; a single body is handed over. */
static brc_status join_bodies(brc_context *context, bodies *b, brc_together together, brc_domain **out)
{
    if (b->n > 1) return brc_domain_join(context, b->n, (const brc_domain *const *)b->domain, b->name, together, out);
    *out = b->domain[0];
    b->domain[0] = NULL;
    return BRC_OK;
}

static brc_status build_scene(brc_context *context, const brc_scene *scene, int n_threads, brc_together together,
                              brc_domain **out)
{
    bodies own;
    *out = NULL;
    brc_status status = make_bodies(context, scene, n_threads, together, &own);
    if (status == BRC_OK) status = join_bodies(context, &own, together, out);
    if (status == BRC_OK) status = brc_sets_build(context, scene->n_sets, scene->sets, *out);
    free_bodies(&own);
    if (status != BRC_OK) brc_domain_free(out);
    return status;
}

brc_status brc_scene_domain_build(brc_context *context, const brc_scene *scene, int n_threads, brc_domain **out)
{
    return build_scene(context, scene, n_threads, BRC_ALONE, out);
}

/* Bodies of different parts; those of one part are looked at when they are joined. */
static brc_status check_overlaps(brc_context *context, int32_t n, const bodies *part)
{
    brc_status status = BRC_OK;
    for (int32_t k = 0; k < n; ++k)
        for (int32_t other = 0; other < k; ++other)
            for (int32_t a = 0; a < part[other].n; ++a)
                for (int32_t b = 0; b < part[k].n; ++b) {
                    const brc_domain *const pair[2] = {part[other].domain[a], part[k].domain[b]};
                    const char *const name[2] = {part[other].name[a], part[k].name[b]};
                    const brc_status one = brc_overlap_check(context, 2, pair, name);
                    if (one != BRC_OK) status = one;
                }
    return status;
}

/* What a domain has of a set: members, or only faces that the set's region cuts, which loads per area act on in
 * part. */
typedef enum presence { ABSENT, CUT_ONLY, WITH_MEMBERS } presence;

static brc_status look_for(brc_context *context, const brc_set_request *set, const brc_domain *domain, presence *out)
{
    brc_context *quiet = brc_context_create();
    double area[3], centroid[3];
    *out = ABSENT;
    if (!quiet) return BRC_FAIL(context, BRC_NO_MEMORY, "no memory for the sets of a model");
    const int64_t n = set->kind == BRC_SET_FACES ? domain->n_free_faces : domain->n_elements;
    const bool fits = brc_predicate_check(quiet, &set->where, set->kind, domain, set->name) == BRC_OK,
               cuts = set->kind == BRC_SET_FACES && brc_predicate_cuts(&set->where);
    for (int64_t k = 0; fits && *out != WITH_MEMBERS && k < n; ++k) {
        if (brc_predicate_holds(&set->where, set->kind, domain, k))
            *out = WITH_MEMBERS;
        else if (cuts && *out == ABSENT && brc_predicate_share(&set->where, domain, k, area, centroid) > 0)
            *out = CUT_ONLY;
    }
    brc_context_free(&quiet);
    return BRC_OK;
}

/* Sets go to the parts in which they have members, and without members to those whose faces they cut; what has members
 * nowhere goes to the first, which refuses it. */
static brc_status build_sets(brc_context *context, const brc_split *split, brc_domain *const *domain)
{
    const brc_scene *scene = split->scene;
    brc_set_request *given = NULL;
    presence *there = NULL; /* [parts][sets] */
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &given, scene->n_sets, "sets of a model"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &there, (int64_t)split->n * scene->n_sets, "sets of a model"));
    for (int32_t s = 0; s < scene->n_sets; ++s) {
        bool any = false;
        for (int32_t k = 0; k < split->n; ++k) {
            presence *has = &there[(int64_t)k * scene->n_sets + s];
            BRC_TRY_OR(cleanup, look_for(context, &split->part[k].scene->sets[s], domain[k], has));
            any |= *has == WITH_MEMBERS;
        }
        if (!any) there[s] = WITH_MEMBERS;
    }
    for (int32_t k = 0; k < split->n; ++k) {
        const presence *has = &there[(int64_t)k * scene->n_sets];
        int32_t n = 0;
        for (int32_t s = 0; s < scene->n_sets; ++s)
            if (has[s] == WITH_MEMBERS) given[n++] = split->part[k].scene->sets[s];
        BRC_TRY_OR(cleanup, brc_sets_build(context, n, given, domain[k]));
        for (int32_t s = 0; s < scene->n_sets; ++s)
            if (has[s] == CUT_ONLY)
                BRC_TRY_OR(cleanup, brc_sets_add_empty(context, domain[k], scene->sets[s].name, scene->sets[s].kind));
    }
cleanup:
    brc_memory_free(given);
    brc_memory_free(there);
    return status;
}

brc_status brc_split_domains_build(brc_context *context, const brc_split *split, int n_threads, brc_together together,
                                   brc_domain **out)
{
    bodies *part = NULL;
    brc_status status = BRC_OK;
    for (int32_t k = 0; k < split->n; ++k)
        out[k] = NULL;
    if (split->n == 1) return build_scene(context, split->scene, n_threads, together, out);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &part, split->n, "parts of a scene"));
    for (int32_t k = 0; k < split->n; ++k)
        BRC_TRY_OR(cleanup, make_bodies(context, split->part[k].scene, n_threads, together, &part[k]));
    BRC_TRY_OR(cleanup, check_overlaps(context, split->n, part));
    for (int32_t k = 0; k < split->n; ++k)
        BRC_TRY_OR(cleanup, join_bodies(context, &part[k], together, &out[k]));
    status = build_sets(context, split, out);
cleanup:
    for (int32_t k = 0; part && k < split->n; ++k)
        free_bodies(&part[k]);
    brc_memory_free(part);
    for (int32_t k = 0; status != BRC_OK && k < split->n; ++k)
        brc_domain_free(&out[k]);
    return status;
}
