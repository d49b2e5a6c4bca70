// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/mutant_space.h"
#include "algorithms/run/receiver_run.h"
#include "algorithms/sectors/sector_run.h"
#include "algorithms/svbsp/svbsp_run.h"

template struct gnomon::BySectors<gnomon::SplitVerticesKernel>;
template struct gnomon::BySvbsp<gnomon::SplitVerticesKernel>;
template struct gnomon::ByReceiver<gnomon::SplitVerticesKernel>;
