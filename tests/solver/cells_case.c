#include "cells_case.h"

void cells_compare(case_options a, case_options b)
{
    bench_case x, y;
    open_case(&x, a);
    open_case(&y, b);
    assert_same_breaks(&x, &y, 60);
    close_case(&x);
    close_case(&y);
}
