// SPDX-License-Identifier: LGPL-3.0-or-later
// The choices of the definition that a run reads.
#ifndef GNOMON_ALGORITHMS_PARTITION_RULES_H
#define GNOMON_ALGORITHMS_PARTITION_RULES_H

namespace gnomon {

struct Rules {};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_RULES_H
