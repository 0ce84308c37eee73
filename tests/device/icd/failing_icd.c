/* An OpenCL driver that aborts, hangs or ends the program as soon as the loader asks it for its functions, as
 * BRC_FAILING_ICD says. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

__attribute__((visibility("default"))) void *clGetExtensionFunctionAddress(const char *name);

void *clGetExtensionFunctionAddress(const char *name)
{
    const char *const how = getenv("BRC_FAILING_ICD");
    (void)name;
    if (!how) return NULL;
    if (strcmp(how, "abort") == 0) abort();
    if (strcmp(how, "exit") == 0) exit(3);
    while (strcmp(how, "hang") == 0)
        sleep(1);
    return NULL;
}
