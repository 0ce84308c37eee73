/* All sensors of a scene: prepared, the fields they share fetched once, and read in the scene's order. */
#include "sensors_internal.h"
#include "../../base/memory.h"

static brc_status prepare(brc_sensors *sensors, int32_t s)
{
    const brc_sensor *sensor = &sensors->scene->sensors[s];
    const brc_sensor_reader *reader = brc_sensor_reader_of(sensor->kind);
    sensors->first[s] = sensors->second[s] = -1;
    if (!reader)
        return BRC_FAIL(sensors->context, BRC_INTERNAL, "sensor %s: unknown kind %d", sensor->name, (int)sensor->kind);
    sensors->needs |= reader->needs;
    return reader->prepare ? reader->prepare(sensors, s) : BRC_OK;
}

/* Arrays for the fields that some sensor reads, and for no others. */
static brc_status allocate_fields(brc_sensors *sensors)
{
    for (int32_t p = 0; p < sensors->n_patches; ++p)
        if (!sensors->patches[p].faces) sensors->needs |= BRC_NEEDS_DISPLACEMENT;
    const struct {
        brc_sensor_field field;
        double **array;
        int width;
        const char *what;
    } fields[] = {{BRC_NEEDS_DISPLACEMENT, &sensors->displacement, 3, "displacement for sensors"},
                  {BRC_NEEDS_VELOCITY, &sensors->velocity, 3, "velocity for sensors"},
                  {BRC_NEEDS_STRAIN, &sensors->strain, 6, "strain for sensors"},
                  {BRC_NEEDS_STRESS, &sensors->stress, 6, "stress for sensors"},
                  {BRC_NEEDS_ORIENTATION, &sensors->orientation, 4, "orientation for sensors"},
                  {BRC_NEEDS_APPLIED, &sensors->applied, 3, "forces for sensors"}};
    for (size_t k = 0; k < sizeof fields / sizeof fields[0]; ++k)
        if (sensors->needs & fields[k].field)
            BRC_TRY(BRC_ALLOCATE(sensors->context, fields[k].array, fields[k].width * sensors->domain->n_elements,
                                 fields[k].what));
    return BRC_OK;
}

brc_status brc_sensors_create(brc_context *context, const brc_scene *scene, const brc_domain *domain, brc_sensors **out)
{
    brc_sensors *sensors = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    const int32_t n = scene->n_sensors;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors, 1, "sensors"));
    *sensors = (brc_sensors){.context = context, .scene = scene, .domain = domain, .n_sensors = n};
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->patches, 2 * n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->first, n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->second, n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->opening, n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->outward, n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &sensors->distance, n, "sensors"));
    for (int32_t s = 0; s < n; ++s) { /* all wrong sensors in one pass */
        brc_context_set_place(context, scene->sensors[s].place);
        const brc_status one = prepare(sensors, s);
        brc_context_set_place(context, NULL);
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
    for (int32_t s = 0; (*sensors)->opening && s < (*sensors)->n_sensors; ++s)
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

brc_status brc_sensors_evaluate(brc_sensors *sensors, brc_simulation *simulation, double *value)
{
    BRC_TRY(read_fields(sensors, simulation));
    if (sensors->needs & BRC_NEEDS_LEDGER) BRC_TRY(brc_simulation_ledger(simulation, &sensors->ledger));
    for (int32_t s = 0; s < sensors->scene->n_sensors; ++s) {
        const brc_sensor *sensor = &sensors->scene->sensors[s];
        const brc_sensor_reader *reader = brc_sensor_reader_of(sensor->kind);
        BRC_TRY(reader->read(sensors, simulation, s, &value[s]));
        if (sensor->sign != BRC_SIGN_COMPRESSION) continue;
        if (!reader->reversed || reader->reversed(sensor, sensors->outward[s])) value[s] = 0 - value[s];
    }
    return BRC_OK;
}
