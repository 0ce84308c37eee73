#include "../support.h"
#include "../fake_simulation.h"
#include "../../../host/output/sensors/sensors.h"

static brc_domain *domain;

static int begin(void **state)
{
    test_begin(state);
    domain = test_domain(300);
    return 0;
}

static int end(void **state)
{
    brc_domain_free(&domain);
    return test_end(state);
}

static void read(brc_simulation *s, int32_t n, brc_sensor *list, double *value)
{
    const brc_scene scene = {.n_sensors = n, .sensors = list};
    brc_sensors *sensors;
    s->domain = domain;
    if (brc_sensors_create(test_context, &scene, domain, &sensors) != BRC_OK)
        fail_msg("%s", brc_context_message(test_context));
    assert_int_equal(brc_sensors_evaluate(sensors, s, value), BRC_OK);
    brc_sensors_free(&sensors);
    assert_null(sensors);
}

static void an_affine_motion_is_read_exactly_by_faces(void **state)
{
    (void)state;
    brc_simulation s = {.factor = 1, .value = {0.5, 0, 0}, .gradient = {{1e-3, 2e-3, 0}, {0, -3e-4, 0}, {0, 0, 4e-3}}};
    brc_sensor list[] = {
        {.kind = BRC_SENSOR_FACE_STRAIN, .name = "a", .set = "x+", .set2 = "x-", .component = 0},
        {.kind = BRC_SENSOR_FACE_STRAIN, .name = "b", .set = "y-", .set2 = "y+", .component = 1},
        {.kind = BRC_SENSOR_FACE_MEAN, .name = "c", .set = "x+", .component = 0},
        {.kind = BRC_SENSOR_FACE_MEAN, .name = "d", .set = "z+", .component = 2},
    };
    double value[4];
    read(&s, 4, list, value);
    /* Area means of centroids: exact for a linear field but for rounding (walls of 1 m, displacements of 0.5 m). The
     * shear part of "a" needs equal mean y on both walls, which the whole wall has. */
    assert_true(fabs(value[0] - 1e-3) < 1e-12);
    assert_true(fabs(value[1] + 3e-4) < 1e-12);
    assert_true(fabs(value[2] - (0.5 + 2e-3 + 1e-3)) < 1e-12);
    assert_true(fabs(value[3] - 4e-3) < 1e-12);
}

static void a_rigid_rotation_is_read_as_its_angle_however_large(void **state)
{
    (void)state;
    for (double angle = -2.5; angle < 3; angle += 1.1) {
        brc_simulation s = {.factor = 1, .rotation = angle, .rotation_point = {0, 0.5, 0.5}};
        brc_sensor list[] = {
            {.kind = BRC_SENSOR_FACE_TWIST, .name = "a", .set = "x+", .axis = {7, 0, 0}, .point = {0, 0.5, 0.5}},
            {.kind = BRC_SENSOR_FACE_TWIST, .name = "b", .set = "x-", .axis = {-1, 0, 0}, .point = {9, 0.5, 0.5}}};
        double value[2];
        read(&s, 2, list, value);
        assert_true(fabs(value[0] - angle) < 1e-12);
        assert_true(fabs(value[1] + angle) < 1e-12);
    }
}

/* For small motions: sum S (r x u).a / sum S |r|^2; a shear u_y = -g z turns by the part of g that its mean arm
 * gives. */
static void a_small_twist_is_the_area_weighted_mean(void **state)
{
    (void)state;
    const double g = 1e-7;
    brc_simulation s = {.factor = 1, .gradient = {{0}, {0, 0, -g}, {0}}, .value = {0, 0.5 * g, 0}};
    brc_sensor list[] = {
        {.kind = BRC_SENSOR_FACE_TWIST, .name = "a", .set = "x+", .axis = {1, 0, 0}, .point = {2, 0.5, 0.5}}};
    double value, turning = 0, arms = 0;
    read(&s, 1, list, &value);
    const brc_set *set = &domain->sets[brc_domain_find_set(domain, "x+")];
    for (int64_t k = 0; k < set->n_members; ++k) {
        const int64_t f = set->members[k];
        const double y = domain->free_centroid[3 * f + 1] - 0.5, z = domain->free_centroid[3 * f + 2] - 0.5;
        turning += domain->free_area_vector[3 * f] * g * z * z;
        arms += domain->free_area_vector[3 * f] * (y * y + z * z);
    }
    assert_true(fabs(value / (turning / arms) - 1) < 1e-6); /* second order in g */
}

static void stress_and_strain_are_volume_means_over_the_set(void **state)
{
    (void)state;
    brc_simulation s = {.factor = 1, .stress = {5e6, 0, 0, 0, 0, -1e6}, .graded = 1};
    brc_sensor list[] = {{.kind = BRC_SENSOR_STRESS, .name = "a", .component = 0},
                         {.kind = BRC_SENSOR_STRESS, .name = "b", .component = 5, .set = "half"},
                         {.kind = BRC_SENSOR_STRAIN, .name = "c", .component = 0}};
    double value[3], volume = 0, moment = 0, half = 0, half_moment = 0;
    read(&s, 3, list, value);
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        volume += domain->volume[e];
        moment += domain->volume[e] * domain->position[3 * e];
        if (domain->position[3 * e] > 1) continue;
        half += domain->volume[e];
        half_moment += domain->volume[e] * domain->position[3 * e];
    }
    assert_true(fabs(value[0] / (5e6 * (1 + moment / volume)) - 1) < 1e-12);
    assert_true(fabs(value[1] / (-1e6 * (1 + half_moment / half)) - 1) < 1e-12);
    assert_true(fabs(value[2] / (5e-3 * (1 + moment / volume)) - 1) < 1e-12);
}

static void reactions_energies_points_and_modes_are_passed_on(void **state)
{
    (void)state;
    const double modes[] = {2 * M_PI * 100, 2 * M_PI * 250};
    brc_simulation s = {.factor = 1,
                        .gradient = {{1, 0, 0}},
                        .reaction = {3, 4, 5},
                        .ledger = {.elastic = 7},
                        .modes = modes,
                        .n_modes = 2};
    const int64_t e = 17;
    const double *x = domain->position + 3 * e;
    brc_sensor list[] = {{.kind = BRC_SENSOR_REACTION, .name = "a", .set = "x-", .component = 1},
                         {.kind = BRC_SENSOR_ENERGY, .name = "b", .term = "elastic"},
                         {.kind = BRC_SENSOR_POINT, .name = "c", .point = {x[0], x[1], x[2]}, .component = 0},
                         {.kind = BRC_SENSOR_POINT_VELOCITY, .name = "d", .point = {x[0], x[1], x[2]}, .component = 2},
                         {.kind = BRC_SENSOR_MODE, .name = "e", .index = 1},
                         {.kind = BRC_SENSOR_MODE, .name = "f", .index = 2}};
    double value[6];
    read(&s, 6, list, value);
    assert_true(value[0] == -4 && value[1] == 7);
    assert_true(value[2] == x[0] && value[3] == 10 * x[2]);
    assert_true(fabs(value[4] - 250) < 1e-12 && isnan(value[5]));
}

static void a_point_between_two_elements_belongs_to_the_smaller_id(void **state)
{
    (void)state;
    double position[] = {1, 0, 0, -1, 0, 0}, volume[] = {1, 1};
    brc_domain two = {.n_elements = 2, .position = position, .volume = volume};
    brc_sensor sensor = {.kind = BRC_SENSOR_POINT, .name = "a"};
    const brc_scene scene = {.n_sensors = 1, .sensors = &sensor};
    brc_simulation s = {.domain = &two, .factor = 1, .gradient = {{1, 0, 0}}};
    brc_sensors *sensors;
    double value;
    assert_int_equal(brc_sensors_create(test_context, &scene, &two, &sensors), BRC_OK);
    assert_int_equal(brc_sensors_evaluate(sensors, &s, &value), BRC_OK);
    assert_true(value == 1);
    brc_sensors_free(&sensors);
}

static void spheres_are_read_by_their_centres_and_a_mean_diameter(void **state)
{
    (void)state;
    /* one sphere at the left, two at the right, of radii 0.5, 0.6, 1.0 m: mean diameter 1.4 m */
    double position[] = {0, 0, 0, 4, 3, 0, 4, -3, 0}, volume[] = {1, 1, 9}, radius[] = {0.5, 0.6, 1.0};
    int32_t low[] = {0}, high[] = {1, 2};
    int64_t row_start[] = {0, 1, 2, 4};
    char name[2][3] = {"x-", "x+"};
    brc_set sets[2] = {{.name = name[0], .kind = BRC_SET_ELEMENTS, .n_members = 1, .members = low},
                       {.name = name[1], .kind = BRC_SET_ELEMENTS, .n_members = 2, .members = high}};
    brc_domain three = {.element_kind = BRC_ELEMENT_SPHERE,
                        .n_elements = 3,
                        .position = position,
                        .volume = volume,
                        .radius = radius,
                        .row_start = row_start,
                        .n_sets = 2,
                        .sets = sets,
                        .bounds = {{-1, -4, -1}, {5, 4, 1}}};
    brc_sensor list[] = {{.kind = BRC_SENSOR_FACE_STRAIN, .name = "a", .set = "x+", .set2 = "x-", .component = 0},
                         {.kind = BRC_SENSOR_FACE_MEAN, .name = "b", .set = "x+", .component = 1},
                         {.kind = BRC_SENSOR_VOLUME_STRAIN, .name = "c", .set = "x+"},
                         {.kind = BRC_SENSOR_RADIAL_STRESS, .name = "d", .set = "x+"},
                         {.kind = BRC_SENSOR_MOMENT, .name = "e", .set = "x+", .point = {1, 0, 3}, .component = 2},
                         {.kind = BRC_SENSOR_TURN, .name = "f", .point = {0, 0, 0}, .component = 2}};
    const brc_scene scene = {.model = {.kind = BRC_MODEL_CBM}, .n_sensors = 6, .sensors = list};
    brc_simulation s = {.domain = &three, .factor = 1, .gradient = {{0.01, 0, 0}, {0.02, 0, 0}}, .reaction = {3, 4, 5}};
    brc_sensors *sensors;
    double value[6];
    assert_int_equal(brc_sensors_create(test_context, &scene, &three, &sensors), BRC_OK);
    assert_int_equal(brc_sensors_evaluate(sensors, &s, value), BRC_OK);
    const double r = 5 + 0.7; /* from the origin */
    assert_true(fabs(value[0] - 0.04 / (4 + 1.4)) < 1e-16);
    assert_true(fabs(value[1] - 0.08) < 1e-16);                 /* a plain mean, whatever the volumes */
    assert_true(fabs(value[2] - 3 * 0.04 * 4 / 5 / r) < 1e-15); /* u = (0.04, 0.08) on both: the y parts cancel */
    assert_true(fabs(value[3] - 2 * 2 * 5 / (4 * M_PI * r * r)) < 1e-14);
    assert_true(fabs(value[4] - (0 * 4 - 2 * 3)) < 1e-14); /* at (1, 2, 3) m: arm (0, 2, 0) */
    assert_true(fabs(value[5] - 0.5) < 1e-14);
    brc_sensors_free(&sensors);
    /* the last sphere without bonds: the right side is the other one alone; R and the strain's length follow */
    row_start[3] = 2;
    assert_int_equal(brc_sensors_create(test_context, &scene, &three, &sensors), BRC_OK);
    assert_int_equal(brc_sensors_evaluate(sensors, &s, value), BRC_OK);
    assert_true(fabs(value[0] - 0.04 / (4 + 1.4)) < 1e-16);
    assert_true(fabs(value[1] - 0.08) < 1e-16);
    brc_sensors_free(&sensors);
    row_start[2] = row_start[3] = 1; /* and nothing left of it */
    assert_int_equal(brc_sensors_create(test_context, &scene, &three, &sensors), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "no element of \"x+\" has a bond"));
    brc_context_clear(test_context);
}

static void only_what_some_sensor_reads_is_fetched_and_that_once(void **state)
{
    (void)state;
    brc_simulation s = {.factor = 1};
    brc_sensor faces[] = {{.kind = BRC_SENSOR_FACE_MEAN, .name = "a", .set = "x+"}};
    brc_sensor all[] = {{.kind = BRC_SENSOR_FACE_MEAN, .name = "a"},
                        {.kind = BRC_SENSOR_POINT, .name = "b"},
                        {.kind = BRC_SENSOR_ENERGY, .name = "c", .term = "elastic"},
                        {.kind = BRC_SENSOR_ENERGY, .name = "d", .term = "kinetic"}};
    double value[4];
    read(&s, 1, faces, value);
    assert_int_equal(s.displacement_reads, 0);
    assert_int_equal(s.ledger_reads, 0);
    read(&s, 4, all, value);
    assert_int_equal(s.displacement_reads, 1);
    assert_int_equal(s.ledger_reads, 1);
}

static void strikers_and_spins_are_passed_on(void **state)
{
    (void)state;
    static const brc_striker_now now[2] = {{.kinetic = 1},
                                           {.position = {1, 2, 3},
                                            .displacement = {4, 5, 6},
                                            .velocity = {7, 8, 9},
                                            .rotation = {10, 11, 12},
                                            .spin = {13, 14, 15},
                                            .force = {16, 17, 18},
                                            .torque = {19, 20, 21},
                                            .kinetic = 22}};
    static const char *const term[8] = {"position", "displacement", "velocity", "rotation",
                                        "spin",     "force",        "torque",   "energy"};
    brc_striker strikers[2] = {{.name = "wall"}, {.name = "ball"}};
    brc_simulation s = {.domain = domain, .strikers = now, .n_strikers = 2};
    brc_sensor list[11] = {{.kind = BRC_SENSOR_STRIKER, .name = "w", .set = "wall", .term = "energy"},
                           {.kind = BRC_SENSOR_SPIN, .name = "x", .set = "half", .component = 1},
                           {.kind = BRC_SENSOR_SPIN, .name = "y", .component = 2}};
    for (int k = 0; k < 8; ++k) {
        list[3 + k] = (brc_sensor){.kind = BRC_SENSOR_STRIKER, .name = "z", .set = "ball", .component = k % 3};
        strcpy(list[3 + k].term, term[k]);
    }
    const brc_scene scene = {.n_sensors = 11, .sensors = list, .n_strikers = 2, .strikers = strikers};
    brc_sensors *sensors;
    double value[11];
    assert_int_equal(brc_sensors_create(test_context, &scene, domain, &sensors), BRC_OK);
    assert_int_equal(brc_sensors_evaluate(sensors, &s, value), BRC_OK);
    brc_sensors_free(&sensors);
    assert_true(value[0] == 1 && value[1] == 2 * brc_domain_find_set(domain, "half") && value[2] == -3);
    for (int k = 0; k < 7; ++k)
        assert_true(value[3 + k] == 1 + 3 * k + k % 3);
    assert_true(value[10] == 22);
}

static void every_wrong_sensor_is_named_in_one_pass(void **state)
{
    (void)state;
    brc_sensor list[] = {{.kind = BRC_SENSOR_FACE_MEAN, .name = "s_one", .set = "nowhere"},
                         {.kind = BRC_SENSOR_STRESS, .name = "s_two", .set = "x+"},
                         {.kind = BRC_SENSOR_FACE_STRAIN, .name = "s_three", .set = "y+", .set2 = "y-", .component = 0},
                         {.kind = BRC_SENSOR_FACE_TWIST, .name = "s_four", .set = "x+"},
                         {.kind = BRC_SENSOR_REACTION, .name = "s_five"},
                         {.kind = BRC_SENSOR_ENERGY, .name = "s_six", .term = "heat"},
                         {.kind = BRC_SENSOR_SPIN, .name = "s_seven", .set = "x+"},
                         {.kind = BRC_SENSOR_STRIKER, .name = "s_eight", .set = "x+"},
                         {.kind = BRC_SENSOR_POINT, .name = "s_fine"}};
    static const char *const part[] = {"s_one: there is no set \"nowhere\"",
                                       "s_two: the set \"x+\" holds faces",
                                       "s_three: the sets \"y+\" and \"y-\" lie at the same x",
                                       "s_four: a twist needs",
                                       "s_five: a reaction needs",
                                       "s_six: the ledger has no term \"heat\"",
                                       "s_seven: the set \"x+\" holds faces",
                                       "s_eight: there is no striker \"x+\""};
    const brc_scene scene = {.n_sensors = 9, .sensors = list};
    brc_sensors *sensors;
    assert_int_equal(brc_sensors_create(test_context, &scene, domain, &sensors), BRC_BAD_INPUT);
    assert_null(sensors);
    for (size_t k = 0; k < sizeof part / sizeof part[0]; ++k)
        if (!strstr(brc_context_message(test_context), part[k]))
            fail_msg("\"%s\" not in: %s", part[k], brc_context_message(test_context));
    assert_null(strstr(brc_context_message(test_context), "s_fine"));
    brc_context_clear(test_context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_affine_motion_is_read_exactly_by_faces),
        cmocka_unit_test(a_rigid_rotation_is_read_as_its_angle_however_large),
        cmocka_unit_test(a_small_twist_is_the_area_weighted_mean),
        cmocka_unit_test(stress_and_strain_are_volume_means_over_the_set),
        cmocka_unit_test(reactions_energies_points_and_modes_are_passed_on),
        cmocka_unit_test(a_point_between_two_elements_belongs_to_the_smaller_id),
        cmocka_unit_test(spheres_are_read_by_their_centres_and_a_mean_diameter),
        cmocka_unit_test(only_what_some_sensor_reads_is_fetched_and_that_once),
        cmocka_unit_test(strikers_and_spins_are_passed_on),
        cmocka_unit_test(every_wrong_sensor_is_named_in_one_pass),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
