// SPDX-License-Identifier: GPL-3.0-or-later
// The predicate of shrinking: a scene fails like another, with as little checked as that takes.
#ifndef GNOMON_FUZZ_SHRINK_STILL_FAILS_H
#define GNOMON_FUZZ_SHRINK_STILL_FAILS_H

#include <functional>
#include <string>

#include "fuzz/check/check.h"
#include "fuzz/check/property.h"
#include "fuzz/shrink/shrink.h"
#include "gnomon/kernel/error.h"

namespace gnomon::fuzz {

/// The options that check one failure's property on its subject, and on the first exact one where
/// that is what it is compared with; tolerances, limits and seed as they are.
CheckOptions narrowed(const CheckOptions& options, const Failure& failure);

/// How a scene is checked: in this process (check_scene) or in another.
using SceneChecker = std::function<CaseReport(const Scene&)>;

/// Errors of at least this share of a polygon are blunders, others slivers: shrinking makes neither
/// out of the other.
inline constexpr double kBlunderShare = 1e-3;

/// Alike (property.h), and as grave.
bool fails_alike(const CaseReport& report, const Failure& failure);

/// True where a failure alike is found. `check` is under narrowed() options.
StillFails fails_like(Failure failure, SceneChecker check);
/// The same in this process: not for subjects that may crash or hang.
StillFails fails_like(const Failure& failure, const CheckOptions& options);

/// "3 polygons, 1 light, 9 vertices, 12 bits".
std::string size_in_words(const SceneSize& size);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SHRINK_STILL_FAILS_H
