/* What writing and reading a domain file share. */
#ifndef BRC_PREPROCESS_DOMAIN_FILE_INTERNAL_H
#define BRC_PREPROCESS_DOMAIN_FILE_INTERNAL_H

#include "domain_file.h"
#include "hdf5_io.h"

#include <stddef.h>

#define BRC_DOMAIN_FORMAT_NAME "breccia domain"

/* Which count gives the rows of an array. */
typedef enum rows_of {
    ELEMENTS,
    ELEMENT_STARTS,
    HALF_EDGES,
    BONDS,
    FREE_FACES,
    FREE_FACE_STARTS,
    CORNERS,
    POLYGON_CORNERS,
    N_ROWS_OF
} rows_of;

/* Which domains have an array. */
typedef enum found_in { ALL, CELLS, SPHERES, GRAINS } found_in;

typedef struct brc_domain_array {
    const char *name;
    size_t field; /* offset of the pointer in brc_domain */
    brc_h5_kind kind;
    rows_of rows;
    int64_t width;
    found_in found;
    int since; /* format version; files before it have it once a bond */
    const char *unit, *meaning;
} brc_domain_array;

extern const brc_domain_array brc_domain_arrays[];
extern const int brc_domain_n_arrays;
extern const char *const brc_domain_kind_name[]; /* by brc_element_kind */

/* Attributes of the group "quality". */
typedef struct brc_quality_field {
    const char *name;
    size_t field;
    brc_h5_kind kind;
    int64_t n;
    int since; /* format version; files before it are measured when read */
} brc_quality_field;
extern const brc_quality_field brc_quality_fields[];
extern const int brc_n_quality_fields;

/* The counts of the file, attributes of its root. */
enum { N_COUNTS = 7 };
extern const char *const brc_domain_count_name[N_COUNTS];
void brc_domain_rows_from_counts(const int64_t count[N_COUNTS], int64_t rows[N_ROWS_OF]);
bool brc_domain_has_array(const brc_domain *domain, const brc_domain_array *entry, bool has_grains);

#endif
