/* The same cells break and soften on the first OpenCL device (PoCL in CI) as on the cpu. */
#include "cells_case.h"

int main(void)
{
    return cells_device_run("opencl:0");
}
