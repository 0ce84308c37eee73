/* The index of a run as HDF5. */
#include "result_file.h"
#include "h5.h"
#include "meaning.h"
#include "text.h"
#include "../base/memory.h"
#include "../base/version.h"
#include "../scene/scene_reader.h"
#include <stdio.h>

/* Path of a named member; a name of the scene cannot open groups of its own. */
static const char *member(char path[192], const char *group, const char *name)
{
    const int n = snprintf(path, 192, "%s/", group);
    snprintf(path + n, 192 - (size_t)n, "%s", name);
    for (char *s = path + n; *s; ++s)
        if (*s == '/') *s = '_';
    return path;
}

static brc_status write_histories(brc_context *context, brc_h5 *h5, const brc_result *result)
{
    const brc_history *h = result->history;
    double *column = NULL;
    brc_h5_group(h5, "histories");
    brc_h5_dataset(h5, "histories/stage", H5T_NATIVE_INT32, h->n_samples, 0, h->stage);
    brc_h5_dataset(h5, "histories/step", H5T_NATIVE_INT64, h->n_samples, 0, h->step);
    brc_h5_dataset(h5, "histories/stage_time", H5T_NATIVE_DOUBLE, h->n_samples, 0, h->stage_time);
    brc_h5_dataset(h5, "histories/time", H5T_NATIVE_DOUBLE, h->n_samples, 0, h->time);
    brc_h5_group(h5, "histories/sensors");
    BRC_TRY(BRC_ALLOCATE(context, &column, h->n_samples, "column of a history"));
    for (int32_t s = 0; s < h->n_sensors; ++s) {
        const brc_sensor *sensor = &result->scene->sensors[s];
        char path[192];
        double last, smallest, largest;
        for (int64_t k = 0; k < h->n_samples; ++k)
            column[k] = h->value[k * h->n_sensors + s];
        member(path, "histories/sensors", sensor->name);
        brc_h5_dataset(h5, path, H5T_NATIVE_DOUBLE, h->n_samples, 0, column);
        brc_history_range(h, s, &last, &smallest, &largest);
        brc_h5_describe(h5, path, brc_sensor_unit(sensor), brc_meaning_of_sensor(sensor->kind));
        brc_h5_attribute_number(h5, path, "last", last);
        brc_h5_attribute_number(h5, path, "min", smallest);
        brc_h5_attribute_number(h5, path, "max", largest);
    }
    brc_memory_free(column);
    return BRC_OK;
}

static void write_measures(brc_h5 *h5, const brc_result *result)
{
    brc_h5_group(h5, "measures");
    for (int32_t m = 0; m < result->n_measures; ++m) {
        const brc_measured *measured = &result->measures[m];
        char path[192];
        member(path, "measures", measured->name);
        brc_h5_dataset(h5, path, H5T_NATIVE_DOUBLE, 1, 0, &measured->value);
        brc_h5_describe(h5, path, measured->unit, brc_meaning_of_measure(result->scene->measures[m].kind));
        if (!measured->has_target) continue;
        brc_h5_attribute_number(h5, path, "target", measured->target);
        brc_h5_attribute_number(h5, path, "error", measured->error);
    }
}

static void write_ledger(brc_h5 *h5, const brc_ledger *l)
{
    const struct {
        const char *name;
        double value;
    } term[] = {{"kinetic", l->kinetic},
                {"elastic", l->elastic},
                {"stabilisation", l->stabilisation},
                {"potential", l->potential},
                {"work", l->work},
                {"damping", l->damping},
                {"numerical", l->numerical},
                {"contact", l->contact},
                {"friction", l->friction},
                {"impact", l->impact},
                {"fracture", l->fracture},
                {"initial", l->initial},
                {"total", l->total},
                {"closure", l->closure},
                {"peak_elastic", l->peak_elastic},
                {"peak_kinetic", l->peak_kinetic}};
    brc_h5_group(h5, "ledger");
    for (size_t k = 0; k < sizeof term / sizeof term[0]; ++k) {
        char path[192];
        brc_h5_dataset(h5, member(path, "ledger", term[k].name), H5T_NATIVE_DOUBLE, 1, 0, &term[k].value);
    }
}

static void write_frames(brc_h5 *h5, const brc_result *result)
{
    brc_h5_group(h5, "frames");
    brc_h5_dataset(h5, "frames/time", H5T_NATIVE_DOUBLE, result->n_frames, 0, result->frame_time);
    for (int64_t k = 0; k < result->n_frames; ++k) {
        char link[32], file[48];
        snprintf(link, sizeof link, "frames/%06lld", (long long)k);
        snprintf(file, sizeof file, "%s.vtkhdf", link);
        brc_h5_external_link(h5, link, file, "/VTKHDF");
    }
}

static brc_status write_provenance(brc_context *context, brc_h5 *h5, const brc_result *result)
{
    brc_text made = {.context = context};
    for (int32_t k = 0; k < result->n_domains; ++k)
        if (result->domains[k]->provenance)
            brc_text_add(&made, "%s%s", k > 0 ? " | " : "", result->domains[k]->provenance);
    brc_h5_group(h5, "provenance");
    if (made.status == BRC_OK && made.length > 0) brc_h5_attribute_text(h5, "provenance", "domain", made.data);
    const brc_status status = made.status;
    brc_text_free(&made);
    if (status != BRC_OK || !result->assembly) return status;
    const brc_device *device = brc_simulation_device(result->assembly->part[0]);
    const brc_device_info *info = brc_device_get_info(device);
    brc_h5_attribute_text(h5, "provenance", "device", info->name);
    brc_h5_attribute_text(h5, "provenance", "driver", info->driver);
    brc_h5_attribute_text(h5, "provenance", "precision", brc_precision_name(brc_device_get_precision(device)));
    return BRC_OK;
}

static brc_status write_content(brc_context *context, brc_h5 *h5, const brc_result *result)
{
    static const int64_t format_version = BRC_RESULT_FORMAT_VERSION;
    char *yaml = NULL, models[256];
    BRC_TRY(brc_scene_to_yaml(context, result->scene, &yaml));
    brc_h5_attribute_integers(h5, "/", "format_version", 1, &format_version);
    brc_h5_attribute_text(h5, "/", "version", brc_version());
    brc_h5_attribute_text(h5, "/", "commit", brc_version_commit());
    brc_h5_attribute_text(h5, "/", "compiler", brc_version_compiler());
    if (result->assembly)
        brc_h5_attribute_text(h5, "/", "model", brc_assembly_models(result->assembly, models, sizeof models));
    brc_h5_attribute_text(h5, "/", "title", result->scene->title);
    brc_h5_text(h5, "scene", yaml);
    brc_memory_free(yaml);
    if (result->history) BRC_TRY(write_histories(context, h5, result));
    write_measures(h5, result);
    if (result->ledger) write_ledger(h5, result->ledger);
    if (result->cracks) {
        BRC_TRY(brc_cracks_write_h5(context, h5, &result->cracks->cracks));
        BRC_TRY(brc_fragment_table_write_h5(context, h5, &result->cracks->fragments));
    }
    write_frames(h5, result);
    return write_provenance(context, h5, result);
}

brc_status brc_result_write(brc_context *context, const brc_result *result, const char *path)
{
    brc_h5 h5;
    BRC_TRY(brc_h5_create_in_memory(context, path, &h5));
    const brc_status status = write_content(context, &h5, result);
    if (status == BRC_OK) return brc_h5_commit(&h5);
    brc_h5_discard(&h5);
    return status;
}
