// SPDX-License-Identifier: LGPL-3.0-or-later
// The level of AVX-512 (F, DQ, VL), in vectors of 256 bits.
#define GNOMON_LANES_LEVEL lanes_avx512
#include "algorithms/contour/lanes/level.inl.h"
