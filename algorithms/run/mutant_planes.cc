// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/mutant_space.h"
#include "algorithms/svbsp/svbsp_run.h"

template struct gnomon::BySvbsp<gnomon::FragmentPlanesKernel>;
