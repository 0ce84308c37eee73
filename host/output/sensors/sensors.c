/* Sensors. Means over faces are weighted with face areas, means over cells with their volumes; spheres of a wall count alike where they
 * stand for a face; those without bonds, which are held still, count nowhere. All sums run in the order of the set's members, so equal states give equal bytes. */
#include "sensors.h"
#include "crack_sensors.h"
#include "opening.h"
#include "sensor_patch.h"
#include "sphere_box.h"
#include "../../base/memory.h"
#include "../../solver/fragments.h"
#include "../../solver/strikers.h"
#include "../../solver/touching.h"
#include <math.h>
#include <string.h>

struct brc_sensors {
    brc_context *context;
    const brc_scene *scene;
    const brc_domain *domain;
    int32_t n_patches;
    brc_sensor_patch *patches; /* [2 n_sensors] room, n_patches used */
    int32_t
        *first; /* [n_sensors] patch, or domain set (reaction, stress, strain), or element (points); -1: all, none */
    int32_t *second;                 /* [n_sensors] patch of set2 */
    brc_opening *opening;            /* [n_sensors] of openings */
    double *outward;                 /* [n_sensors] sets and strikers whose `sign` is compression: +-1, the way out of the solid along the component */
    double *distance;                /* [n_sensors] face strain: reference distance along the component; spheres: R [m] */
    double *displacement, *velocity; /* [n_elements][3] or NULL */
    double *strain, *stress;         /* [n_elements][6] or NULL */
    double *orientation;             /* [n_elements][4] or NULL */
    double *applied;                 /* element forces [n_elements][3] or NULL */
    bool needs_ledger;
    brc_crack_sensors *cracks; /* NULL: no sensor watches cracks */
};

/* The patch of a set, made at its first use. */
static brc_status find_patch(brc_sensors *sensors, int32_t set, int32_t *out)
{
    for (*out = 0; *out < sensors->n_patches; ++*out)
        if (sensors->patches[*out].set == set) return BRC_OK;
    BRC_TRY(brc_sensor_patch_of_set(sensors->context, sensors->domain, set, &sensors->patches[*out]));
    ++sensors->n_patches;
    return BRC_OK;
}

static brc_status find_set(brc_sensors *sensors, const brc_sensor *sensor, const char *name, int32_t *out)
{
    *out = -1;
    if (name[0] == '\0') return BRC_OK;
    *out = brc_domain_find_set(sensors->domain, name);
    if (*out < 0)
        return BRC_FAIL(sensors->context, BRC_BAD_INPUT,
                        "sensor %s: there is no set \"%s\" in the domain; name a wall or one of the scene's sets",
                        sensor->name, name);
    if (sensors->domain->sets[*out].n_members == 0)
        return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: the set \"%s\" is empty", sensor->name, name);
    return BRC_OK;
}

/* Ties go to the smaller id. */
static int32_t nearest_element(const brc_domain *d, const double point[3])
{
    int32_t best = 0;
    double least = INFINITY;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double square = 0;
        for (int c = 0; c < 3; ++c)
            square += (d->position[3 * e + c] - point[c]) * (d->position[3 * e + c] - point[c]);
        if (square < least) {
            least = square;
            best = (int32_t)e;
        }
    }
    return best;
}

static brc_status prepare_strain(brc_sensors *sensors, const brc_sensor *sensor, int32_t s)
{
    const brc_sensor_patch *a = &sensors->patches[sensors->first[s]];
    const brc_sensor_patch *b = &sensors->patches[sensors->second[s]];
    const int c = sensor->component;
    const bool spheres = sensors->domain->radius && a->set >= 0 && b->set >= 0;
    sensors->distance[s] = a->mean_position[c] - b->mean_position[c];
    double extent = 0;
    for (int k = 0; k < 3; ++k)
        extent = fmax(extent, sensors->domain->bounds[1][k] - sensors->domain->bounds[0][k]);
    if (fabs(sensors->distance[s]) > 1e-9 * extent) {
        if (spheres) sensors->distance[s] = brc_sphere_box_length(sensors->domain, a->set, b->set, c);
        return BRC_OK;
    }
    return BRC_FAIL(
        sensors->context, BRC_BAD_INPUT,
        "sensor %s: the sets \"%s\" and \"%s\" lie at the same %c (%.9g m); a strain needs two places along "
        "its component",
        sensor->name, sensor->set, sensor->set2, 'x' + c, a->mean_position[c]);
}

/* R of a sphere by its surface elements [m]. */
static double surface_radius(const brc_sensors *sensors, const brc_sensor *sensor, const brc_set *set)
{
    double sum = 0;
    for (int64_t k = 0; k < set->n_members; ++k) {
        const double *x = sensors->domain->position + 3 * (int64_t)set->members[k];
        if (brc_sphere_is_bonded(sensors->domain, set->members[k]))
            sum += hypot(hypot(x[0] - sensor->point[0], x[1] - sensor->point[1]), x[2] - sensor->point[2]);
    }
    return sum / (double)brc_sphere_count_bonded(sensors->domain, set) + brc_sphere_mean_diameter(sensors->domain) / 2;
}

/* Sum over the set of a vector's radial components. */
static double radial_sum(const brc_sensors *sensors, const brc_sensor *sensor, const brc_set *set, const double *vector)
{
    double sum = 0;
    for (int64_t k = 0; k < set->n_members; ++k) {
        const int64_t e = set->members[k];
        double r[3], along = 0, square = 0;
        for (int c = 0; c < 3; ++c) {
            r[c] = sensors->domain->position[3 * e + c] - sensor->point[c];
            along += r[c] * vector[3 * e + c];
            square += r[c] * r[c];
        }
        if (square > 0) sum += along / sqrt(square);
    }
    return sum;
}

static brc_status prepare_round(brc_sensors *sensors, const brc_sensor *sensor, int32_t s)
{
    if (!sensors->domain->radius)
        return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: its sphere is measured by packed spheres, the elements are cells; use stress and strain",
                        sensor->name);
    if (brc_sphere_count_bonded(sensors->domain, &sensors->domain->sets[sensors->first[s]]) == 0)
        return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: no element of \"%s\" has a bond; name another set", sensor->name, sensor->set);
    sensors->distance[s] = surface_radius(sensors, sensor, &sensors->domain->sets[sensors->first[s]]);
    return BRC_OK;
}

static brc_status of_elements(brc_sensors *sensors, const brc_sensor *sensor, int32_t set, const char *why)
{
    if (set < 0 || sensors->domain->sets[set].kind == BRC_SET_ELEMENTS) return BRC_OK;
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: the set \"%s\" holds faces; %s", sensor->name, sensor->set, why);
}

static brc_status find_striker(brc_sensors *sensors, const brc_sensor *sensor, const char *name, int32_t *out)
{
    for (*out = 0; *out < sensors->scene->n_strikers; ++*out)
        if (strcmp(sensors->scene->strikers[*out].name, name) == 0) return BRC_OK;
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: there is no striker \"%s\"; define it under strikers", sensor->name, name);
}

/* The way out of the solid at a set, along the component: that of its faces' mean normal; of elements, away from the middle of the bodies. */
static brc_status prepare_sign(brc_sensors *sensors, const brc_sensor *sensor, int32_t set, double *outward)
{
    const brc_domain *d = sensors->domain;
    const int c = sensor->component;
    const double middle = 0.5 * (d->bounds[0][c] + d->bounds[1][c]);
    double sum = 0, size = 0;
    for (int64_t k = 0; set >= 0 && k < d->sets[set].n_members; ++k) {
        const bool faces = d->sets[set].kind == BRC_SET_FACES;
        const double *vector = (faces ? d->free_area_vector : d->position) + 3 * (int64_t)d->sets[set].members[k];
        sum += faces ? vector[c] : vector[c] - middle;
        size += faces ? hypot(hypot(vector[0], vector[1]), vector[2]) : fabs(vector[c] - middle);
    }
    *outward = sum < 0 ? -1 : 1;
    if (fabs(sum) > 1e-3 * size) return BRC_OK;
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: \"%s\" looks neither way along %c, so that compression has no side there; leave `sign` out, or name the set of one side",
                    sensor->name, sensor->set, 'x' + c);
}

static brc_status prepare(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    int32_t set;
    sensors->first[s] = sensors->second[s] = -1;
    switch (sensor->kind) {
    case BRC_SENSOR_REACTION:
    case BRC_SENSOR_MOMENT:
        if (sensor->set[0] == '\0')
            return BRC_FAIL(sensors->context, BRC_BAD_INPUT,
                            "sensor %s: a reaction needs the set whose prescribed motion it belongs to", sensor->name);
        BRC_TRY(find_set(sensors, sensor, sensor->set, &sensors->first[s]));
        return sensor->sign == BRC_SIGN_COMPRESSION ? prepare_sign(sensors, sensor, sensors->first[s], &sensors->outward[s]) : BRC_OK;
    case BRC_SENSOR_STRESS:
    case BRC_SENSOR_STRAIN:
        BRC_TRY(find_set(sensors, sensor, sensor->set, &sensors->first[s]));
        return of_elements(sensors, sensor, sensors->first[s], "stress and strain are averaged over elements");
    case BRC_SENSOR_FACE_MEAN:
    case BRC_SENSOR_FACE_STRAIN:
    case BRC_SENSOR_FACE_TWIST:
        BRC_TRY(find_set(sensors, sensor, sensor->set, &set));
        BRC_TRY(find_patch(sensors, set, &sensors->first[s]));
        if (sensor->kind == BRC_SENSOR_FACE_TWIST &&
            !(hypot(hypot(sensor->axis[0], sensor->axis[1]), sensor->axis[2]) > 0))
            return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: a twist needs an axis that is not zero",
                            sensor->name);
        if (sensor->kind == BRC_SENSOR_FACE_MEAN && sensor->sign == BRC_SIGN_COMPRESSION) BRC_TRY(prepare_sign(sensors, sensor, set, &sensors->outward[s]));
        if (sensor->kind != BRC_SENSOR_FACE_STRAIN) return BRC_OK;
        BRC_TRY(find_set(sensors, sensor, sensor->set2, &set));
        BRC_TRY(find_patch(sensors, set, &sensors->second[s]));
        return prepare_strain(sensors, sensor, s);
    case BRC_SENSOR_RADIAL_STRESS:
    case BRC_SENSOR_VOLUME_STRAIN:
        BRC_TRY(find_set(sensors, sensor, sensor->set, &sensors->first[s]));
        return prepare_round(sensors, sensor, s);
    case BRC_SENSOR_TURN:
        if (sensors->scene->model.kind == BRC_MODEL_DLSM)
            return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: elements of dlsm have no rotations of their own; use face_twist", sensor->name);
        sensors->first[s] = nearest_element(sensors->domain, sensor->point);
        return BRC_OK;
    case BRC_SENSOR_FRACTURE:
    case BRC_SENSOR_CRACK_TIP: return sensors->cracks ? BRC_OK : brc_crack_sensors_create(sensors->context, sensors->scene, sensors->domain, &sensors->cracks);
    case BRC_SENSOR_POINT:
    case BRC_SENSOR_POINT_VELOCITY: sensors->first[s] = nearest_element(sensors->domain, sensor->point); return BRC_OK;
    case BRC_SENSOR_ENERGY:
        if (isnan(brc_ledger_term(&(brc_ledger){0}, sensor->term)))
            return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: the ledger has no term \"%s\"", sensor->name,
                            sensor->term);
        return BRC_OK;
    case BRC_SENSOR_MODE: return BRC_OK;
    case BRC_SENSOR_SPIN:
        BRC_TRY(find_set(sensors, sensor, sensor->set, &sensors->first[s]));
        return of_elements(sensors, sensor, sensors->first[s], "a spin is one of elements");
    case BRC_SENSOR_STRIKER:
        BRC_TRY(find_striker(sensors, sensor, sensor->set, &sensors->first[s]));
        return sensor->set2[0] ? find_striker(sensors, sensor, sensor->set2, &sensors->second[s]) : BRC_OK;
    case BRC_SENSOR_OPENING: return brc_opening_prepare(sensors->context, sensors->scene, sensors->domain, sensor, &sensors->opening[s]);
    case BRC_SENSOR_CONTACT:
        if (sensors->scene->has_contact) return BRC_OK;
        return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: nothing touches in a scene without `interactions: {contact: {}}`", sensor->name);
    }
    return BRC_FAIL(sensors->context, BRC_INTERNAL, "sensor %s: unknown kind %d", sensor->name, (int)sensor->kind);
}

/* Arrays for the fields that some sensor reads, and for no others. */
static brc_status allocate_fields(brc_sensors *sensors)
{
    bool displacement = false, velocity = false, strain = false, stress = false, orientation = false, applied = false;
    for (int32_t s = 0; s < sensors->scene->n_sensors; ++s) {
        const brc_sensor_kind kind = sensors->scene->sensors[s].kind;
        displacement |= kind == BRC_SENSOR_POINT || (kind == BRC_SENSOR_OPENING && brc_opening_needs_elements(&sensors->opening[s])) || kind == BRC_SENSOR_VOLUME_STRAIN;
        orientation |= kind == BRC_SENSOR_TURN;
        applied |= kind == BRC_SENSOR_RADIAL_STRESS;
        velocity |= kind == BRC_SENSOR_POINT_VELOCITY;
        strain |= kind == BRC_SENSOR_STRAIN;
        stress |= kind == BRC_SENSOR_STRESS;
        sensors->needs_ledger |= kind == BRC_SENSOR_ENERGY;
    }
    for (int32_t p = 0; p < sensors->n_patches; ++p)
        displacement |= !sensors->patches[p].faces;
    const int64_t n = sensors->domain->n_elements;
    brc_context *context = sensors->context;
    if (displacement) BRC_TRY(BRC_ALLOCATE(context, &sensors->displacement, 3 * n, "displacement for sensors"));
    if (velocity) BRC_TRY(BRC_ALLOCATE(context, &sensors->velocity, 3 * n, "velocity for sensors"));
    if (strain) BRC_TRY(BRC_ALLOCATE(context, &sensors->strain, 6 * n, "strain for sensors"));
    if (stress) BRC_TRY(BRC_ALLOCATE(context, &sensors->stress, 6 * n, "stress for sensors"));
    if (orientation) BRC_TRY(BRC_ALLOCATE(context, &sensors->orientation, 4 * n, "orientation for sensors"));
    if (applied) BRC_TRY(BRC_ALLOCATE(context, &sensors->applied, 3 * n, "forces for sensors"));
    return BRC_OK;
}

brc_status brc_sensors_create(brc_context *context, const brc_scene *scene, const brc_domain *domain, brc_sensors **out)
{
    brc_sensors *sensors = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    const int32_t n = scene->n_sensors;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors, 1, "sensors"));
    *sensors = (brc_sensors){.context = context, .scene = scene, .domain = domain};
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->patches, 2 * n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->first, n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->second, n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->opening, n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->outward, n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->distance, n, "sensors"));
    for (int32_t s = 0; s < n; ++s) { /* all wrong sensors in one pass */
        const brc_status one = prepare(sensors, s);
        if (one != BRC_OK) status = one;
    }
    if (status == BRC_OK) status = allocate_fields(sensors);
cleanup:
    if (status != BRC_OK) brc_sensors_free(&sensors);
    *out = sensors;
    return status;
}

void brc_sensors_free(brc_sensors **sensors)
{
    if (!sensors || !*sensors) return;
    for (int32_t p = 0; p < (*sensors)->n_patches; ++p)
        brc_sensor_patch_free(&(*sensors)->patches[p]);
    for (int32_t s = 0; (*sensors)->opening && s < (*sensors)->scene->n_sensors; ++s)
        brc_opening_free(&(*sensors)->opening[s]);
    brc_memory_free((*sensors)->opening);
    brc_memory_free((*sensors)->outward);
    brc_memory_free((*sensors)->patches);
    brc_memory_free((*sensors)->first);
    brc_memory_free((*sensors)->second);
    brc_memory_free((*sensors)->distance);
    brc_memory_free((*sensors)->displacement);
    brc_memory_free((*sensors)->velocity);
    brc_memory_free((*sensors)->strain);
    brc_memory_free((*sensors)->stress);
    brc_memory_free((*sensors)->orientation);
    brc_memory_free((*sensors)->applied);
    brc_crack_sensors_free(&(*sensors)->cracks);
    brc_memory_free(*sensors);
    *sensors = NULL;
}

static brc_status read_fields(brc_sensors *sensors, brc_simulation *simulation)
{
    if (sensors->displacement) BRC_TRY(brc_simulation_displacement(simulation, sensors->displacement));
    if (sensors->velocity) BRC_TRY(brc_simulation_velocity(simulation, sensors->velocity));
    if (sensors->orientation) BRC_TRY(brc_simulation_orientation(simulation, sensors->orientation, NULL));
    if (sensors->applied) BRC_TRY(brc_simulation_applied_force(simulation, sensors->applied));
    if (sensors->strain || sensors->stress)
        BRC_TRY(brc_simulation_strain_stress(simulation, sensors->strain, sensors->stress, NULL));
    for (int32_t k = 0; k < sensors->n_patches; ++k)
        BRC_TRY(brc_sensor_patch_read(&sensors->patches[k], sensors->domain, simulation, sensors->displacement));
    return BRC_OK;
}

static double volume_mean(const brc_sensors *sensors, const double *tensor, int32_t set, int32_t component)
{
    const brc_domain *d = sensors->domain;
    const int64_t n = set >= 0 ? d->sets[set].n_members : d->n_elements;
    double sum = 0, volume = 0;
    for (int64_t k = 0; k < n; ++k) {
        const int64_t e = set >= 0 ? d->sets[set].members[k] : k;
        sum += d->volume[e] * tensor[6 * e + component];
        volume += d->volume[e];
    }
    return sum / volume;
}

/* Mean rotation about the axis through `point`: the angle that turns the reference arms r, seen along the axis, into the
 * present ones best: tan(angle) = sum S (r x u).a / sum S r.(r + u), across the axis. To first order in u this is
 * sum S (r x u).a / sum S |r|^2; of a rigid rotation it is the angle itself, however large (within +-pi). */
static double twist_angle(const brc_sensors *sensors, const brc_sensor *sensor, const brc_sensor_patch *p)
{
    const double *a = sensor->axis;
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double axis[3] = {a[0] / length, a[1] / length, a[2] / length};
    double turning = 0, staying = 0;
    for (int64_t k = 0; k < p->n; ++k) {
        double weight;
        const double *x = brc_sensor_patch_point(sensors->domain, p, k, &weight);
        const double *u = brc_sensor_patch_displacement(p, sensors->displacement, k);
        double r[3] = {x[0] - sensor->point[0], x[1] - sensor->point[1], x[2] - sensor->point[2]};
        const double along = r[0] * axis[0] + r[1] * axis[1] + r[2] * axis[2];
        for (int c = 0; c < 3; ++c)
            r[c] -= along * axis[c];
        turning += weight * (axis[0] * (r[1] * u[2] - r[2] * u[1]) + axis[1] * (r[2] * u[0] - r[0] * u[2]) +
                             axis[2] * (r[0] * u[1] - r[1] * u[0]));
        staying += weight * (r[0] * (r[0] + u[0]) + r[1] * (r[1] + u[1]) + r[2] * (r[2] + u[2]));
    }
    return atan2(turning, staying);
}

/* Component of the rotation vector of a unit quaternion: 2 atan2(|v|, w) v / |v|, the short way round. */
static double turn_of(const double q[4], int component)
{
    const double sign = q[0] < 0 ? -1 : 1, length = hypot(hypot(q[1], q[2]), q[3]);
    const double angle = 2 * atan2(length, sign * q[0]);
    return length > 0 ? sign * q[1 + component] * (angle / length) : 0;
}

static double mode_frequency(const brc_simulation *simulation, int32_t index)
{
    int32_t n = 0;
    const double *omega = brc_simulation_modes(simulation, &n);
    return omega && index >= 0 && index < n ? omega[index] / (2 * M_PI) : NAN;
}

static brc_status read_spin(brc_simulation *simulation, int32_t set, int32_t component, double *value)
{
    brc_fragment whole;
    BRC_TRY(brc_simulation_set_motion(simulation, set, &whole));
    *value = whole.spin[component];
    return BRC_OK;
}

/* A quantity of a striker by its name in brc_sensor.term. */
static brc_status read_striker(brc_simulation *simulation, int32_t striker, const brc_sensor *sensor, double *value)
{
    brc_striker_now now;
    BRC_TRY(brc_simulation_striker_now(simulation, striker, &now));
    const struct {
        const char *term;
        const double *vector;
    } terms[] = {{"position", now.position}, {"displacement", now.displacement}, {"velocity", now.velocity}, {"rotation", now.rotation},
                 {"spin", now.spin},         {"force", now.force},               {"torque", now.torque}};
    *value = now.kinetic; /* "energy" */
    for (size_t k = 0; k < sizeof terms / sizeof *terms; ++k)
        if (strcmp(sensor->term, terms[k].term) == 0) *value = terms[k].vector[sensor->component];
    return BRC_OK;
}

/* The same with the other striker's taken off, and the way out of the bodies, for the sign. */
static brc_status read_strikers(brc_sensors *sensors, brc_simulation *simulation, int32_t s, double *value)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    const int c = sensor->component;
    double other = 0;
    BRC_TRY(read_striker(simulation, sensors->first[s], sensor, value));
    if (sensors->second[s] >= 0) BRC_TRY(read_striker(simulation, sensors->second[s], sensor, &other));
    *value -= other;
    if (sensor->sign == BRC_SIGN_AXIS) return BRC_OK;
    const brc_striker *striker = &sensors->scene->strikers[sensors->first[s]];
    const double middle = 0.5 * (sensors->domain->bounds[0][c] + sensors->domain->bounds[1][c]);
    const double side = striker->is_plane           ? -striker->normal[c]
                        : striker->velocity[c] != 0 ? -striker->velocity[c] /* it comes from where it is */
                                                    : brc_simulation_striker_body(simulation, sensors->first[s])->centre[c] - middle;
    sensors->outward[s] = side < 0 ? -1 : 1;
    return BRC_OK;
}

/* Is the value that is positive in compression the negative of the one along the component? */
static bool is_reversed(const brc_sensor *sensor, double outward)
{
    switch (sensor->kind) {
    case BRC_SENSOR_REACTION:
    case BRC_SENSOR_FACE_MEAN: return outward > 0;
    case BRC_SENSOR_STRIKER: return strcmp(sensor->term, "force") == 0 ? outward < 0 : outward > 0;
    default: return true; /* stress and strain */
    }
}

static brc_status read_contact(brc_simulation *simulation, const brc_sensor *sensor, double *out)
{
    brc_touching now;
    BRC_TRY(brc_simulation_touching(simulation, &now));
    *out = strcmp(sensor->term, "sliding") == 0 ? now.sliding : strcmp(sensor->term, "penetration") == 0 ? now.penetration
           : strcmp(sensor->term, "force") == 0 ? now.force
                                                : now.pairs;
    return BRC_OK;
}

brc_status brc_sensors_evaluate(brc_sensors *sensors, brc_simulation *simulation, double *value)
{
    brc_ledger ledger = {0};
    BRC_TRY(read_fields(sensors, simulation));
    if (sensors->needs_ledger) BRC_TRY(brc_simulation_ledger(simulation, &ledger));
    for (int32_t s = 0; s < sensors->scene->n_sensors; ++s) {
        const brc_sensor *sensor = &sensors->scene->sensors[s];
        const int32_t first = sensors->first[s];
        const int c = sensor->component;
        double reaction[3];
        switch (sensor->kind) {
        case BRC_SENSOR_REACTION:
            BRC_TRY(brc_simulation_reaction(simulation, first, reaction));
            value[s] = reaction[c];
            break;
        case BRC_SENSOR_MOMENT:
            BRC_TRY(brc_simulation_reaction_moment(simulation, first, sensor->point, reaction));
            value[s] = reaction[c];
            break;
        case BRC_SENSOR_TURN: value[s] = turn_of(sensors->orientation + 4 * (int64_t)first, c); break;
        case BRC_SENSOR_RADIAL_STRESS:
            value[s] = radial_sum(sensors, sensor, &sensors->domain->sets[first], sensors->applied) /
                       (4 * M_PI * sensors->distance[s] * sensors->distance[s]);
            break;
        case BRC_SENSOR_VOLUME_STRAIN:
            value[s] = 3 * radial_sum(sensors, sensor, &sensors->domain->sets[first], sensors->displacement) /
                       ((double)brc_sphere_count_bonded(sensors->domain, &sensors->domain->sets[first]) * sensors->distance[s]);
            break;
        case BRC_SENSOR_FACE_MEAN: value[s] = sensors->patches[first].mean_u[c]; break;
        case BRC_SENSOR_FACE_STRAIN:
            value[s] = (sensors->patches[first].mean_u[c] - sensors->patches[sensors->second[s]].mean_u[c]) /
                       sensors->distance[s];
            break;
        case BRC_SENSOR_FACE_TWIST: value[s] = twist_angle(sensors, sensor, &sensors->patches[first]); break;
        case BRC_SENSOR_STRESS: value[s] = volume_mean(sensors, sensors->stress, first, c); break;
        case BRC_SENSOR_STRAIN: value[s] = volume_mean(sensors, sensors->strain, first, c); break;
        case BRC_SENSOR_ENERGY: value[s] = brc_ledger_term(&ledger, sensor->term); break;
        case BRC_SENSOR_POINT: value[s] = sensors->displacement[3 * (int64_t)first + c]; break;
        case BRC_SENSOR_POINT_VELOCITY: value[s] = sensors->velocity[3 * (int64_t)first + c]; break;
        case BRC_SENSOR_FRACTURE:
        case BRC_SENSOR_CRACK_TIP: BRC_TRY(brc_crack_sensors_read(sensors->cracks, simulation, sensor, &value[s])); break;
        case BRC_SENSOR_MODE: value[s] = mode_frequency(simulation, sensor->index); break;
        case BRC_SENSOR_SPIN: BRC_TRY(read_spin(simulation, first, c, &value[s])); break;
        case BRC_SENSOR_STRIKER: BRC_TRY(read_strikers(sensors, simulation, s, &value[s])); break;
        case BRC_SENSOR_OPENING: BRC_TRY(brc_opening_read(&sensors->opening[s], sensors->domain, simulation, sensors->displacement, &value[s])); break;
        case BRC_SENSOR_CONTACT: BRC_TRY(read_contact(simulation, sensor, &value[s])); break;
        }
        if (sensor->sign == BRC_SIGN_COMPRESSION && is_reversed(sensor, sensors->outward[s])) value[s] = 0 - value[s];
    }
    return BRC_OK;
}
