/* Handing out loads, initial fields and sensors to the parts of a scene. */
#include "split.h"
#include "../core/loaded_faces.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct share {
    brc_context *context;
    const brc_split *split;
    const brc_domain *const *domain; /* [n] */
    bool *has;                       /* [n] of what is handed out now */
} share;

/* The set of a part, NULL where it has no members there. */
static const brc_set *set_in(const share *s, int32_t k, const char *name)
{
    const int32_t index = brc_domain_find_set(s->domain[k], name);
    return index >= 0 && s->domain[k]->sets[index].n_members > 0 ? &s->domain[k]->sets[index] : NULL;
}

/* Which parts have members of the set (without a name: all parts), into s->has; returns how many. */
static int32_t find_parts(share *s, const char *name)
{
    int32_t n = 0;
    for (int32_t k = 0; k < s->split->n; ++k)
        n += s->has[k] = name[0] == '\0' || set_in(s, k, name);
    return n;
}

/* Does a load per area act in part k though no whole face of its set lies there? Faces that the set's region cuts are
 * loaded as far as they reach in. */
static brc_status cuts_faces(const share *s, int32_t k, const brc_load *load, bool *out)
{
    const brc_domain *d = s->domain[k];
    const int32_t index = brc_domain_find_set(d, load->set);
    brc_loaded_face *loaded = NULL;
    int64_t n = 0;
    *out = false;
    if ((load->kind != BRC_LOAD_TRACTION && load->kind != BRC_LOAD_PRESSURE) || index < 0 ||
        d->sets[index].kind != BRC_SET_FACES)
        return BRC_OK;
    const brc_status status = brc_loaded_faces(s->context, s->split->part[k].scene, d, &d->sets[index], &loaded, &n);
    brc_memory_free(loaded);
    *out = n > 0;
    return status;
}

/* Which parts the load acts in, into s->has; *n: how many. */
static brc_status find_load_parts(share *s, const brc_load *load, int32_t *n)
{
    *n = find_parts(s, load->set);
    for (int32_t k = 0; k < s->split->n; ++k) {
        if (s->has[k]) continue;
        BRC_TRY(cuts_faces(s, k, load, &s->has[k]));
        *n += s->has[k];
    }
    return BRC_OK;
}

/* No part has members of the set: the first that knows its name, or the first of all, says so. */
static void give_to_one(share *s, const char *name)
{
    int32_t first = 0;
    for (int32_t k = s->split->n - 1; k >= 0; --k)
        if (brc_domain_find_set(s->domain[k], name) >= 0) first = k;
    s->has[first] = true;
}

static double mass_of(const brc_scene *scene, const brc_domain *domain, int64_t e)
{
    const int32_t b = domain->body[e] < scene->n_bodies ? domain->body[e] : 0;
    return domain->volume[e] * scene->materials[brc_body_material(&scene->bodies[b], domain->region[e])].density;
}

double brc_split_mass(const brc_scene_part *part, const brc_domain *domain)
{
    double sum = 0;
    for (int64_t e = 0; e < domain->n_elements; ++e)
        sum += mass_of(part->scene, domain, e);
    return sum;
}

/* What counts for a total that is shared out: elements of the set (owners of its faces, each once), or their mass
 * [kg]. */
static double weight_in(const share *s, int32_t k, const brc_load *load)
{
    const brc_domain *d = s->domain[k];
    const brc_set *set = set_in(s, k, load->set);
    double sum = 0;
    for (int64_t m = 0, before = -1; m < set->n_members; ++m) { /* faces stand in the order of their elements */
        const int64_t e = set->kind == BRC_SET_ELEMENTS ? set->members[m] : d->free_element[set->members[m]];
        if (e != before)
            sum += load->share == BRC_SHARE_MASS && !load->radial ? mass_of(s->split->part[k].scene, d, e) : 1;
        before = e;
    }
    return sum;
}

static brc_status share_load(share *s, int32_t stage, const brc_load *load)
{
    int32_t n;
    double all = 0;
    BRC_TRY(find_load_parts(s, load, &n));
    if (n == 0) give_to_one(s, load->set);
    const bool total = n > 1 && load->kind == BRC_LOAD_ELEMENT_FORCE;
    for (int32_t k = 0; total && k < s->split->n; ++k)
        all += s->has[k] ? weight_in(s, k, load) : 0;
    for (int32_t k = 0; k < s->split->n; ++k) {
        if (!s->has[k]) continue;
        brc_stage *to = &s->split->part[k].scene->stages[stage];
        brc_load *given = &to->loads[to->n_loads++];
        *given = *load;
        if (!total) continue;
        const double part = weight_in(s, k, load) / all;
        for (int c = 0; c < 3; ++c)
            given->value[c] *= part;
        given->radial_force *= part;
    }
    return BRC_OK;
}

static brc_status share_initial(share *s, int32_t stage, const brc_initial *field)
{
    if (field->kind == BRC_INITIAL_FILE && field->set[0] == '\0')
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "stage '%s': a file of initial values has a row for every element of one model, the bodies "
                        "have %d models; give each "
                        "model its own file and a set of its elements",
                        s->split->scene->stages[stage].name, (int)s->split->n);
    if (find_parts(s, field->set) == 0) give_to_one(s, field->set);
    for (int32_t k = 0; k < s->split->n; ++k) {
        brc_stage *to = &s->split->part[k].scene->stages[stage];
        if (s->has[k]) to->initials[to->n_initials++] = *field;
    }
    return BRC_OK;
}

/* Ties go to the earlier part. */
static int32_t nearest_part(const share *s, const double point[3])
{
    int32_t best = 0;
    double least = INFINITY;
    for (int32_t k = 0; k < s->split->n; ++k)
        for (int64_t e = 0; e < s->domain[k]->n_elements; ++e) {
            double square = 0;
            for (int c = 0; c < 3; ++c)
                square +=
                    (s->domain[k]->position[3 * e + c] - point[c]) * (s->domain[k]->position[3 * e + c] - point[c]);
            if (square < least) {
                least = square;
                best = k;
            }
        }
    return best;
}

brc_combine brc_split_combine(const brc_sensor *sensor)
{
    switch (sensor->kind) {
    case BRC_SENSOR_REACTION:
    case BRC_SENSOR_MOMENT: return BRC_COMBINE_SUM;
    case BRC_SENSOR_CRACK_TIP: return BRC_COMBINE_LARGEST;
    case BRC_SENSOR_FRACTURE:
        return strcmp(sensor->term, "failure_ratio") == 0      ? BRC_COMBINE_LARGEST
               : strcmp(sensor->term, "largest_fragment") == 0 ? BRC_COMBINE_LARGEST_MASS
                                                               : BRC_COMBINE_SUM;
    case BRC_SENSOR_CONTACT: return strcmp(sensor->term, "penetration") == 0 ? BRC_COMBINE_LARGEST : BRC_COMBINE_SUM;
    case BRC_SENSOR_ENERGY:
    case BRC_SENSOR_MODE: return BRC_COMBINE_WHOLE;
    case BRC_SENSOR_STRIKER:
    case BRC_SENSOR_SPIN:
    case BRC_SENSOR_FACE_MEAN:
    case BRC_SENSOR_FACE_STRAIN:
    case BRC_SENSOR_OPENING:
    case BRC_SENSOR_FACE_TWIST:
    case BRC_SENSOR_STRESS:
    case BRC_SENSOR_STRAIN:
    case BRC_SENSOR_POINT:
    case BRC_SENSOR_POINT_VELOCITY:
    case BRC_SENSOR_TURN:
    case BRC_SENSOR_RADIAL_STRESS:
    case BRC_SENSOR_VOLUME_STRAIN: break;
    }
    return BRC_COMBINE_NONE;
}

/* The parts whose elements the sensor reads, into s->has. */
static brc_status find_sensor_parts(share *s, const brc_sensor *sensor)
{
    const bool at_point = sensor->kind == BRC_SENSOR_POINT || sensor->kind == BRC_SENSOR_POINT_VELOCITY ||
                          sensor->kind == BRC_SENSOR_TURN;
    const brc_combine combine = brc_split_combine(sensor);
    const bool gauge = sensor->kind == BRC_SENSOR_OPENING && sensor->of_points;
    if (gauge && nearest_part(s, sensor->point) != nearest_part(s, sensor->point2))
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "sensor %s: its points lie in bodies of different models; an opening is measured inside one",
                        sensor->name);
    if (at_point || gauge) {
        memset(s->has, 0, (size_t)s->split->n * sizeof *s->has);
        s->has[nearest_part(s, sensor->point)] = true;
        return BRC_OK;
    }
    const int32_t n = find_parts(s, sensor->set);
    if (n == 0) give_to_one(s, sensor->set);
    if (n > 1 && combine == BRC_COMBINE_NONE)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "sensor %s: %s%s%s of %d models, whose means are not of one kind; name a set inside the bodies "
                        "of one model",
                        sensor->name, sensor->set[0] ? "the set \"" : "it averages over the bodies", sensor->set,
                        sensor->set[0] ? "\" spans bodies" : "", (int)n);
    for (int32_t k = 0; n == 1 && sensor->set2[0] && k < s->split->n; ++k)
        if (s->has[k] && !set_in(s, k, sensor->set2) && brc_split_owner(s->split, s->domain, sensor->set2) >= 0)
            return BRC_FAIL(
                s->context, BRC_BAD_INPUT,
                "sensor %s: \"%s\" and \"%s\" lie in bodies of different models; a strain is measured inside one",
                sensor->name, sensor->set, sensor->set2);
    return BRC_OK;
}

static brc_status share_sensor(share *s, int32_t index)
{
    const brc_sensor *sensor = &s->split->scene->sensors[index];
    if (brc_split_combine(sensor) == BRC_COMBINE_WHOLE) return BRC_OK;
    BRC_TRY(find_sensor_parts(s, sensor));
    for (int32_t k = 0; k < s->split->n; ++k) {
        brc_scene_part *part = &s->split->part[k];
        if (!s->has[k]) continue;
        part->sensor[part->scene->n_sensors] = index;
        part->scene->sensors[part->scene->n_sensors++] = *sensor;
    }
    return BRC_OK;
}

static brc_status check_measure(share *s, const brc_measure *measure)
{
    if (measure->area_set[0] == '\0' || find_parts(s, measure->area_set) < 2) return BRC_OK;
    return BRC_FAIL(s->context, BRC_BAD_INPUT,
                    "measure %s: the area of \"%s\" spans bodies of several models; name a set inside those of one",
                    measure->name, measure->area_set);
}

int32_t brc_split_owner(const brc_split *split, const brc_domain *const *domain, const char *set)
{
    const share s = {.split = split, .domain = domain};
    for (int32_t k = 0; k < split->n; ++k)
        if (set_in(&s, k, set)) return k;
    return -1;
}

brc_status brc_split_share(brc_context *context, brc_split *split, const brc_domain *const *domain)
{
    const brc_scene *whole = split->scene;
    share s = {.context = context, .split = split, .domain = domain};
    brc_status status = BRC_OK, one;
    if (split->n == 1) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &s.has, split->n, "parts of a scene"));
    for (int32_t stage = 0; stage < whole->n_stages; ++stage) {
        for (int32_t l = 0; l < whole->stages[stage].n_loads; ++l)
            if ((one = share_load(&s, stage, &whole->stages[stage].loads[l])) != BRC_OK) status = one;
        for (int32_t i = 0; i < whole->stages[stage].n_initials; ++i)
            if ((one = share_initial(&s, stage, &whole->stages[stage].initials[i])) != BRC_OK) status = one;
    }
    for (int32_t i = 0; i < whole->n_sensors; ++i)
        if ((one = share_sensor(&s, i)) != BRC_OK) status = one;
    for (int32_t m = 0; m < whole->n_measures; ++m)
        if ((one = check_measure(&s, &whole->measures[m])) != BRC_OK) status = one;
    brc_memory_free(s.has);
    return status;
}
