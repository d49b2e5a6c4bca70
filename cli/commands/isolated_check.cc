// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/isolated_check.h"

#include <utility>

#include "cli/common/interrupt.h"

namespace gnomon::cli {

IsolatedCheck::IsolatedCheck(const std::string& program, const fuzz::CheckOptions& check,
                             const fuzz::Limits& limits)
    : checker_(std::make_shared<fuzz::IsolatedChecker>(program, check, limits)) {}

fuzz::CaseReport IsolatedCheck::operator()(const Scene& scene) const {
  auto report = checker_->check(scene, &interrupted());
  if (report) return std::move(*report);
  if (!*error_) *error_ = report.error();
  return {};
}

}  // namespace gnomon::cli
