/* The same physics on the OpenMP target device as on the cpu. */
#include "backend_cases.h"

int main(void)
{
    return backend_cases_run("target:0");
}
