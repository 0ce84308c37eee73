#define BRC_PRECISION 2
#define BRC_LANES 8
#define OVERLAP_PAIRS overlap_pairs_single
#include "overlap_pairs_body.h"
