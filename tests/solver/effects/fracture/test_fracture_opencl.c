/* The same beams break and soften on the first OpenCL device (PoCL in CI) as on the cpu. */
#include "fracture_case.h"

int main(void)
{
    return fracture_device_run("opencl:0");
}
