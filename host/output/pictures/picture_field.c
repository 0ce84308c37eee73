/* Which field the picture shows: words of the scene to numbers of the elements. */
#include "picture.h"
#include "../../solver/effects/fracture/fracture.h"
#include "../frames/deform.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef enum source { DISPLACEMENT, VELOCITY, STRESS, STRAIN, DAMAGE } source;

typedef struct field {
    source source;
    int component; /* -1: length of a vector, Mises value of a stress */
    char name[64];
} field;

static bool parse(const char *word, field *out)
{
    static const char *const vector[] = {"displacement", "velocity"};
    static const char *const tensor[] = {"stress", "strain"};
    static const char *const pair[] = {"xx", "yy", "zz", "yz", "xz", "xy"};
    if (strcmp(word, "von_mises") == 0) {
        *out = (field){.source = STRESS, .component = -1, .name = "von Mises stress"};
        return true;
    }
    if (strcmp(word, "damage") == 0) {
        *out = (field){.source = DAMAGE, .name = "damage"};
        return true;
    }
    for (int k = 0; k < 2; ++k) {
        const size_t n = strlen(vector[k]);
        if (strncmp(word, vector[k], n) != 0) continue;
        *out = (field){.source = k == 0 ? DISPLACEMENT : VELOCITY, .component = -1};
        snprintf(out->name, sizeof out->name, "%s", vector[k]);
        if (word[n] == '\0') return true;
        if (word[n] != '_' || word[n + 1] < 'x' || word[n + 1] > 'z' || word[n + 2] != '\0') return false;
        out->component = word[n + 1] - 'x';
        snprintf(out->name, sizeof out->name, "%s %c", vector[k], word[n + 1]);
        return true;
    }
    for (int k = 0; k < 2; ++k)
        for (int p = 0; p < 6; ++p) {
            char full[16];
            snprintf(full, sizeof full, "%s_%s", tensor[k], pair[p]);
            if (strcmp(word, full) != 0) continue;
            *out = (field){.source = k == 0 ? STRESS : STRAIN, .component = p};
            snprintf(out->name, sizeof out->name, "%s %s", tensor[k], pair[p]);
            return true;
        }
    return false;
}

static const char *unit_of(source from)
{
    switch (from) {
    case DISPLACEMENT: return "m";
    case VELOCITY: return "m/s";
    case STRESS: return "Pa";
    case STRAIN:
    case DAMAGE: break;
    }
    return "-";
}

static double pick(const field *f, const double *data, int64_t e)
{
    if (f->source == STRESS || f->source == STRAIN)
        return f->component < 0 ? brc_deform_von_mises(data + 6 * e) : data[6 * e + f->component];
    if (f->source == DAMAGE) return data[e];
    const double *v = data + 3 * e;
    return f->component < 0 ? sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) : v[f->component];
}

/* What of a part is drawn, each array owned until the picture is there. */
typedef struct shown {
    uint8_t *whole;
    double *displacement, *value;
} shown;

static brc_status read_part(brc_context *context, brc_simulation *simulation, const field *f, shown *out)
{
    const int64_t n = brc_simulation_domain(simulation)->n_elements;
    double *data = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->displacement, 3 * n, "displacement of the picture"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &data, 6 * n, "field of the picture"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->value, n, "colours of the picture"));
    BRC_TRY_OR(cleanup, brc_simulation_displacement(simulation, out->displacement));
    BRC_TRY_OR(cleanup, brc_simulation_whole(simulation, &out->whole));
    switch (f->source) {
    case DISPLACEMENT: memcpy(data, out->displacement, 3 * (size_t)n * sizeof *data); break;
    case VELOCITY: status = brc_simulation_velocity(simulation, data); break;
    case STRESS: status = brc_simulation_strain_stress(simulation, NULL, NULL, data); break;
    case STRAIN: status = brc_simulation_strain_stress(simulation, data, NULL, NULL); break;
    case DAMAGE: status = brc_simulation_damage(simulation, data); break;
    }
    for (int64_t e = 0; status == BRC_OK && e < n; ++e)
        out->value[e] = pick(f, data, e);
cleanup:
    brc_memory_free(data);
    return status;
}

brc_status brc_picture_write(brc_context *context, const brc_assembly *assembly, const char *path)
{
    const brc_scene *scene = assembly->scene;
    const char *word = scene->output.picture_colour[0] ? scene->output.picture_colour : "von_mises";
    shown *own = NULL;
    brc_picture_part *part = NULL;
    brc_picture_striker *striker = NULL;
    brc_status status = BRC_OK;
    field f;
    if (!parse(word, &f))
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "a picture cannot be coloured by \"%s\"; known are von_mises, damage, displacement, velocity (also with "
            "_x, _y, _z), stress and strain with _xx, _yy, _zz, _yz, _xz, _xy",
            word);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &own, assembly->n, "parts of the picture"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &part, assembly->n, "parts of the picture"));
    for (int32_t k = 0; k < assembly->n; ++k) {
        BRC_TRY_OR(cleanup, read_part(context, assembly->part[k], &f, &own[k]));
        part[k] = (brc_picture_part){.domain = brc_simulation_domain(assembly->part[k]),
                                     .whole = own[k].whole,
                                     .displacement = own[k].displacement,
                                     .value = own[k].value};
    }
    const int32_t n_strikers = brc_simulation_n_strikers(assembly->part[0]);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &striker, n_strikers, "strikers of the picture"));
    for (int32_t k = 0; k < n_strikers; ++k) {
        striker[k] = (brc_picture_striker){.body = brc_simulation_striker_body(assembly->part[0], k),
                                           .is_plane = scene->strikers[k].is_plane};
        BRC_TRY_OR(cleanup, brc_simulation_striker_now(assembly->part[0], k, &striker[k].now));
    }
    const brc_output *output = &scene->output;
    const bool touching = scene->has_contact || n_strikers > 0; /* amplified, they would lie apart or in each other */
    const brc_paint_view view = output->has_picture_camera
                                    ? brc_paint_view_between(output->picture_from, output->picture_towards)
                                    : brc_paint_side_view(output->picture_view);
    brc_picture_cut cut;
    memcpy(cut.point, output->picture_cut_point, sizeof cut.point);
    memcpy(cut.normal, output->picture_cut_normal, sizeof cut.normal);
    const brc_picture picture = {
        .n = assembly->n,
        .part = part,
        .n_strikers = n_strikers,
        .striker = striker,
        .name = f.name,
        .unit = unit_of(f.source),
        .title = scene->title,
        .scale = output->picture_scale > 0 || !touching ? output->picture_scale : 1,
        .steady = output->picture_frames,
        .range = {0, output->picture_frames && f.source == DAMAGE ? 1 : 0},
        .cut = output->has_picture_cut ? &cut : NULL,
        .view = &view,
    };
    if (brc_file_writes()) status = brc_picture_draw(context, &picture, path);
cleanup:
    for (int32_t k = 0; own && k < assembly->n; ++k) {
        brc_memory_free(own[k].whole);
        brc_memory_free(own[k].displacement);
        brc_memory_free(own[k].value);
    }
    brc_memory_free(own);
    brc_memory_free(part);
    brc_memory_free(striker);
    return status;
}
