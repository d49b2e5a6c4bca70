// SPDX-License-Identifier: LGPL-3.0-or-later
// The level of AVX2; compiled without fused multiply-adds.
#define GNOMON_LANES_LEVEL lanes_avx2
#include "algorithms/contour/lanes/level.inl.h"
