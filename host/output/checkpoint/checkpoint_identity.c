#include "checkpoint_identity.h"
#include "../seal.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "../../base/ranks.h"
#include "../../base/version.h"
#include "../../scene/scene_reader.h"
#include <stdio.h>
#include <string.h>

/* ---- writing ---- */

brc_status brc_checkpoint_scene(brc_context *context, const brc_scene *scene, char **yaml)
{
    brc_scene copy = *scene; /* shallow: only what lies in the struct itself is changed */
    copy.output.has_checkpoint = false;
    copy.output.checkpoint_every = copy.output.checkpoint_wall = 0;
    return brc_scene_to_yaml(context, &copy, yaml);
}

/* "cpu: OpenMP, instruction set v4": what decides the bits; the number of threads does not. */
static void name_device(const brc_assembly *a, char *text, size_t room)
{
    const brc_device_info *info = brc_device_get_info(brc_simulation_device(a->part[0]));
    snprintf(text, room, "%s: %s%s", info->selector, info->driver,
             brc_device_is_exact(brc_simulation_device(a->part[0])) ? ", exact" : "");
}

brc_status brc_checkpoint_sum_areas(brc_context *context, brc_domain *d)
{
    typedef struct part {
        int64_t bytes;
        uint32_t sum;
    } part;
    const int32_t count = brc_ranks_count();
    if (!d->here) return BRC_OK;
    BRC_LOCAL(context, count, part, parts, "sums of ranks");
    BRC_LOCAL(context, count, int64_t, ones, "sums of ranks");
    part own = {0};
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int64_t bytes = 24 * (d->row_start[e + 1] - d->row_start[e]);
        if (!d->here[e]) continue;
        own.sum = brc_seal_sum(own.sum, d->area_vector + 3 * d->row_start[e], bytes);
        own.bytes += bytes;
    }
    for (int32_t k = 0; k < count; ++k)
        ones[k] = 1;
    BRC_TRY(brc_ranks_gather_all(context, &own, sizeof own, ones, parts));
    d->area_sum = 0;
    for (int32_t k = 0; k < count; ++k)
        d->area_sum = brc_seal_join(d->area_sum, parts[k].sum, parts[k].bytes);
    return BRC_OK;
}

void brc_checkpoint_sums(const brc_assembly *a, int64_t *sums)
{
    for (int32_t k = 0; k < a->n; ++k) {
        const brc_domain *d = brc_simulation_domain(a->part[k]);
        const int64_t n = d->n_elements, h = d->n_half_edges, f = d->n_free_faces;
        const struct {
            const void *data;
            int64_t bytes;
        } all[] = {{d->position, 24 * n},
                   {d->volume, 8 * n},
                   {d->body, 4 * n},
                   {d->region, 4 * n},
                   {d->radius, 8 * n},
                   {d->grain, 4 * n},
                   {d->row_start, 8 * (n + 1)},
                   {d->neighbour, 4 * h},
                   {d->area_vector, 24 * h},
                   {d->free_element, 4 * f},
                   {d->free_area_vector, 24 * f},
                   {d->free_centroid, 24 * f}};
        uint32_t sum = 0;
        for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
            if (all[i].data == d->area_vector && d->here)
                sum = brc_seal_join(sum, d->area_sum, all[i].bytes);
            else if (all[i].data)
                sum = brc_seal_sum(sum, all[i].data, all[i].bytes);
        for (int32_t i = 0; i < d->n_sets; ++i)
            sum = brc_seal_sum(sum, d->sets[i].members, 4 * d->sets[i].n_members);
        sums[k] = sum;
    }
}

void brc_checkpoint_identity_write(brc_h5 *h5, const brc_assembly *a, const char *scene, const int64_t *sums)
{
    const int64_t version = BRC_CHECKPOINT_FORMAT_VERSION;
    char device[256], path[64];
    name_device(a, device, sizeof device);
    brc_h5_group(h5, "identity");
    brc_h5_dataset(h5, "identity/format_version", H5T_NATIVE_INT64, 1, 0, &version);
    brc_h5_text(h5, "identity/version", brc_version());
    brc_h5_text(h5, "identity/commit", brc_version_commit());
    brc_h5_text(h5, "identity/scene", scene);
    brc_h5_text(h5, "identity/device", device);
    brc_h5_text(h5, "identity/precision",
                brc_precision_name(brc_device_get_precision(brc_simulation_device(a->part[0]))));
    for (int32_t k = 0; k < a->n; ++k) {
        const brc_domain *d = brc_simulation_domain(a->part[k]);
        const int64_t numbers[] = {d->n_elements, d->n_bonds, sums[k]};
        snprintf(path, sizeof path, "identity/model_%d", (int)k);
        brc_h5_text(h5, path, brc_assembly_part_name(a, k));
        snprintf(path, sizeof path, "identity/domain_%d", (int)k);
        brc_h5_dataset(h5, path, H5T_NATIVE_INT64, 3, 0, numbers);
    }
}

/* ---- comparing ---- */

static size_t indent_of(const char *line)
{
    return strspn(line, " -");
}
static size_t length_of(const char *line)
{
    return strcspn(line, "\n");
}

/* "stages / - name: pull / solver": the lines above `line` that it belongs to, outermost first. */
static void path_of_line(const char *text, const char *line, char *out, size_t room)
{
    const char *above[16];
    int n = 0;
    size_t indent = indent_of(line);
    for (const char *at = line; at > text && indent > 0 && n < 16;) {
        do
            --at;
        while (at > text && at[-1] != '\n');
        if (indent_of(at) >= indent) continue;
        indent = indent_of(at);
        above[n++] = at;
    }
    size_t used = 0;
    out[0] = '\0';
    while (n-- > 0 && used + 1 < room) {
        const char *first = above[n] + indent_of(above[n]);
        used += (size_t)snprintf(out + used, room - used, "%.*s ", (int)length_of(first), first);
    }
}

static void copy_line(const char *line, char *out, size_t room)
{
    const char *first = line + indent_of(line);
    snprintf(out, room, "%.*s", (int)length_of(first), first);
}

static brc_status refuse_scene(brc_context *context, const char *path, const char *there, const char *here)
{
    const char *a = there, *b = here;
    char place[256], old[160], new[160];
    while (*a && length_of(a) == length_of(b) && memcmp(a, b, length_of(a)) == 0) {
        a += length_of(a);
        b += length_of(b);
        a += *a == '\n';
        b += *b == '\n';
    }
    path_of_line(*b ? here : there, *b ? b : a, place, sizeof place);
    copy_line(a, old, sizeof old);
    copy_line(b, new, sizeof new);
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "%s: the scene is not that of the checkpoint: %s'%s' there, '%s' here; go on with the scene it was "
                    "written with, or leave out --resume to begin anew",
                    path, place, *a ? old : "nothing more", *b ? new : "nothing more");
}

brc_status brc_checkpoint_same_scene(brc_context *context, const brc_h5_read *h5, const char *scene)
{
    char *there = NULL, *commit = NULL, *version = NULL;
    int64_t format;
    brc_status status = BRC_OK;
    BRC_TRY(brc_h5_read_rows(h5, "identity/format_version", H5T_NATIVE_INT64, 0, 1, &format));
    if (format != BRC_CHECKPOINT_FORMAT_VERSION)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "%s: is a checkpoint of format %lld, this program reads %d; go on with the program that wrote it", h5->path,
            (long long)format, BRC_CHECKPOINT_FORMAT_VERSION);
    BRC_TRY_OR(cleanup, brc_h5_read_string(h5, "identity/scene", &there));
    BRC_TRY_OR(cleanup, brc_h5_read_string(h5, "identity/version", &version));
    BRC_TRY_OR(cleanup, brc_h5_read_string(h5, "identity/commit", &commit));
    if (strcmp(there, scene) != 0) {
        status = refuse_scene(context, h5->path, there, scene);
        goto cleanup;
    }
    if (strcmp(version, brc_version()) != 0 || strcmp(commit, brc_version_commit()) != 0)
        brc_log(context, BRC_LOG_WARNING,
                "%s was written by version %s (commit %s), this is %s (commit %s): the run goes on, but not bit for "
                "bit as one of either",
                h5->path, version, commit, brc_version(), brc_version_commit());
cleanup:
    brc_memory_free(there);
    brc_memory_free(version);
    brc_memory_free(commit);
    return status;
}

static brc_status same_domain(brc_context *context, const brc_h5_read *h5, const brc_assembly *a, int32_t k,
                              int64_t sum)
{
    const brc_domain *d = brc_simulation_domain(a->part[k]);
    int64_t there[3];
    char *model = NULL, path[64];
    brc_status status = BRC_OK;
    snprintf(path, sizeof path, "identity/model_%d", (int)k);
    BRC_TRY_OR(cleanup, brc_h5_read_string(h5, path, &model));
    snprintf(path, sizeof path, "identity/domain_%d", (int)k);
    BRC_TRY_OR(cleanup, brc_h5_read_rows(h5, path, H5T_NATIVE_INT64, 0, 3, there));
    if (strcmp(model, brc_assembly_part_name(a, k)) != 0)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: was written with model %s, this run has %s", h5->path, model,
                          brc_assembly_part_name(a, k));
    else if (there[0] != d->n_elements || there[1] != d->n_bonds)
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: the domain of the checkpoint has %lld elements and %lld bonds, this one %lld and %lld; "
                          "a file that the scene reads has changed, or "
                          "the program that builds it",
                          h5->path, (long long)there[0], (long long)there[1], (long long)d->n_elements,
                          (long long)d->n_bonds);
    else if (there[2] != sum)
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: the domain of the checkpoint has other positions, bonds, faces or sets than this one "
                          "(checksum %08llx there, %08llx here); a file that "
                          "the scene reads has changed, or the program that builds it",
                          h5->path, (unsigned long long)there[2], (unsigned long long)sum);
cleanup:
    brc_memory_free(model);
    return status;
}

brc_status brc_checkpoint_same_run(brc_context *context, const brc_h5_read *h5, const brc_assembly *a,
                                   const int64_t *sums)
{
    const char *own = brc_precision_name(brc_device_get_precision(brc_simulation_device(a->part[0])));
    char *precision = NULL, *device = NULL, here[256];
    brc_status status = BRC_OK;
    name_device(a, here, sizeof here);
    BRC_TRY_OR(cleanup, brc_h5_read_string(h5, "identity/precision", &precision));
    BRC_TRY_OR(cleanup, brc_h5_read_string(h5, "identity/device", &device));
    if (strcmp(precision, own) != 0) {
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: the checkpoint is in precision %s, this run in %s; go on with --precision %s", h5->path,
                          precision, own, precision);
        goto cleanup;
    }
    for (int32_t k = 0; k < a->n; ++k)
        BRC_TRY_OR(cleanup, same_domain(context, h5, a, k, sums[k]));
    if (strcmp(device, here) != 0)
        brc_log(context, BRC_LOG_WARNING,
                "%s was written on %s, the run goes on on %s: from here on its numbers are those of this device, to "
                "rounding the same",
                h5->path, device, here);
cleanup:
    brc_memory_free(precision);
    brc_memory_free(device);
    return status;
}
