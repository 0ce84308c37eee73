#define BRC_PRECISION 0
#define BRC_LANES 8
#define OVERLAP_PAIRS overlap_pairs_double
#include "overlap_pairs_body.h"
