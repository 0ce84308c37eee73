/* Arrays of elements and bonds, for other folders. */
#include "core_internal.h"

#define BRC_ARRAY(name, member)                                                                                        \
    brc_buffer *brc_##name##_of(const brc_simulation *s)                                                               \
    {                                                                                                                  \
        return s->core->member;                                                                                        \
    }
BRC_ARRAY(displacement, displacement)
BRC_ARRAY(velocity, velocity)
BRC_ARRAY(force, force)
BRC_ARRAY(orientation, orientation)
BRC_ARRAY(spin, spin)
BRC_ARRAY(torque, torque)
BRC_ARRAY(mass, mass)
BRC_ARRAY(inertia, inertia)
BRC_ARRAY(gradient, gradient)
BRC_ARRAY(flux, flux)
BRC_ARRAY(held_moment, held_moment)
BRC_ARRAY(elastic_energy, elastic_energy)
BRC_ARRAY(stabilisation_energy, stabilisation_energy)
BRC_ARRAY(kinetic, kinetic)
BRC_ARRAY(lost_damping, lost_damping)
BRC_ARRAY(lost_numerical, lost_numerical)
BRC_ARRAY(neighbour, neighbour)
BRC_ARRAY(area, area)
BRC_ARRAY(offset, offset)
BRC_ARRAY(ratio, ratio)
BRC_ARRAY(beam_array, beam_of)
BRC_ARRAY(partial, partial)
