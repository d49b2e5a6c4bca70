// SPDX-License-Identifier: GPL-3.0-or-later
// Claims before the oracle, as gnomon certify --candidate has them.
#ifndef GNOMON_PYTHON_BINDING_CERTIFY_H
#define GNOMON_PYTHON_BINDING_CERTIFY_H

#include <atomic>
#include <string>

#include "gnomon/kernel/error.h"
#include "python/binding/loaded_scene.h"
#include "python/binding/shadows.h"
#include "report/certificate/judging_limits.h"

namespace gnomon::python {

struct Limits : report::JudgingLimits {
  unsigned jobs = 0;
};

/// As the command prints it, and as it writes it.
struct Judgement {
  std::string text, json;
};

/// `result`: the text of a result file, `name` what messages call it. Errors: those of reading
/// it, of lights, of limits; kInterrupted.
Expected<Judgement> certify(const LoadedScenePtr& loaded, const AskedLights& lights,
                            const std::string& result, const std::string& name,
                            const Limits& limits, const std::atomic<bool>& stop);
/// What a kernel found. Requires: it has fragments.
Expected<Judgement> certify(const Shadows& shadows, const Limits& limits,
                            const std::atomic<bool>& stop);

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_CERTIFY_H
