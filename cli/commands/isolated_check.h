// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes checked in a process of their own, as a function that shrinking can ask.
#ifndef GNOMON_CLI_COMMANDS_ISOLATED_CHECK_H
#define GNOMON_CLI_COMMANDS_ISOLATED_CHECK_H

#include <memory>
#include <optional>
#include <string>

#include "fuzz/workers/isolated.h"

namespace gnomon::cli {

class IsolatedCheck {
 public:
  IsolatedCheck(const std::string& program, const fuzz::CheckOptions& check,
                const fuzz::Limits& limits);

  /// Nothing where it could not be looked; error() says why then.
  fuzz::CaseReport operator()(const Scene& scene) const;
  /// The first, of all copies; also that the user asked to stop.
  const std::optional<Error>& error() const { return *error_; }

 private:
  std::shared_ptr<fuzz::IsolatedChecker> checker_;
  std::shared_ptr<std::optional<Error>> error_ = std::make_shared<std::optional<Error>>();
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_ISOLATED_CHECK_H
