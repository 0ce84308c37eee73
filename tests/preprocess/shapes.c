#include "shapes.h"

#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define PARTS(n)                                                                                                       \
    {                                                                                                                  \
        .kind = BRC_SHAPE_PARTS, .n_parts = (n)                                                                        \
    }
#define ROOT3 1.7320508075688772

static const test_shape shapes[] = {
    {.name = "box",
     .shape = {.kind = BRC_SHAPE_BOX, .origin = {-1, -1, -1}, .size = {2, 2, 2}},
     .volume = 8,
     .bounds = {{-1, -1, -1}, {1, 1, 1}}},
    {.name = "plate",
     .shape = {.kind = BRC_SHAPE_BOX, .size = {2, 2, 0.4}},
     .volume = 1.6,
     .bounds = {{0, 0, 0}, {2, 2, 0.4}}},
    {.name = "sphere",
     .shape = {.kind = BRC_SHAPE_SPHERE, .radius = 1},
     .volume = 4 * PI / 3,
     .bounds = {{-1, -1, -1}, {1, 1, 1}}},
    {.name = "cylinder",
     .shape = {.kind = BRC_SHAPE_CYLINDER, .length = 2, .radius = 0.5, .axis = 2},
     .volume = PI / 2,
     .bounds = {{-0.5, -0.5, 0}, {0.5, 0.5, 2}}},
    {.name = "disc",
     .shape = {.kind = BRC_SHAPE_CYLINDER, .length = 0.3, .radius = 1},
     .volume = 0.3 * PI,
     .bounds = {{0, -1, -1}, {0.3, 1, 1}}},
    {.name = "frustum",
     .shape = {.kind = BRC_SHAPE_CONE, .length = 2, .radius = 1, .radius2 = 0.5},
     .volume = PI * 2 / 3 * 1.75,
     .bounds = {{0, -1, -1}, {2, 1, 1}}},
    {.name = "cone",
     .shape = {.kind = BRC_SHAPE_CONE, .length = 2, .radius2 = 0.7, .axis = 1},
     .volume = PI * 2 / 3 * 0.49,
     .bounds = {{-0.7, 0, -0.7}, {0.7, 2, 0.7}},
     .wall = TEST_CURVED},
    {.name = "torus",
     .shape = {.kind = BRC_SHAPE_TORUS, .radius = 1, .radius2 = 0.4, .axis = 2},
     .volume = 2 * PI * PI * 0.16,
     .bounds = {{-1.4, -1.4, -0.4}, {1.4, 1.4, 0.4}},
     .wall = TEST_CURVED},
    {.name = "cut sphere",
     .shape = PARTS(2),
     .part = {{.shape = {.kind = BRC_SHAPE_SPHERE, .radius = 1}},
              {.role = BRC_PART_KEEP,
               .shape = {.kind = BRC_SHAPE_HALF_SPACE, .origin = {0.5, 0, 0}, .normal = {2, 0, 0}}}},
     .volume = 4 * PI / 3 - PI * 0.25 * 2.5 / 3, /* a cap of height 1/2: pi h^2 (3 R - h) / 3 */
     .bounds = {{-1, -1, -1}, {0.5, 1, 1}},
     .wall = TEST_CURVED},
    {.name = "box minus cylinder",
     .shape = PARTS(2),
     .part = {{.shape = {.kind = BRC_SHAPE_BOX, .size = {2, 2, 1}}},
              {.role = BRC_PART_REMOVE,
               .name = "hole",
               .shape = {.kind = BRC_SHAPE_CYLINDER, .origin = {1, 1, -1}, .length = 3, .radius = 0.5, .axis = 2}}},
     .volume = 4 - PI / 4,
     .bounds = {{0, 0, 0}, {2, 2, 1}},
     .wall = TEST_CURVED},
    {.name = "box minus ball",
     .shape = PARTS(2),
     .part = {{.shape = {.kind = BRC_SHAPE_BOX, .size = {2, 2, 2}}},
              {.role = BRC_PART_REMOVE,
               .name = "void",
               .shape = {.kind = BRC_SHAPE_SPHERE, .origin = {1, 1, 1}, .radius = 0.7}}},
     .volume = 8 - 4 * PI / 3 * 0.343,
     .bounds = {{0, 0, 0}, {2, 2, 2}},
     .wall = TEST_CURVED},
    {.name = "two balls in common",
     .shape = PARTS(2),
     .part = {{.shape = {.kind = BRC_SHAPE_SPHERE, .radius = 1}},
              {.role = BRC_PART_KEEP, .shape = {.kind = BRC_SHAPE_SPHERE, .origin = {1, 0, 0}, .radius = 1}}},
     .volume = 5 * PI / 12,
     .bounds = {{0, -ROOT3 / 2, -ROOT3 / 2}, {1, ROOT3 / 2, ROOT3 / 2}},
     .wall = TEST_CURVED},
    {.name = "two balls together",
     .shape = PARTS(2),
     .part = {{.shape = {.kind = BRC_SHAPE_SPHERE, .radius = 1}},
              {.role = BRC_PART_ADD, .shape = {.kind = BRC_SHAPE_SPHERE, .origin = {1, 0, 0}, .radius = 1}}},
     .volume = 8 * PI / 3 - 5 * PI / 12,
     .bounds = {{-1, -1, -1}, {2, 1, 1}},
     .wall = TEST_CURVED},
    {.name = "turned box",
     .shape = PARTS(1), /* a square turned by 45 degrees about its corner */
     .part = {{.shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}},
               .rotation = {0, 0, PI / 4},
               .translation = {0, 0, 1}}},
     .volume = 1,
     .bounds = {{-0.70710678118654752, 0, 1}, {0.70710678118654752, 1.4142135623730951, 2}}},
    {.name = "wedge",
     .shape = PARTS(2), /* a cube cut in half */
     .part = {{.shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}}},
              {.role = BRC_PART_REMOVE,
               .name = "slope",
               .shape = {.kind = BRC_SHAPE_HALF_SPACE, .origin = {1, 0, 0}, .normal = {-1, -1, 0}}}},
     .volume = 0.5,
     .bounds = {{0, 0, 0}, {1, 1, 1}}},
    {.name = "L-shape",
     .shape = PARTS(2),
     .part = {{.shape = {.kind = BRC_SHAPE_BOX, .size = {2, 1, 1}}},
              {.role = BRC_PART_ADD, .shape = {.kind = BRC_SHAPE_BOX, .origin = {0, 1, 0}, .size = {1, 1, 1}}}},
     .volume = 3,
     .bounds = {{0, 0, 0}, {2, 2, 1}},
     .wall = TEST_CONCAVE},
    {.name = "V-notch",
     .shape = PARTS(2), /* the corner of a square rod turned by 45 degrees: a right angle, half a metre deep */
     .part = {{.shape = {.kind = BRC_SHAPE_BOX, .size = {2, 2, 1}}},
              {.role = BRC_PART_REMOVE,
               .name = "notch",
               .rotation = {0, 0, PI / 4},
               .translation = {1, 2, 0},
               .shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 3}, .origin = {-0.5, -0.5, -1}}}},
     .volume = 3.75,
     .bounds = {{0, 0, 0}, {2, 2, 1}},
     .wall = TEST_CONCAVE},
};

int test_n_shapes(void)
{
    return (int)(sizeof shapes / sizeof *shapes);
}

brc_shape test_shape_of(int k, test_shape *room)
{
    memcpy(room, &shapes[k], sizeof *room);
    room->shape.parts = room->part;
    return room->shape;
}

brc_shape test_shape_named(const char *name, test_shape *room)
{
    for (int k = 0; k < test_n_shapes(); ++k)
        if (strcmp(shapes[k].name, name) == 0) return test_shape_of(k, room);
    abort();
}
