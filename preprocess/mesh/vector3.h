/* Vectors of three components. */
#ifndef BRC_PREPROCESS_MESH_VECTOR3_H
#define BRC_PREPROCESS_MESH_VECTOR3_H

static inline void mesh_minus(const double a[3], const double b[3], double out[3])
{
    for (int d = 0; d < 3; ++d)
        out[d] = a[d] - b[d];
}
static inline double mesh_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline void mesh_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

#endif
