// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/coordinate/coordinate_volume_space.inl.h"

namespace gnomon {
GNOMON_INSTANTIATE_COORDINATE_VOLUME_SPACE(mpq_class);
}  // namespace gnomon
