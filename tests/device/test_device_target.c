/* The claims of device.h on the target kernels of the OpenMP plug-in. */
#include "device_cases.h"

int main(void)
{
    return device_cases_run(BRC_DEVICE_TARGET);
}
