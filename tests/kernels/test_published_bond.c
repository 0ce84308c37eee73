/* The rotation vector of the published law against the exact one, over the angles it is made for. One lane, double. */
#include "one_lane.h"
#include "../../kernels/models/published/published_bond.h"

static void rotation_vector_is_angle_times_axis_up_to_a_right_angle(void **state)
{
    (void)state;
    const double axis[3] = {2.0 / 7, -3.0 / 7, 6.0 / 7};
    for (double angle = 1e-12; angle < 1.5708; angle *= 1.7) {
        const double s = sin(angle / 2);
        const lane_vec3 found =
            quat_rotation_vector((lane_quat){cos(angle / 2), s * axis[0], s * axis[1], s * axis[2]}, 1);
        /* the series leaves 3e-15 at a right angle; below, a few roundings */
        assert_true(fabs(found.x - angle * axis[0]) < 5e-15 * angle);
        assert_true(fabs(found.y - angle * axis[1]) < 5e-15 * angle);
        assert_true(fabs(found.z - angle * axis[2]) < 5e-15 * angle);
    }
}

static void stretched_bond_pulls_by_the_confined_modulus(void **state)
{
    (void)state;
    /* no lateral strain, no shear: sigma_nn = (lambda + 2 mu) e; by hand lambda 2, mu 3, e 1e-3, S 0.5: 4e-3 N along
     * x */
    const lane_vec3 branch = {2, 0, 0}, jump = {2e-3, 0, 0}, none = {0, 0, 0};
    const lane_sym3 strain = {1e-3, 0, 0, 0, 0, 0};
    const published_bond b = published_bond_law(branch, jump, 0.5, strain, none, 2, 3, 1, 1, 1);
    assert_true(fabs(b.force.x - 4e-3) < 1e-17 && fabs(b.force.y) < 1e-18 && fabs(b.torque.z) < 1e-18);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rotation_vector_is_angle_times_axis_up_to_a_right_angle),
        cmocka_unit_test(stretched_bond_pulls_by_the_confined_modulus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
