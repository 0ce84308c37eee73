/* The claims of device.h on the C kernels of the host. */
#include "device_cases.h"

int main(void)
{
    return device_cases_run(BRC_DEVICE_CPU);
}
