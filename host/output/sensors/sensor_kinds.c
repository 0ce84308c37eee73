/* The kinds of sensors: what each looks up before the run and how it is read. */
#include "sensor_means.h"
#include "sphere_box.h"
#include "../../solver/effects/fracture/fragments.h"
#include "../../solver/effects/strikers/strikers.h"
#include "../../solver/effects/contact/touching.h"
#include <math.h>
#include <string.h>

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

static brc_status prepare_round(brc_sensors *sensors, const brc_sensor *sensor, int32_t s)
{
    if (!sensors->domain->radius)
        return BRC_FAIL(
            sensors->context, BRC_BAD_INPUT,
            "sensor %s: its sphere is measured by packed spheres, the elements are cells; use stress and strain",
            sensor->name);
    if (brc_sphere_count_bonded(sensors->domain, &sensors->domain->sets[sensors->first[s]]) == 0)
        return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: no element of \"%s\" has a bond; name another set",
                        sensor->name, sensor->set);
    sensors->distance[s] = brc_sensor_surface_radius(sensors, sensor, &sensors->domain->sets[sensors->first[s]]);
    return BRC_OK;
}

static brc_status of_elements(brc_sensors *sensors, const brc_sensor *sensor, int32_t set, const char *why)
{
    if (set < 0 || sensors->domain->sets[set].kind == BRC_SET_ELEMENTS) return BRC_OK;
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: the set \"%s\" holds faces; %s", sensor->name,
                    sensor->set, why);
}

static brc_status find_striker(brc_sensors *sensors, const brc_sensor *sensor, const char *name, int32_t *out)
{
    for (*out = 0; *out < sensors->scene->n_strikers; ++*out)
        if (strcmp(sensors->scene->strikers[*out].name, name) == 0) return BRC_OK;
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: there is no striker \"%s\"; define it under strikers",
                    sensor->name, name);
}

/* The way out of the solid at a set, along the component: that of its faces' mean normal; of elements, away from the
 * middle of the bodies. */
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
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT,
                    "sensor %s: \"%s\" looks neither way along %c, so that compression has no side there; leave `sign` "
                    "out, or name the set of one side",
                    sensor->name, sensor->set, 'x' + c);
}

static brc_status prepare_reaction(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    if (sensor->set[0] == '\0')
        return BRC_FAIL(sensors->context, BRC_BAD_INPUT,
                        "sensor %s: a reaction needs the set whose prescribed motion it belongs to", sensor->name);
    BRC_TRY(find_set(sensors, sensor, sensor->set, &sensors->first[s]));
    if (sensor->sign != BRC_SIGN_COMPRESSION) return BRC_OK;
    return prepare_sign(sensors, sensor, sensors->first[s], &sensors->outward[s]);
}

static brc_status prepare_elements(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    BRC_TRY(find_set(sensors, sensor, sensor->set, &sensors->first[s]));
    return of_elements(sensors, sensor, sensors->first[s], "stress and strain are averaged over elements");
}

static brc_status prepare_face_mean(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    int32_t set;
    BRC_TRY(find_set(sensors, sensor, sensor->set, &set));
    BRC_TRY(find_patch(sensors, set, &sensors->first[s]));
    if (sensor->sign != BRC_SIGN_COMPRESSION) return BRC_OK;
    return prepare_sign(sensors, sensor, set, &sensors->outward[s]);
}

static brc_status prepare_face_strain(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    int32_t set;
    BRC_TRY(find_set(sensors, sensor, sensor->set, &set));
    BRC_TRY(find_patch(sensors, set, &sensors->first[s]));
    BRC_TRY(find_set(sensors, sensor, sensor->set2, &set));
    BRC_TRY(find_patch(sensors, set, &sensors->second[s]));
    return prepare_strain(sensors, sensor, s);
}

static brc_status prepare_face_twist(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    int32_t set;
    BRC_TRY(find_set(sensors, sensor, sensor->set, &set));
    BRC_TRY(find_patch(sensors, set, &sensors->first[s]));
    if (hypot(hypot(sensor->axis[0], sensor->axis[1]), sensor->axis[2]) > 0) return BRC_OK;
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: a twist needs an axis that is not zero", sensor->name);
}

static brc_status prepare_sphere(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    BRC_TRY(find_set(sensors, sensor, sensor->set, &sensors->first[s]));
    return prepare_round(sensors, sensor, s);
}

static brc_status prepare_point(brc_sensors *sensors, int32_t s)
{
    sensors->first[s] = brc_sensor_nearest_element(sensors->domain, sensors->scene->sensors[s].point);
    return BRC_OK;
}

static brc_status prepare_turn(brc_sensors *sensors, int32_t s)
{
    if (!brc_model_traits_of(sensors->scene->model.kind)->deforms) return prepare_point(sensors, s);
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT,
                    "sensor %s: elements of dlsm have no rotations of their own; use face_twist",
                    sensors->scene->sensors[s].name);
}

static brc_status prepare_cracks(brc_sensors *sensors, int32_t s)
{
    (void)s;
    if (sensors->cracks) return BRC_OK;
    return brc_crack_sensors_create(sensors->context, sensors->scene, sensors->domain, &sensors->cracks);
}

static brc_status prepare_energy(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    if (!isnan(brc_ledger_term(&(brc_ledger){0}, sensor->term))) return BRC_OK;
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT, "sensor %s: the ledger has no term \"%s\"", sensor->name,
                    sensor->term);
}

static brc_status prepare_spin(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    BRC_TRY(find_set(sensors, sensor, sensor->set, &sensors->first[s]));
    return of_elements(sensors, sensor, sensors->first[s], "a spin is one of elements");
}

static brc_status prepare_striker(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    BRC_TRY(find_striker(sensors, sensor, sensor->set, &sensors->first[s]));
    return sensor->set2[0] ? find_striker(sensors, sensor, sensor->set2, &sensors->second[s]) : BRC_OK;
}

static brc_status prepare_opening(brc_sensors *sensors, int32_t s)
{
    BRC_TRY(brc_opening_prepare(sensors->context, sensors->scene, sensors->domain, &sensors->scene->sensors[s],
                                &sensors->opening[s]));
    if (brc_opening_needs_elements(&sensors->opening[s])) sensors->needs |= BRC_NEEDS_DISPLACEMENT;
    return BRC_OK;
}

static brc_status prepare_contact(brc_sensors *sensors, int32_t s)
{
    if (sensors->scene->has_contact) return BRC_OK;
    return BRC_FAIL(sensors->context, BRC_BAD_INPUT,
                    "sensor %s: nothing touches in a scene without `interactions: {contact: {}}`",
                    sensors->scene->sensors[s].name);
}

#define READ_ARGUMENTS brc_sensors *sensors, brc_simulation *simulation, int32_t s, double *value
static brc_status read_mode(READ_ARGUMENTS)
{
    int32_t n = 0;
    const int32_t index = sensors->scene->sensors[s].index;
    const double *omega = brc_simulation_modes(simulation, &n);
    *value = omega && index >= 0 && index < n ? omega[index] / (2 * M_PI) : NAN;
    return BRC_OK;
}

static brc_status read_reaction(READ_ARGUMENTS)
{
    double reaction[3];
    BRC_TRY(brc_simulation_reaction(simulation, sensors->first[s], reaction));
    *value = reaction[sensors->scene->sensors[s].component];
    return BRC_OK;
}

static brc_status read_moment(READ_ARGUMENTS)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    double moment[3];
    BRC_TRY(brc_simulation_reaction_moment(simulation, sensors->first[s], sensor->point, moment));
    *value = moment[sensor->component];
    return BRC_OK;
}

static brc_status read_turn(READ_ARGUMENTS)
{
    (void)simulation;
    *value =
        brc_sensor_turn(sensors->orientation + 4 * (int64_t)sensors->first[s], sensors->scene->sensors[s].component);
    return BRC_OK;
}

static brc_status read_radial_stress(READ_ARGUMENTS)
{
    (void)simulation;
    const brc_set *set = &sensors->domain->sets[sensors->first[s]];
    *value = brc_sensor_radial_sum(sensors, &sensors->scene->sensors[s], set, sensors->applied) /
             (4 * M_PI * sensors->distance[s] * sensors->distance[s]);
    return BRC_OK;
}

static brc_status read_volume_strain(READ_ARGUMENTS)
{
    (void)simulation;
    const brc_set *set = &sensors->domain->sets[sensors->first[s]];
    *value = 3 * brc_sensor_radial_sum(sensors, &sensors->scene->sensors[s], set, sensors->displacement) /
             ((double)brc_sphere_count_bonded(sensors->domain, set) * sensors->distance[s]);
    return BRC_OK;
}

static brc_status read_face_mean(READ_ARGUMENTS)
{
    (void)simulation;
    *value = sensors->patches[sensors->first[s]].mean_u[sensors->scene->sensors[s].component];
    return BRC_OK;
}

static brc_status read_face_strain(READ_ARGUMENTS)
{
    (void)simulation;
    const int c = sensors->scene->sensors[s].component;
    *value = (sensors->patches[sensors->first[s]].mean_u[c] - sensors->patches[sensors->second[s]].mean_u[c]) /
             sensors->distance[s];
    return BRC_OK;
}

static brc_status read_face_twist(READ_ARGUMENTS)
{
    (void)simulation;
    *value = brc_sensor_twist_angle(sensors, &sensors->scene->sensors[s], &sensors->patches[sensors->first[s]]);
    return BRC_OK;
}

static brc_status read_stress(READ_ARGUMENTS)
{
    (void)simulation;
    *value = brc_sensor_volume_mean(sensors, sensors->stress, sensors->first[s], sensors->scene->sensors[s].component);
    return BRC_OK;
}

static brc_status read_strain(READ_ARGUMENTS)
{
    (void)simulation;
    *value = brc_sensor_volume_mean(sensors, sensors->strain, sensors->first[s], sensors->scene->sensors[s].component);
    return BRC_OK;
}

static brc_status read_energy(READ_ARGUMENTS)
{
    (void)simulation;
    *value = brc_ledger_term(&sensors->ledger, sensors->scene->sensors[s].term);
    return BRC_OK;
}

static brc_status read_point(READ_ARGUMENTS)
{
    (void)simulation;
    *value = sensors->displacement[3 * (int64_t)sensors->first[s] + sensors->scene->sensors[s].component];
    return BRC_OK;
}

static brc_status read_point_velocity(READ_ARGUMENTS)
{
    (void)simulation;
    *value = sensors->velocity[3 * (int64_t)sensors->first[s] + sensors->scene->sensors[s].component];
    return BRC_OK;
}

static brc_status read_cracks(READ_ARGUMENTS)
{
    return brc_crack_sensors_read(sensors->cracks, simulation, &sensors->scene->sensors[s], value);
}

static brc_status read_opening(READ_ARGUMENTS)
{
    return brc_opening_read(&sensors->opening[s], sensors->domain, simulation, sensors->displacement, value);
}

static brc_status read_spin(READ_ARGUMENTS)
{
    brc_fragment whole;
    BRC_TRY(brc_simulation_set_motion(simulation, sensors->first[s], &whole));
    *value = whole.spin[sensors->scene->sensors[s].component];
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
    } terms[] = {{"position", now.position}, {"displacement", now.displacement},
                 {"velocity", now.velocity}, {"rotation", now.rotation},
                 {"spin", now.spin},         {"force", now.force},
                 {"torque", now.torque},     {"applied", now.applied}};
    *value = now.kinetic; /* "energy" */
    for (size_t k = 0; k < sizeof terms / sizeof *terms; ++k)
        if (strcmp(sensor->term, terms[k].term) == 0) *value = terms[k].vector[sensor->component];
    return BRC_OK;
}

/* The same with the other striker's taken off, and the way out of the bodies, for the sign. */
static brc_status read_strikers(READ_ARGUMENTS)
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
                        : striker->force[c] != 0
                            ? -striker->force[c]
                            : brc_simulation_striker_body(simulation, sensors->first[s])->centre[c] - middle;
    sensors->outward[s] = side < 0 ? -1 : 1;
    return BRC_OK;
}

static brc_status read_contact(READ_ARGUMENTS)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    brc_touching now;
    BRC_TRY(brc_simulation_touching(simulation, &now));
    *value = strcmp(sensor->term, "sliding") == 0       ? now.sliding
             : strcmp(sensor->term, "penetration") == 0 ? now.penetration
             : strcmp(sensor->term, "force") == 0       ? now.force
                                                        : now.pairs;
    return BRC_OK;
}

static bool reversed_outside(const brc_sensor *sensor, double outward)
{
    (void)sensor;
    return outward > 0;
}

static bool reversed_striker(const brc_sensor *sensor, double outward)
{
    return strcmp(sensor->term, "force") == 0 ? outward < 0 : outward > 0;
}

static const brc_sensor_reader readers[] = {
    [BRC_SENSOR_REACTION] = {0, prepare_reaction, read_reaction, reversed_outside},
    [BRC_SENSOR_FACE_MEAN] = {0, prepare_face_mean, read_face_mean, reversed_outside},
    [BRC_SENSOR_FACE_STRAIN] = {0, prepare_face_strain, read_face_strain, NULL},
    [BRC_SENSOR_FACE_TWIST] = {0, prepare_face_twist, read_face_twist, NULL},
    [BRC_SENSOR_STRESS] = {BRC_NEEDS_STRESS, prepare_elements, read_stress, NULL},
    [BRC_SENSOR_STRAIN] = {BRC_NEEDS_STRAIN, prepare_elements, read_strain, NULL},
    [BRC_SENSOR_ENERGY] = {BRC_NEEDS_LEDGER, prepare_energy, read_energy, NULL},
    [BRC_SENSOR_POINT] = {BRC_NEEDS_DISPLACEMENT, prepare_point, read_point, NULL},
    [BRC_SENSOR_POINT_VELOCITY] = {BRC_NEEDS_VELOCITY, prepare_point, read_point_velocity, NULL},
    [BRC_SENSOR_MOMENT] = {0, prepare_reaction, read_moment, NULL},
    [BRC_SENSOR_TURN] = {BRC_NEEDS_ORIENTATION, prepare_turn, read_turn, NULL},
    [BRC_SENSOR_RADIAL_STRESS] = {BRC_NEEDS_APPLIED, prepare_sphere, read_radial_stress, NULL},
    [BRC_SENSOR_VOLUME_STRAIN] = {BRC_NEEDS_DISPLACEMENT, prepare_sphere, read_volume_strain, NULL},
    [BRC_SENSOR_FRACTURE] = {0, prepare_cracks, read_cracks, NULL},
    [BRC_SENSOR_CRACK_TIP] = {0, prepare_cracks, read_cracks, NULL},
    [BRC_SENSOR_SPIN] = {0, prepare_spin, read_spin, NULL},
    [BRC_SENSOR_STRIKER] = {0, prepare_striker, read_strikers, reversed_striker},
    [BRC_SENSOR_CONTACT] = {0, prepare_contact, read_contact, NULL},
    [BRC_SENSOR_OPENING] = {0, prepare_opening, read_opening, NULL}, /* and displacements where it asks for elements */
    [BRC_SENSOR_MODE] = {0, NULL, read_mode, NULL},
};

const brc_sensor_reader *brc_sensor_reader_of(brc_sensor_kind kind)
{
    const size_t k = (size_t)kind;
    return k < sizeof readers / sizeof readers[0] && readers[k].read ? &readers[k] : NULL;
}
