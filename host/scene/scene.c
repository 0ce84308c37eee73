/* Scenes: freeing, factors of time, units of sensors and measures. */
#include "scene.h"
#include "../base/memory.h"
#include <string.h>

void brc_scene_free(brc_scene **scene)
{
    if (!scene || !*scene) return;
    brc_scene *s = *scene;
    for (int b = 0; b < s->n_bodies; ++b) {
        brc_body *body = &s->bodies[b];
        void *const block[] = {body->regions, body->cracks, body->phases, body->shape.parts, body->fill.radii};
        for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
            brc_memory_free(block[k]);
    }
    for (int k = 0; k < s->n_stages; ++k) {
        for (int l = 0; l < s->stages[k].n_loads; ++l) {
            brc_memory_free(s->stages[k].loads[l].table.time);
            brc_memory_free(s->stages[k].loads[l].table.value);
        }
        brc_memory_free(s->stages[k].loads);
        brc_memory_free(s->stages[k].initials);
    }
    for (int k = 0; k < s->n_strikers; ++k) {
        brc_memory_free(s->strikers[k].table.time);
        brc_memory_free(s->strikers[k].table.value);
        brc_memory_free(s->strikers[k].shape.parts);
    }
    brc_memory_free(s->strikers);
    brc_memory_free(s->contact.pairs);
    for (int m = 0; m < s->n_materials; ++m)
        brc_memory_free(s->materials[m].scatter.quantiles);
    brc_memory_free(s->materials);
    brc_memory_free(s->interfaces);
    brc_memory_free(s->bodies);
    brc_memory_free(s->sets);
    brc_memory_free(s->limits);
    brc_memory_free(s->stages);
    brc_memory_free(s->sensors);
    brc_memory_free(s->measures);
    brc_memory_free(s);
    *scene = NULL;
}

int32_t brc_body_n_regions(const brc_body *body)
{
    return body->n_regions + body->n_phases;
}

int32_t brc_body_material(const brc_body *body, int32_t region)
{
    if (region < 1 || region > brc_body_n_regions(body)) return body->material;
    return region <= body->n_regions ? body->regions[region - 1].material
                                     : body->phases[region - body->n_regions - 1].material;
}

bool brc_body_uses(const brc_body *body, int32_t material)
{
    for (int32_t r = 0; r <= brc_body_n_regions(body); ++r)
        if (brc_body_material(body, r) == material) return true;
    return false;
}

const brc_model *brc_body_model(const brc_scene *scene, int32_t body)
{
    return scene->bodies[body].has_model ? &scene->bodies[body].model : &scene->model;
}

bool brc_material_breaks(const brc_scene *scene, brc_model_kind model, const brc_material *m)
{
    if (brc_scene_breaks_by_bond(scene, model)) return m->tension > 0;
    return m->tension > 0 || m->compression > 0 || scene->fracture.cohesion > 0 ||
           (brc_model_traits_of(model)->spheres && (m->beam_strength > 0 || m->beam_compression > 0));
}

bool brc_scene_softens(const brc_scene *scene)
{
    for (int32_t m = 0; m < scene->n_materials; ++m)
        if (scene->materials[m].fracture_energy > 0) return true;
    for (int32_t k = 0; k < scene->n_interfaces; ++k)
        if (scene->interfaces[k].fracture_energy > 0) return true;
    return false;
}

bool brc_scene_slides(const brc_scene *scene, brc_model_kind model)
{
    return scene->has_fracture && brc_model_traits_of(model)->cohesion &&
           scene->fracture.kind == BRC_CRITERION_MOHR_COULOMB && brc_scene_softens(scene);
}

bool brc_scene_breaks_by_bond(const brc_scene *scene, brc_model_kind model)
{
    return brc_criterion_of(&scene->fracture, model) == BRC_CRITERION_BOND_NORMAL || brc_scene_slides(scene, model);
}

bool brc_scene_shuts(const brc_scene *scene)
{
    return scene->has_fracture && scene->fracture.closure && !scene->has_contact;
}

double brc_scene_side_friction(const brc_scene *scene)
{
    const double usual =
        0.3; /* a block in compression is carried from here on (docs/notebook/fracture.md, "Closed faces") */
    return scene->fracture.side_friction < 0 ? usual : scene->fracture.side_friction;
}

brc_criterion_kind brc_criterion_of(const brc_fracture *fracture, brc_model_kind model)
{
    if (fracture->kind != BRC_CRITERION_AUTO) return fracture->kind;
    return brc_model_traits_of(model)->spheres ? BRC_CRITERION_PRINCIPAL : BRC_CRITERION_BOND_NORMAL;
}

#define BRC_MODEL(kind, name, word, meaning) extern const brc_model_traits brc_##word##_traits;
#include "models.def"
#undef BRC_MODEL

const brc_model_traits *brc_model_traits_of(brc_model_kind kind)
{
#define BRC_MODEL(kind, name, word, meaning) [kind] = &brc_##word##_traits,
    static const brc_model_traits *const traits[] = {
#include "models.def"
    };
#undef BRC_MODEL
    return traits[kind];
}

const char *brc_model_name(brc_model_kind kind)
{
#define BRC_MODEL(kind, name, word, meaning) [kind] = name,
    static const char *const names[] = {
#include "models.def"
    };
#undef BRC_MODEL
    return kind < BRC_N_MODELS ? names[kind] : "";
}

double brc_table_value(const brc_table *table, double t)
{
    if (table->n == 0) return 1;
    if (t <= table->time[0]) return table->value[0];
    int low = 0, high = table->n - 1;
    if (t >= table->time[high]) return table->value[high];
    while (high - low > 1) { /* time[low] <= t < time[high] */
        const int middle = low + (high - low) / 2;
        if (table->time[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    const double part = (t - table->time[low]) / (table->time[high] - table->time[low]);
    return table->value[low] + part * (table->value[high] - table->value[low]);
}

/* Units of sensors, and of the slope of one against another: [numerator][denominator]. */
enum {
    NEWTON,
    METRE,
    PURE,
    RADIAN,
    PASCAL,
    JOULE,
    METRE_PER_SECOND,
    HERTZ,
    NEWTON_METRE,
    SQUARE_METRE,
    RADIAN_PER_SECOND,
    N_UNITS
};
static const char *const UNIT[N_UNITS] = {"N", "m", "-", "rad", "Pa", "J", "m/s", "Hz", "N m", "m^2", "rad/s"};
static const char *const RATE_UNIT[N_UNITS] = {"N/s",   "m/s",  "1/s",   "rad/s", "Pa/s",   "W",
                                               "m/s^2", "Hz/s", "N m/s", "m^2/s", "rad/s^2"};
static const char *const INTEGRAL_UNIT[N_UNITS] = {"N s", "m s", "s",     "rad s", "Pa s", "J s",
                                                   "m",   "-",   "N m s", "m^2 s", "rad"};
static const char *const SLOPE_UNIT[N_UNITS][N_UNITS] = {
    {"-", "N/m", "N", "N/rad", "N/Pa", "N/J", "N s/m", "N/Hz", "1/m", "N/m^2", "N s/rad"},
    {"m/N", "-", "m", "m/rad", "m/Pa", "m/J", "s", "m/Hz", "1/N", "1/m", "m s/rad"},
    {"1/N", "1/m", "-", "1/rad", "1/Pa", "1/J", "s/m", "1/Hz", "1/N/m", "1/m^2", "s/rad"},
    {"rad/N", "rad/m", "rad", "-", "rad/Pa", "rad/J", "rad s/m", "rad/Hz", "rad/N/m", "rad/m^2", "s"},
    {"Pa/N", "Pa/m", "Pa", "Pa/rad", "-", "Pa/J", "Pa s/m", "Pa/Hz", "Pa/N/m", "Pa/m^2", "Pa s/rad"},
    {"J/N", "J/m", "J", "J/rad", "J/Pa", "-", "J s/m", "J/Hz", "-", "J/m^2", "J s/rad"},
    {"m/s/N", "1/s", "m/s", "m/s/rad", "m/s/Pa", "m/s/J", "-", "m/s/Hz", "1/N/s", "1/m/s", "m/rad"},
    {"Hz/N", "Hz/m", "Hz", "Hz/rad", "Hz/Pa", "Hz/J", "Hz s/m", "-", "Hz/N/m", "Hz/m^2", "Hz s/rad"},
    {"m", "N", "N m", "N m/rad", "m^3", "-", "N s", "N m/Hz", "-", "N/m", "N m s/rad"},
    {"m^2/N", "m", "m^2", "m^2/rad", "m^2/Pa", "m^2/J", "m s", "m^2/Hz", "m/N", "-", "m^2 s/rad"},
    {"rad/s/N", "rad/s/m", "rad/s", "1/s", "rad/s/Pa", "rad/s/J", "rad/m", "rad", "rad/N/m/s", "rad/s/m^2", "-"},
};

static int unit_of_striker(const char *term)
{
    static const struct {
        const char *term;
        int unit;
    } TERM[] = {{"position", METRE},      {"displacement", METRE},     {"velocity", METRE_PER_SECOND},
                {"rotation", RADIAN},     {"spin", RADIAN_PER_SECOND}, {"force", NEWTON},
                {"torque", NEWTON_METRE}, {"energy", JOULE},           {"applied", NEWTON}};
    for (size_t k = 0; k < sizeof TERM / sizeof *TERM; ++k)
        if (strcmp(term, TERM[k].term) == 0) return TERM[k].unit;
    return PURE;
}

static int unit_index(const brc_sensor *sensor)
{
    switch (sensor->kind) {
    case BRC_SENSOR_REACTION: return NEWTON;
    case BRC_SENSOR_FACE_MEAN: return METRE;
    case BRC_SENSOR_FACE_STRAIN: return PURE;
    case BRC_SENSOR_FACE_TWIST: return RADIAN;
    case BRC_SENSOR_STRESS: return PASCAL;
    case BRC_SENSOR_STRAIN: return PURE;
    case BRC_SENSOR_ENERGY: return strcmp(sensor->term, "closure") == 0 ? PURE : JOULE;
    case BRC_SENSOR_POINT: return METRE;
    case BRC_SENSOR_POINT_VELOCITY: return METRE_PER_SECOND;
    case BRC_SENSOR_MOMENT: return NEWTON_METRE;
    case BRC_SENSOR_TURN: return RADIAN;
    case BRC_SENSOR_RADIAL_STRESS: return PASCAL;
    case BRC_SENSOR_VOLUME_STRAIN: return PURE;
    case BRC_SENSOR_FRACTURE: return strcmp(sensor->term, "crack_area") == 0 ? SQUARE_METRE : PURE;
    case BRC_SENSOR_CRACK_TIP:
    case BRC_SENSOR_OPENING: return METRE;
    case BRC_SENSOR_SPIN: return RADIAN_PER_SECOND;
    case BRC_SENSOR_STRIKER: return unit_of_striker(sensor->term);
    case BRC_SENSOR_CONTACT:
        return strcmp(sensor->term, "penetration") == 0 ? METRE : strcmp(sensor->term, "force") == 0 ? NEWTON : PURE;
    case BRC_SENSOR_MODE: return HERTZ;
    }
    return PURE;
}

const char *brc_sensor_unit(const brc_sensor *sensor)
{
    return UNIT[unit_index(sensor)];
}

static const brc_sensor *find_sensor(const brc_scene *scene, const char *name)
{
    for (int i = 0; i < scene->n_sensors; ++i)
        if (strcmp(scene->sensors[i].name, name) == 0) return &scene->sensors[i];
    return NULL;
}

const char *brc_measure_unit(const brc_scene *scene, const brc_measure *measure)
{
    switch (measure->kind) {
    case BRC_MEASURE_E:
    case BRC_MEASURE_K:
    case BRC_MEASURE_G: return "Pa";
    case BRC_MEASURE_NU: return "-";
    case BRC_MEASURE_FREQUENCY: return "Hz";
    case BRC_MEASURE_DURATION: return "s";
    case BRC_MEASURE_PEAK:
    case BRC_MEASURE_AT_FIRST_BREAK:
        if (measure->area_set[0]) return "Pa";
        break;
    case BRC_MEASURE_MEAN:
    case BRC_MEASURE_RATE:
    case BRC_MEASURE_INTEGRAL:
    case BRC_MEASURE_SLOPE: break;
    }
    const brc_sensor *y = find_sensor(scene, measure->y);
    const brc_sensor *x = find_sensor(scene, measure->x);
    if (!y || (measure->kind == BRC_MEASURE_SLOPE && !x)) return "-";
    if (measure->kind == BRC_MEASURE_INTEGRAL) return INTEGRAL_UNIT[unit_index(y)];
    if (measure->kind == BRC_MEASURE_RATE) return RATE_UNIT[unit_index(y)];
    return measure->kind == BRC_MEASURE_SLOPE ? SLOPE_UNIT[unit_index(y)][unit_index(x)] : brc_sensor_unit(y);
}

/* The first with these elements, in the order of models.def. */
static brc_model_kind first_of(bool spheres)
{
    for (int k = 0; k < BRC_N_MODELS; ++k)
        if (brc_model_traits_of((brc_model_kind)k)->spheres == spheres) return (brc_model_kind)k;
    return BRC_N_MODELS;
}

brc_model_kind brc_model_of_beams(void)
{
    return first_of(true);
}

brc_model_kind brc_model_of_cells(void)
{
    return first_of(false);
}
