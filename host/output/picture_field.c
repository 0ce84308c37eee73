/* Which field the picture shows: words of the scene to numbers of the elements. */
#include "picture.h"
#include "../solver/fracture.h"
#include "deform.h"
#include "../base/memory.h"
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

brc_status brc_picture_write(brc_context *context, brc_simulation *simulation, const char *path)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_domain *domain = brc_simulation_domain(simulation);
    const char *word = scene->output.picture_colour[0] ? scene->output.picture_colour : "von_mises";
    const int64_t n = domain->n_elements;
    double *displacement = NULL, *data = NULL, *value = NULL;
    brc_status status = BRC_OK;
    field f;
    if (!parse(word, &f))
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "a picture cannot be coloured by \"%s\"; known are von_mises, damage, displacement, velocity (also with "
            "_x, _y, _z), stress and strain with _xx, _yy, _zz, _yz, _xz, _xy",
            word);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &displacement, 3 * n, "displacement of the picture"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &data, 6 * n, "field of the picture"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &value, n, "colours of the picture"));
    BRC_TRY_OR(cleanup, brc_simulation_displacement(simulation, displacement));
    switch (f.source) {
    case DISPLACEMENT: memcpy(data, displacement, 3 * (size_t)n * sizeof *data); break;
    case VELOCITY: status = brc_simulation_velocity(simulation, data); break;
    case STRESS: status = brc_simulation_strain_stress(simulation, NULL, NULL, data); break;
    case STRAIN: status = brc_simulation_strain_stress(simulation, data, NULL, NULL); break;
    case DAMAGE: status = brc_simulation_damage(simulation, data); break;
    }
    if (status != BRC_OK) goto cleanup;
    for (int64_t e = 0; e < n; ++e)
        value[e] = pick(&f, data, e);
    const brc_picture picture = {
        .domain = domain,
        .displacement = displacement,
        .value = value,
        .name = f.name,
        .unit = unit_of(f.source),
        .title = scene->title,
        .scale = scene->output.picture_scale,
    };
    status = brc_picture_draw(context, &picture, path);
cleanup:
    brc_memory_free(displacement);
    brc_memory_free(data);
    brc_memory_free(value);
    return status;
}
