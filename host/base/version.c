/* The generated header is rewritten at build time when the commit changes (cmake/version.cmake). */
#include "version.h"
#include "version_generated.h"

const char *brc_version(void)
{
    return BRC_GENERATED_VERSION;
}

const char *brc_version_commit(void)
{
    return BRC_GENERATED_COMMIT;
}

const char *brc_version_compiler(void)
{
#ifdef __clang__
    return "clang " __clang_version__;
#else
    return "gcc " __VERSION__;
#endif
}
