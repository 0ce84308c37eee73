/* Fragments meet on the OpenMP target device as on the cpu. */
#include "contact_case.h"

int main(void)
{
    return contact_device_run("target:0");
}
