/* Which breccia this is; written into every result file. */
#ifndef BRC_BASE_VERSION_H
#define BRC_BASE_VERSION_H

/* "0.1.0"; static storage. */
const char *brc_version(void);
/* The git commit it was built from, with "-changed" when tracked files differed from it; "unknown" outside git. */
const char *brc_version_commit(void);
/* Compiler and its version, e.g. "gcc 12.2.0". */
const char *brc_version_compiler(void);

#endif
