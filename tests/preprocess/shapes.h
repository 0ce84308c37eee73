/* One shape of every kind, with exact volumes and bounds, for the tests of preprocess/. */
#ifndef BRC_TEST_PREPROCESS_SHAPES_H
#define BRC_TEST_PREPROCESS_SHAPES_H

#include "../../preprocess/domain/build.h"

enum { TEST_MOST_PARTS = 4 };

typedef enum test_wall {
    TEST_EXACT,  /* walls are met exactly: flat and convex, or planes with the exact volume */
    TEST_CURVED, /* tangent planes on curved walls */
    TEST_CONCAVE /* flat with sharp concave edges */
} test_wall;

typedef struct test_shape {
    const char *name;
    brc_shape shape; /* kind BRC_SHAPE_PARTS: of the parts */
    brc_shape_part part[TEST_MOST_PARTS];
    double volume;
    double bounds[2][3];
    test_wall wall;
} test_shape;

int test_n_shapes(void);
/* Shape k. The parts of *shape stay those of *room, which must outlive it. */
brc_shape test_shape_of(int k, test_shape *room);
/* The same by name. */
brc_shape test_shape_named(const char *name, test_shape *room);

#endif
