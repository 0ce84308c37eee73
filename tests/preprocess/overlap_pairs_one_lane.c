#define BRC_PRECISION 0
#define BRC_LANES 1
#define OVERLAP_PAIRS overlap_pairs_one_lane
#include "overlap_pairs_body.h"
