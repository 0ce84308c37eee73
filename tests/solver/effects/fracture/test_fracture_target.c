/* The same beams break and soften on the OpenMP target device as on the cpu. */
#include "fracture_case.h"

int main(void)
{
    return fracture_device_run("target:0");
}
