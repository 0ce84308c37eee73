/* Every kernel, in one translation unit: what an instance of the C builds and an OpenCL program are made of. */
#include "portable.h"
#include "vector.cl"
