// SPDX-License-Identifier: LGPL-3.0-or-later
// The baseline level: what every machine of the architecture has.
#define GNOMON_LANES_LEVEL lanes_baseline
#include "algorithms/contour/lanes/level.inl.h"
