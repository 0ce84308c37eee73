/* Tables of the results and of the frames; that of the checkpoints is in meaning_state.c. */
#include "meaning.h"
#include <fnmatch.h>
#include <stddef.h>

const brc_meaning brc_meanings_of_results[] = {
    {"scene", "-", "the scene as it was resolved, YAML"},
    {"histories/stage", "-", "stage of each sample, from 0"},
    {"histories/step", "-", "step of the stage at each sample; static stages: increment"},
    {"histories/stage_time", "s", "time since the stage began; static stages: load factor [-]"},
    {"histories/time", "s", "time over all dynamic stages"},
    {"ledger/kinetic", "J", "kinetic energy of elements and free strikers at the end"},
    {"ledger/elastic", "J", "elastic energy of bonds at the end, without the stabilisation"},
    {"ledger/stabilisation", "J", "elastic energy that the stabilisation of cells holds"},
    {"ledger/potential", "J", "potential energy in gravity"},
    {"ledger/work", "J", "work of loads and driven strikers on the bodies, and of prescribed forces on free strikers"},
    {"ledger/damping", "J", "energy taken by damping"},
    {"ledger/numerical", "J", "energy taken by the integrator"},
    {"ledger/contact", "J", "elastic energy held by contacts"},
    {"ledger/friction", "J", "energy taken by friction"},
    {"ledger/impact", "J", "energy taken by the dashpots of contacts"},
    {"ledger/fracture", "J", "energy that left with broken bonds"},
    {"ledger/initial", "J", "energy at the start"},
    {"ledger/total", "J", "what is held at the end: kinetic, elastic, stabilisation, potential and contact"},
    {"ledger/closure", "-",
     "defect of the ledger over the largest of peak elastic energy, initial kinetic energy and work"},
    {"ledger/peak_elastic", "J", "largest elastic energy at a sample"},
    {"ledger/peak_kinetic", "J", "largest kinetic energy at a sample"},
    {"cracks/time", "s", "time over all dynamic stages at which each bond broke, in the order of breaking"},
    {"cracks/position", "m", "middle of the bond, of cells centroid of the face, undeformed; x y z"},
    {"cracks/normal", "-", "unit vector from element_i to element_j, undeformed; x y z"},
    {"cracks/stress", "Pa",
     "stress at which it broke, tension positive: of the element that failed, or normal stress of the bond"},
    {"cracks/energy", "J", "elastic energy that the bond held"},
    {"cracks/area", "m^2", "area of crack that it leaves"},
    {"cracks/load", "-", "load factor at which it broke in a static stage; else 0"},
    {"cracks/step", "-", "steps of dynamic stages and events of static ones so far"},
    {"cracks/stage", "-", "stage in which it broke, from 0"},
    {"cracks/mode", "-", "mode of failure: 1 tension, 2 compression, 3 shear, 4 detached with its element"},
    {"cracks/bond", "-", "id of the bond"},
    {"cracks/element_i", "-", "id of its first element"},
    {"cracks/element_j", "-", "id of its second element"},
    {"fragments/first_element", "-", "lowest id of the elements of each fragment"},
    {"fragments/elements", "-", "number of elements of each fragment"},
    {"fragments/share_below", "-", "share of the mass in fragments that are no heavier"},
    {"fragments/mass", "kg", "mass of each fragment"},
    {"fragments/centre", "m", "mass centre, deformed; x y z"},
    {"fragments/velocity", "m/s", "velocity of the mass centre; x y z"},
    {"fragments/spin", "rad/s", "angular velocity; x y z"},
    {"fragments/inertia", "kg m^2", "inertia about the mass centre; xx yy zz yz xz xy"},
    {"fragments/translation", "J", "kinetic energy of the motion of the mass centre"},
    {"fragments/rotation", "J", "kinetic energy of turning as a rigid body"},
    {"fragments/internal", "J", "kinetic energy that is left: vibration"},
    {"frames/time", "s", "time over all dynamic stages of each frame"},
    {NULL, NULL, NULL},
};

const brc_meaning brc_meanings_of_frames[] = {
    {"VTKHDF/NumberOfPoints", "-", "number of points"},
    {"VTKHDF/NumberOfCells", "-", "number of elements"},
    {"VTKHDF/NumberOfConnectivityIds", "-", "rows of Connectivity"},
    {"VTKHDF/NumberOfFaces", "-", "number of faces of polyhedra, each once from either side"},
    {"VTKHDF/NumberOfFaceConnectivityIds", "-", "rows of FaceConnectivity"},
    {"VTKHDF/NumberOfPolyhedronToFaceIds", "-", "rows of PolyhedronToFaces"},
    {"VTKHDF/Connectivity", "-", "indices of the points of each element"},
    {"VTKHDF/Offsets", "-", "first row of each element in Connectivity, and the end"},
    {"VTKHDF/FaceConnectivity", "-", "indices of the points of each face, in order around it"},
    {"VTKHDF/FaceOffsets", "-", "first row of each face in FaceConnectivity, and the end"},
    {"VTKHDF/PolyhedronToFaces", "-", "indices of the faces of each element"},
    {"VTKHDF/PolyhedronOffsets", "-", "first row of each element in PolyhedronToFaces, and the end"},
    {"VTKHDF/Types", "-", "VTK's type of each element: 42 polyhedron, 1 vertex"},
    {"VTKHDF/Points", "m", "corners of cells, centres of spheres, undeformed; x y z"},
    {"VTKHDF/PointData/displacement", "m", "displacement of each point; x y z"},
    {"VTKHDF/PointData/radius", "m", "radius of spheres; 0 at corners of cells"},
    {"VTKHDF/CellData/element_id", "-", "id of each element"},
    {"VTKHDF/CellData/position", "m", "position of each element, undeformed; x y z"},
    {"VTKHDF/CellData/body", "-", "index of its body in the scene"},
    {"VTKHDF/CellData/model", "-", "index of its model in summary.json, parts"},
    {"VTKHDF/CellData/displacement", "m", "displacement of each element; x y z"},
    {"VTKHDF/CellData/velocity", "m/s", "velocity of each element; x y z"},
    {"VTKHDF/CellData/orientation", "-", "rotation since the start, quaternion; w x y z"},
    {"VTKHDF/CellData/stress", "Pa", "Cauchy stress, tension positive; xx yy zz xy yz xz"},
    {"VTKHDF/CellData/strain", "-", "Green strain, extension positive; xx yy zz xy yz xz"},
    {"VTKHDF/CellData/von_mises", "Pa", "von Mises stress"},
    {"VTKHDF/CellData/damage", "-", "broken bonds over bonds at the start"},
    {"VTKHDF/CellData/fragment", "-", "index of its fragment"},
    {"VTKHDF/FieldData/time", "s", "time over all dynamic stages"},
    {"VTKHDF/FieldData/stage_time", "s", "time since the stage began; static stages: load factor [-]"},
    {"VTKHDF/FieldData/stage", "-", "stage, from 0"},
    {"VTKHDF/FieldData/step", "-", "step of the stage; static stages: increment"},
    {"VTKHDF/FieldData/n_fragments", "-", "number of fragments"},
    {"VTKHDF/FieldData/n_broken", "-", "number of broken bonds"},
    {NULL, NULL, NULL},
};

const brc_meaning *brc_meaning_of(const char *path)
{
    static const brc_meaning *const table[] = {brc_meanings_of_results, brc_meanings_of_frames,
                                               brc_meanings_of_checkpoints};
    for (size_t k = 0; k < sizeof table / sizeof *table; ++k)
        for (const brc_meaning *entry = table[k]; entry->pattern; ++entry)
            if (fnmatch(entry->pattern, path, FNM_PATHNAME) == 0) return entry;
    return NULL;
}

const char *brc_meaning_of_sensor(brc_sensor_kind kind)
{
    static const char *const meaning[] = {
        [BRC_SENSOR_REACTION] = "force of the loads on the solid over a set with a prescribed motion",
        [BRC_SENSOR_FACE_MEAN] = "mean displacement of a set",
        [BRC_SENSOR_FACE_STRAIN] =
            "mean displacement of one set less that of another over their distance, extension positive",
        [BRC_SENSOR_FACE_TWIST] = "mean rotation of a face set about an axis",
        [BRC_SENSOR_STRESS] = "volume mean of the second Piola-Kirchhoff stress over a set",
        [BRC_SENSOR_STRAIN] = "volume mean of the Green strain over a set",
        [BRC_SENSOR_ENERGY] = "a term of the energy ledger",
        [BRC_SENSOR_POINT] = "displacement of the element nearest to a point",
        [BRC_SENSOR_POINT_VELOCITY] = "velocity of the element nearest to a point",
        [BRC_SENSOR_MOMENT] = "moment of the loads on the solid about a point over a set with a prescribed motion",
        [BRC_SENSOR_TURN] = "rotation of the element nearest to a point",
        [BRC_SENSOR_RADIAL_STRESS] = "forces on a set along the radius from a point over the area of the sphere",
        [BRC_SENSOR_VOLUME_STRAIN] = "three times the mean radial displacement of a set over its radius",
        [BRC_SENSOR_FRACTURE] =
            "state of the fracture: broken bonds, crack area, fragments, share of the largest, or failure ratio",
        [BRC_SENSOR_CRACK_TIP] = "farthest broken bond along an axis from a point; 0 before the first",
        [BRC_SENSOR_SPIN] = "angular velocity of an element set as a rigid body",
        [BRC_SENSOR_STRIKER] = "motion or energy of a striker, or force or torque of the elements on it",
        [BRC_SENSOR_CONTACT] =
            "state of the contacts: touching pairs, sliding pairs, deepest penetration, or sum of the normal forces",
        [BRC_SENSOR_OPENING] = "how far two places have moved apart along a direction, opening positive",
        [BRC_SENSOR_MODE] = "frequency of a mode of free vibration"};
    return meaning[kind];
}

const char *brc_meaning_of_measure(brc_measure_kind kind)
{
    static const char *const meaning[] = {
        [BRC_MEASURE_E] = "Young's modulus: slope of stress against strain at zero strain",
        [BRC_MEASURE_NU] = "Poisson's ratio: minus the slope of lateral against axial strain at zero",
        [BRC_MEASURE_K] = "bulk modulus: slope of pressure against volume strain at zero",
        [BRC_MEASURE_G] = "shear modulus: slope of shear stress against shear angle at zero",
        [BRC_MEASURE_FREQUENCY] = "frequency of the largest peak of a sensor's spectrum",
        [BRC_MEASURE_PEAK] = "value of largest magnitude of a sensor",
        [BRC_MEASURE_SLOPE] = "slope of one sensor against another at zero",
        [BRC_MEASURE_MEAN] = "mean of a sensor over time",
        [BRC_MEASURE_RATE] = "slope of a sensor against time",
        [BRC_MEASURE_INTEGRAL] = "integral of a sensor over time",
        [BRC_MEASURE_DURATION] = "time for which a sensor's magnitude is above a share of its largest",
        [BRC_MEASURE_AT_FIRST_BREAK] = "value of a sensor when the first bond breaks"};
    return meaning[kind];
}
