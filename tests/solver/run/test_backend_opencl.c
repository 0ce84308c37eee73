/* The same physics on the first OpenCL device (PoCL in CI) as on the cpu. */
#include "backend_cases.h"

int main(void)
{
    return backend_cases_run("opencl:0");
}
