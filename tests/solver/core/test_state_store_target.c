/* What is kept of a simulation on target:0 is all that its future there needs. */
#include "state_cases.h"

int main(void)
{
    return state_cases_run("target:0");
}
