/* Schema: shapes, fills, grains, cracks and limits on quality. */
#include "schema_internal.h"

static const brc_entry BOX[] = {
    {"origin", BRC_TYPE_VECTOR, "m", FIELD(brc_shape, origin), .length = 3, .sample = "[0, 0, 0]",
     .meaning = "smallest corner"},
    {"size", BRC_TYPE_VECTOR, "m", POSITIVE, FIELD(brc_shape, size), .length = 3, .required = true,
     .sample = "[1 m, 1 m, 1 m]", .meaning = "edge lengths"},
};
static const brc_section BOX_SECTION = {
    .title = "box", .meaning = "Walls: x- x+ y- y+ z- z+. A plate is a flat box.", ENTRIES(BOX)};
static const brc_entry CYLINDER[] = {
    {"origin", BRC_TYPE_VECTOR, "m", FIELD(brc_shape, origin), .length = 3, .sample = "[0, 0, 0]",
     .meaning = "centre of the first end"},
    {"axis", BRC_TYPE_CHOICE, FIELD(brc_shape, axis), CHOICES("x", "y", "z"), .given = "x", .meaning = "its direction"},
    {"length", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, length), .required = true, .sample = "1 m",
     .meaning = "along the axis"},
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, radius), .sample = "0.1 m",
     .meaning = "of the round"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, radius), .another = true, .factor = 0.5,
     .sample = "0.2 m", .meaning = "twice the radius, in its place"},
};
static const brc_section CYLINDER_SECTION = {
    .title = "cylinder",
    .meaning = "Walls: the two ends, x- and x+ for the axis x, and side. A disc is a short cylinder.",
    ENTRIES(CYLINDER),
    .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}}};
static const brc_entry SPHERE[] = {
    {"centre", BRC_TYPE_VECTOR, "m", FIELD(brc_shape, origin), .length = 3, .sample = "[0, 0, 0]", .meaning = "centre"},
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, radius), .sample = "5 mm", .meaning = "radius"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, radius), .another = true, .factor = 0.5,
     .sample = "1 cm", .meaning = "twice the radius, in its place"},
};
static const brc_section SPHERE_SECTION = {.title = "sphere",
                                           .meaning = "Wall: surface.",
                                           ENTRIES(SPHERE),
                                           .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}}};
static const brc_entry CONE[] = {
    {"origin", BRC_TYPE_VECTOR, "m", FIELD(brc_shape, origin), .length = 3, .sample = "[0, 0, 0]",
     .meaning = "centre of the first end"},
    {"axis", BRC_TYPE_CHOICE, FIELD(brc_shape, axis), CHOICES("x", "y", "z"), .given = "x", .meaning = "its direction"},
    {"length", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, length), .required = true, .sample = "1 m",
     .meaning = "along the axis"},
    {"radius", BRC_TYPE_QUANTITY, "m", NOT_NEGATIVE, FIELD(brc_shape, radius), .sample = "20 cm",
     .meaning = "at the first end; 0: a tip"},
    {"diameter", BRC_TYPE_QUANTITY, "m", NOT_NEGATIVE, FIELD(brc_shape, radius), .another = true, .factor = 0.5,
     .sample = "40 cm", .meaning = "twice that radius, in its place"},
    {"end_radius", BRC_TYPE_QUANTITY, "m", NOT_NEGATIVE, FIELD(brc_shape, radius2), .sample = "10 cm",
     .meaning = "at the other end; 0 or left out: a tip"},
    {"end_diameter", BRC_TYPE_QUANTITY, "m", NOT_NEGATIVE, FIELD(brc_shape, radius2), .another = true, .factor = 0.5,
     .sample = "20 cm", .meaning = "twice that radius, in its place"},
};
static const brc_section CONE_SECTION = {
    .title = "cone",
    .meaning = "A cone or frustum. Walls: its flat ends, x- and x+ for the axis x, and side.",
    ENTRIES(CONE),
    .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}},
               {BRC_GROUP_AT_MOST_ONE, {"end_radius", "end_diameter"}}}};
static const brc_entry TORUS[] = {
    {"centre", BRC_TYPE_VECTOR, "m", FIELD(brc_shape, origin), .length = 3, .sample = "[0, 0, 0]", .meaning = "centre"},
    {"axis", BRC_TYPE_CHOICE, FIELD(brc_shape, axis), CHOICES("x", "y", "z"), .given = "z", .meaning = "of the ring"},
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, radius), .sample = "5 cm",
     .meaning = "of the centre line"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, radius), .another = true, .factor = 0.5,
     .sample = "10 cm", .meaning = "of the centre line: twice its radius, in its place"},
    {"tube", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, radius2), .sample = "1 cm",
     .meaning = "radius of the tube, below that of the centre line"},
    {"tube_diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, radius2), .another = true, .factor = 0.5,
     .sample = "2 cm", .meaning = "twice the tube's radius, in its place"},
};
static const brc_section TORUS_SECTION = {
    .title = "torus",
    .meaning = "A ring. Wall: surface.",
    ENTRIES(TORUS),
    .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}, {BRC_GROUP_EXACTLY_ONE, {"tube", "tube_diameter"}}}};
static const brc_entry MESH[] = {
    {"file", BRC_TYPE_STRING, FIELD(brc_shape, file), .required = true, .sample = "part.stl",
     .meaning = "a closed triangle mesh, STL in binary or ASCII, relative to the scene"},
    {"scale", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_shape, scale), .given = "1 mm",
     .meaning = "length of one unit of the file"},
    {"origin", BRC_TYPE_VECTOR, "m", FIELD(brc_shape, origin), .length = 3, .sample = "[0, 0, 0]",
     .meaning = "added to every vertex"},
};
static const brc_section MESH_SECTION = {.title = "mesh",
                                         .meaning = "Wall: surface; sets with a normal tell its sides apart.",
                                         ENTRIES(MESH),
                                         .short_key = "file"};
static const brc_entry CUT[] = {
    {"point", BRC_TYPE_VECTOR, "m", FIELD(brc_shape, origin), .length = 3, .required = true, .sample = "[50 cm, 0, 0]",
     .meaning = "a point of the plane"},
    {"normal", BRC_TYPE_DIRECTION, "", FIELD(brc_shape, normal), .length = 3, .required = true, .sample = "[1, 0, 0]",
     .meaning = "points out of the half-space"},
};
static const brc_section CUT_SECTION = {
    .title = "half_space", .meaning = "All that lies behind a plane; to keep or to remove. Wall: cut.", ENTRIES(CUT)};

#define LEAVES                                                                                                         \
    {"box", BRC_TYPE_STRUCT, .section = &BOX_SECTION, .value = BRC_SHAPE_BOX, .meaning = "a box along the axes"},      \
        {"cylinder", BRC_TYPE_STRUCT, .section = &CYLINDER_SECTION, .value = BRC_SHAPE_CYLINDER,                       \
         .meaning = "a cylinder along an axis"},                                                                       \
        {"sphere", BRC_TYPE_STRUCT, .section = &SPHERE_SECTION, .value = BRC_SHAPE_SPHERE, .meaning = "a sphere"},     \
        {"cone", BRC_TYPE_STRUCT, .section = &CONE_SECTION, .value = BRC_SHAPE_CONE,                                   \
         .meaning = "a cone or frustum along an axis"},                                                                \
        {"torus", BRC_TYPE_STRUCT, .section = &TORUS_SECTION, .value = BRC_SHAPE_TORUS, .meaning = "a ring"},          \
    {                                                                                                                  \
        "mesh", BRC_TYPE_STRUCT, .section = &MESH_SECTION, .value = BRC_SHAPE_MESH,                                    \
                                 .meaning = "a closed triangle mesh from a file"                                       \
    }

static const brc_entry LEAF[] = {
    LEAVES,
    {"half_space", BRC_TYPE_STRUCT, .section = &CUT_SECTION, .value = BRC_SHAPE_HALF_SPACE,
     .meaning = "one side of a plane"},
};
static const brc_section LEAF_SECTION = {.title = "shape of a part",
                                         .meaning = "One simple shape.",
                                         ENTRIES(LEAF),
                                         .one_of = true,
                                         .has_kind = true,
                                         .kind_offset = offsetof(brc_shape, kind)};
static const brc_entry PART_POSE[] = {POSE_ENTRIES(brc_shape_part)};
static const brc_section PART_POSE_SECTION = {
    .title = "pose of a part", .meaning = "Where the part stands before the body is posed.", ENTRIES(PART_POSE)};
static const brc_entry PART[] = {
    {"role", BRC_TYPE_CHOICE, FIELD(brc_shape_part, role), CHOICES("add", "remove", "keep"), .required = true,
     .sample = "add",
     .meaning =
         "what it does to the parts before it: unite, cut away, or keep only what lies in it; the first is added"},
    {"name", BRC_TYPE_NAME, FIELD(brc_shape_part, name), .sample = "hole",
     .meaning = "its walls are called name_wall; without one, as the shape's"},
    {"shape", BRC_TYPE_STRUCT, .section = &LEAF_SECTION, .offset = offsetof(brc_shape_part, shape), .required = true,
     .sample = "{sphere: {radius: 5 mm}}", .meaning = "the part"},
    {"pose", BRC_TYPE_STRUCT, .section = &PART_POSE_SECTION, .meaning = "where it stands"},
};
static const brc_section PART_SECTION = {
    .title = "part", .meaning = "A step of a composed shape.", ENTRIES(PART), .size = sizeof(brc_shape_part)};
static const brc_entry SHAPE[] = {
    LEAVES,
    {"parts", BRC_TYPE_LIST, .section = &PART_SECTION, COUNTED(brc_shape, parts, n_parts), .value = BRC_SHAPE_PARTS,
     .meaning = "unions, differences and intersections, applied in order"},
};
const brc_section brc_schema_shape = {.title = "shape",
                                      .meaning = "The solid before it is cut into elements.",
                                      ENTRIES(SHAPE),
                                      .one_of = true,
                                      .has_kind = true,
                                      .kind_offset = offsetof(brc_shape, kind)};

static const brc_entry NOISY_GRID[] = {
    {"elements", BRC_TYPE_INTEGER, WITHIN(1, 2e9), FIELD(brc_fill, n_elements), .sample = "1000",
     .meaning = "wanted number of elements, met as nearly as the grid allows"},
    {"spacing", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fill, spacing), .sample = "1 cm",
     .meaning = "distance of the grid's points"},
    {"cells", BRC_TYPE_INTEGERS, WITHIN(1, 1e9), FIELD(brc_fill, cells), .length = 3, .sample = "[10, 10, 10]",
     .meaning = "grid cells along x, y and z of the shape's bounding box"},
    {"spread", BRC_TYPE_QUANTITY, "", WITHIN(0, 1), FIELD(brc_fill, spread), .given = "90 %",
     .meaning = "width of the noise over the grid's spacing; 0 gives a regular grid"},
    {"lloyd", BRC_TYPE_INTEGER, WITHIN(0, 1000), FIELD(brc_fill, lloyd_sweeps), .given = "0",
     .meaning =
         "relaxation sweeps, each moving every seed to the centroid of its cell; rounder cells, longer time steps"},
    {"min_distance", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fill, min_distance), .given = "auto", .word = "auto",
     .sample = "1 um", .meaning = "seeds nearer than this to an earlier one are dropped; auto: 1e-6 of the spacing"},
    {"seed", BRC_TYPE_INTEGER, WITHIN(0, 9e15), FIELD(brc_fill, seed), .given = "1",
     .meaning = "of the random numbers; equal seeds give equal solids"},
};
static const brc_section NOISY_GRID_SECTION = {.title = "noisy_grid",
                                               .meaning = "Seeds on a regular grid, each moved at random.",
                                               ENTRIES(NOISY_GRID),
                                               .groups = {{BRC_GROUP_EXACTLY_ONE, {"elements", "spacing", "cells"}}}};
static const brc_entry RADIUS[] = {
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_radius, radius), .sample = "1 mm", .meaning = "ascending"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_radius, radius), .another = true, .factor = 0.5,
     .sample = "2 mm", .meaning = "twice the radius, in its place"},
    {"below", BRC_TYPE_QUANTITY, "", WITHIN(0, 1), FIELD(brc_radius, fraction), .required = true, .sample = "0",
     .meaning = "share of the elements, by number, that are smaller: 0 at the first, 1 at the last"},
};
static const brc_section RADIUS_SECTION = {.title = "radius",
                                           .meaning = "A point of the distribution of radii.",
                                           ENTRIES(RADIUS),
                                           .size = sizeof(brc_radius),
                                           .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}}};
static const brc_entry PACKING[] = {
    {"elements", BRC_TYPE_INTEGER, WITHIN(2, 2e9), FIELD(brc_fill, n_elements), .sample = "10000",
     .meaning = "number of spheres, met exactly; their size follows"},
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fill, radius), .sample = "1 mm",
     .meaning = "mean radius, met nearly; the number of spheres follows"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fill, radius), .another = true, .factor = 0.5,
     .sample = "2 mm", .meaning = "mean diameter, in place of the mean radius"},
    {"radius_spread", BRC_TYPE_QUANTITY, "", WITHIN(0, 0.9), FIELD(brc_fill, radius_spread), .given = "12.5 %",
     .meaning = "radii are uniform within this either side of their mean"},
    {"radii", BRC_TYPE_LIST, .section = &RADIUS_SECTION, COUNTED(brc_fill, radii, n_radii),
     .meaning = "another distribution of radii, in place of radius_spread; with `elements` only the ratios count"},
    {"coordination", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 8), FIELD(brc_fill, coordination), .sample = "6.2",
     .why = "random packings have about 6; pressed further, spheres are no longer spheres (bonds beyond contacts: "
            "`beams`)",
     .meaning = "mean number of contacts of a sphere, walls not counted, at which the packing is done; 6.2 without a "
                "volume fraction"},
    {"volume_fraction", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(0, 1), FIELD(brc_fill, volume_fraction), .sample = "0.6",
     .meaning = "the packing is done at this share of spheres in the volume, in place of a coordination number"},
    {"tolerance", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 1), FIELD(brc_fill, tolerance), .given = "0.02",
     .meaning = "largest difference of the coordination number from the wanted one"},
    {"walls", BRC_TYPE_CHOICE, FIELD(brc_fill, cut), CHOICES("contact", "cut"), .given = "contact",
     .meaning = "contact: packed between the walls, along which the spheres stand in layers; cut: cut out of a larger "
                "packing, for cells"},
    {"check_crystal", BRC_TYPE_BOOL, FIELD(brc_fill, check_crystal), .given = "false",
     .meaning = "measure the share of spheres in ordered surroundings"},
    {"lloyd", BRC_TYPE_INTEGER, WITHIN(0, 1000), FIELD(brc_fill, lloyd_sweeps), .given = "0",
     .meaning = "relaxation sweeps of the cells; not for beams"},
    {"seed", BRC_TYPE_INTEGER, WITHIN(0, 9e15), FIELD(brc_fill, seed), .given = "1",
     .meaning = "of the random numbers; equal seeds give equal solids"},
};
static const brc_section PACKING_SECTION = {.title = "packing",
                                            .meaning = "Centres of randomly packed spheres.",
                                            ENTRIES(PACKING),
                                            .groups = {{BRC_GROUP_EXACTLY_ONE, {"elements", "radius", "diameter"}},
                                                       {BRC_GROUP_AT_MOST_ONE, {"radius_spread", "radii"}},
                                                       {BRC_GROUP_AT_MOST_ONE, {"coordination", "volume_fraction"}}}};
static const brc_entry POINTS[] = {
    {"file", BRC_TYPE_STRING, FIELD(brc_fill, file), .required = true, .sample = "packing.csv",
     .meaning = "CSV with columns x, y, z and, for beams, radius; or a LAMMPS data file; relative to the scene"},
    {"scale", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fill, scale), .given = "1 m",
     .meaning = "length of one unit of the file"},
    {"lloyd", BRC_TYPE_INTEGER, WITHIN(0, 1000), FIELD(brc_fill, lloyd_sweeps), .given = "0",
     .meaning = "relaxation sweeps of the cells; not for beams"},
};
static const brc_section POINTS_SECTION = {.title = "points",
                                           .meaning = "Seeds, or centres and radii of spheres, from a file.",
                                           ENTRIES(POINTS),
                                           .short_key = "file"};
static const brc_entry FILL[] = {
    {"noisy_grid", BRC_TYPE_STRUCT, .section = &NOISY_GRID_SECTION, .value = BRC_FILL_NOISY_GRID,
     .meaning = "a regular grid with noise"},
    {"packing", BRC_TYPE_STRUCT, .section = &PACKING_SECTION, .value = BRC_FILL_PACKING,
     .meaning = "randomly packed spheres"},
    {"points", BRC_TYPE_STRUCT, .section = &POINTS_SECTION, .value = BRC_FILL_POINTS, .meaning = "points from a file"},
};
const brc_section brc_schema_fill = {.title = "fill",
                                     .meaning = "Where the seeds of the cells, or the centres of the spheres, are.",
                                     ENTRIES(FILL),
                                     .one_of = true,
                                     .has_kind = true,
                                     .kind_offset = offsetof(brc_fill, kind)};

static const brc_entry PHASE[] = {
    {"material", BRC_TYPE_MATERIAL, FIELD(brc_phase, material), .required = true, .sample = "glass",
     .meaning = "of these grains"},
    {"fraction", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 1), FIELD(brc_phase, fraction), .required = true,
     .sample = "30 %", .meaning = "share of the grains, by number"},
};
static const brc_section PHASE_SECTION = {
    .title = "phase", .meaning = "Grains of another material.", ENTRIES(PHASE), .size = sizeof(brc_phase)};
static const brc_entry GRAINS[] = {
    {"number", BRC_TYPE_INTEGER, WITHIN(1, 1e9), FIELD(brc_body, grains.n), .sample = "20", .meaning = "of grains"},
    {"size", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_body, grains.size), .sample = "2 mm",
     .meaning = "cube root of the mean volume of a grain"},
    {"seed", BRC_TYPE_INTEGER, WITHIN(0, 9e15), FIELD(brc_body, grains.seed), .given = "1",
     .meaning = "of the random numbers"},
    {"phases", BRC_TYPE_LIST, .section = &PHASE_SECTION, COUNTED(brc_body, phases, n_phases),
     .meaning = "materials of the grains; the rest keep the body's"},
};
const brc_section brc_schema_grains = {.title = "grains",
                                       .meaning = "Coarse Voronoi grains made of fine elements.",
                                       ENTRIES(GRAINS),
                                       .groups = {{BRC_GROUP_EXACTLY_ONE, {"number", "size"}}}};

static const brc_entry DISC[] = {
    {"centre", BRC_TYPE_VECTOR, "m", FIELD(brc_crack, point), .length = 3, .required = true,
     .sample = "[50 cm, 50 cm, 50 cm]", .meaning = "centre"},
    {"normal", BRC_TYPE_DIRECTION, "", FIELD(brc_crack, normal), .length = 3, .required = true, .sample = "[0, 0, 1]",
     .meaning = "of its plane"},
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_crack, radius), .sample = "20 cm", .meaning = "radius"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_crack, radius), .another = true, .factor = 0.5,
     .sample = "40 cm", .meaning = "twice the radius, in its place"},
};
static const brc_section DISC_SECTION = {
    .title = "disc", .meaning = "A penny.", ENTRIES(DISC), .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}}};
static const brc_entry RECTANGLE[] = {
    {"corner", BRC_TYPE_VECTOR, "m", FIELD(brc_crack, point), .length = 3, .required = true, .sample = "[0, 0, 50 cm]",
     .meaning = "a corner"},
    {"edge", BRC_TYPE_VECTOR, "m", FIELD(brc_crack, edge[0]), .length = 3, .required = true, .sample = "[1 m, 0, 0]",
     .meaning = "from the corner to the next one"},
    {"other_edge", BRC_TYPE_VECTOR, "m", FIELD(brc_crack, edge[1]), .length = 3, .required = true,
     .sample = "[0, 20 cm, 0]", .meaning = "from the corner to the one on the other side"},
};
static const brc_section RECTANGLE_SECTION = {
    .title = "rectangle", .meaning = "A plane piece between two edges.", ENTRIES(RECTANGLE)};
static const brc_entry PATCH[] = {
    {"disc", BRC_TYPE_STRUCT, .section = &DISC_SECTION, .value = BRC_CRACK_DISC, .meaning = "a round crack"},
    {"rectangle", BRC_TYPE_STRUCT, .section = &RECTANGLE_SECTION, .value = BRC_CRACK_RECTANGLE,
     .meaning = "a notch, or a cut right through"},
};
static const brc_section PATCH_SECTION = {.title = "patch",
                                          .meaning = "Where a crack is.",
                                          ENTRIES(PATCH),
                                          .one_of = true,
                                          .has_kind = true,
                                          .kind_offset = offsetof(brc_crack, kind)};
static const brc_entry CRACK[] = {
    {"name", BRC_TYPE_NAME, FIELD(brc_crack, name), .required = true, .sample = "notch",
     .meaning = "the wall that its faces belong to"},
    {"patch", BRC_TYPE_STRUCT, .section = &PATCH_SECTION, .required = true,
     .sample = "{rectangle: {corner: [0, 0, 5 mm], edge: [1 cm, 0, 0], other_edge: [0, 2 mm, 0]}}",
     .meaning = "where it is"},
    {"flat", BRC_TYPE_BOOL, FIELD(brc_crack, flat), .given = "true",
     .meaning = "seeds near it are mirrored, so that its faces lie in its plane and end at the sides of a rectangle; "
                "false: it follows the cells"},
};
const brc_section brc_schema_crack = {.title = "crack",
                                      .meaning = "Bonds that are cut before anything happens.",
                                      ENTRIES(CRACK),
                                      .size = sizeof(brc_crack)};

static const brc_entry LIMIT[] = {
    {"warn", BRC_TYPE_QUANTITY, "", FIELD(brc_quality_limit, warn), FLAG(brc_quality_limit, has_warn),
     .sample = "0.1 %", .meaning = "a warning beyond this"},
    {"refuse", BRC_TYPE_QUANTITY, "", FIELD(brc_quality_limit, refuse), FLAG(brc_quality_limit, has_refuse),
     .sample = "1 %", .meaning = "the body is refused beyond this"},
};
const brc_section brc_schema_limit = {
    .title = "limit",
    .meaning = "What one number of the quality report may be (docs/reference/domain.md lists them).",
    ENTRIES(LIMIT),
    .size = sizeof(brc_quality_limit),
    .sample_name = "volume_error",
    .groups = {{BRC_GROUP_AT_LEAST_ONE, {"warn", "refuse"}}}};
