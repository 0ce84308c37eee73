/* The same cells break and soften on the OpenMP target device as on the cpu. */
#include "cells_case.h"

int main(void)
{
    return cells_device_run("target:0");
}
