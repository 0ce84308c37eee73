/* Fragments meet on the first OpenCL device (PoCL in CI) as on the cpu. */
#include "contact_case.h"

int main(void)
{
    return contact_device_run("opencl:0");
}
