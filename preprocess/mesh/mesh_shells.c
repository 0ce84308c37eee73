/* Shells that lie within each other: the outermost ones bound the solid, those within them cavities, those within
 * cavities solid again. */
#include "../../host/base/memory.h"
#include "mesh_internal.h"

#include <math.h>

typedef struct shell {
    int32_t first;   /* a triangle */
    int32_t depth;   /* shells around it */
    int32_t outmost; /* the one around it that nothing surrounds; itself at depth 0 */
    int32_t stamp;   /* the question that last met this one */
    bool odd;        /* and whether it lies within this one */
    double volume;   /* signed [m^3] */
} shell;

/* One question: which shells lie around a point of shell `asker`? */
typedef struct question {
    const brc_mesh *mesh;
    shell *shells;
    int32_t asker, stamp, around;
} question;

static void count(void *of, int32_t triangle, double t)
{
    question *q = of;
    const int32_t s = q->mesh->shell[triangle];
    if (s == q->asker || t < 0.0) return;
    if (q->shells[s].stamp != q->stamp) q->shells[s].odd = false;
    q->shells[s].stamp = q->stamp;
    q->shells[s].odd = !q->shells[s].odd;
    q->around += q->shells[s].odd ? 1 : -1;
}

/* The outermost shell around the asker: noted when met. */
typedef struct search {
    question q;
    int32_t outmost;
} search;

static void note_outmost(void *of, int32_t triangle, double t)
{
    search *s = of;
    const int32_t k = s->q.mesh->shell[triangle];
    const shell *other = &s->q.shells[k];
    (void)t;
    if (k != s->q.asker && other->depth == 0 && other->stamp == s->q.stamp && other->odd) s->outmost = k;
}

static const double *point_of(const brc_mesh *mesh, const shell *s)
{
    return mesh->vertex[mesh->corner[s->first][0]];
}

static void measure(brc_mesh *mesh, shell *shells)
{
    double middle[3];
    for (int d = 0; d < 3; ++d)
        middle[d] = 0.5 * (mesh->bounds[0][d] + mesh->bounds[1][d]);
    for (int32_t t = mesh->n_triangles - 1; t >= 0; --t) {
        double area[3], arm[3];
        brc_mesh_area_vector(mesh, t, area);
        mesh_minus(mesh->vertex[mesh->corner[t][0]], middle, arm);
        shells[mesh->shell[t]].volume += mesh_dot(area, arm) / 6.0;
        shells[mesh->shell[t]].first = t;
        mesh->area += 0.5 * sqrt(mesh_dot(area, area));
    }
}

static void find_depths(brc_mesh *mesh, shell *shells)
{
    for (int32_t s = 0; s < mesh->n_shells; ++s)
        shells[s].outmost = s;
    if (mesh->n_shells == 1) return;
    for (int32_t s = 0; s < mesh->n_shells; ++s) {
        question q = {.mesh = mesh, .shells = shells, .asker = s, .stamp = s + 1};
        brc_mesh_pierce(mesh, point_of(mesh, &shells[s]), 0, count, &q);
        shells[s].depth = q.around;
    }
    for (int32_t s = 0; s < mesh->n_shells; ++s) {
        search of = {.q = {.mesh = mesh, .shells = shells, .asker = s, .stamp = mesh->n_shells + s + 1}, .outmost = s};
        if (shells[s].depth == 0) continue;
        brc_mesh_pierce(mesh, point_of(mesh, &shells[s]), 0, count, &of.q);
        brc_mesh_pierce(mesh, point_of(mesh, &shells[s]), 0, note_outmost, &of);
        shells[s].outmost = of.outmost;
    }
}

brc_status brc_mesh_nest(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source)
{
    shell *shells = NULL;
    uint8_t *marked = NULL;
    char place[BRC_MESH_PLACE];
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &shells, mesh->n_shells, "shells of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &marked, mesh->n_triangles, "shells of a mesh"));
    measure(mesh, shells);
    find_depths(mesh, shells);
    bool any = false;
    for (int32_t t = 0; t < mesh->n_triangles; ++t) { /* what is inside out is turned with all that lies in it */
        marked[t] = shells[shells[mesh->shell[t]].outmost].volume < 0.0;
        any = any || marked[t];
    }
    if (any) brc_mesh_reverse(mesh, marked);
    for (int32_t s = 0; s < mesh->n_shells; ++s) {
        const bool outward = (shells[s].volume > 0.0) != (shells[shells[s].outmost].volume < 0.0);
        mesh->volume += outward ? fabs(shells[s].volume) : -fabs(shells[s].volume);
        if (outward == (shells[s].depth % 2 == 0)) continue;
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: the shell of triangle %d at %s (units of the file) lies within %d other%s but is "
                          "oriented as %s: shells must alternate, a cavity's triangles "
                          "face into the cavity; reverse this shell for %s, or remove it",
                          source->path, mesh->facet[shells[s].first] + 1,
                          brc_mesh_place(source, point_of(mesh, &shells[s]), place), shells[s].depth,
                          shells[s].depth == 1 ? "" : "s", outward ? "a solid" : "a cavity",
                          outward ? "a cavity" : "a solid");
        goto cleanup;
    }
    if (!(mesh->volume > 0.0) || !isfinite(mesh->volume) || !isfinite(mesh->area))
        status =
            BRC_FAIL(context, BRC_BAD_INPUT,
                     "%s: the mesh encloses no volume (%g m^3); export a part that has a volume, with a sensible scale",
                     source->path, mesh->volume);
cleanup:
    brc_memory_free(shells);
    brc_memory_free(marked);
    return status;
}
