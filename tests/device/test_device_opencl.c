/* The claims of device.h on the OpenCL kernels of every OpenCL device (PoCL in CI). */
#include "device_cases.h"

int main(void)
{
    return device_cases_run(BRC_DEVICE_OPENCL);
}
