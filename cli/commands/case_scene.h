// SPDX-License-Identifier: GPL-3.0-or-later
// The scene of a case as a page shows it: the exact answer beside those of the subjects that fail.
#ifndef GNOMON_CLI_COMMANDS_CASE_SCENE_H
#define GNOMON_CLI_COMMANDS_CASE_SCENE_H

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/check/property.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/text/text_sink.h"

namespace gnomon::cli {

class CaseScene {
 public:
  /// Runs in this process what came back with an answer in another one: subjects that crashed or
  /// took too much are left out, and so are foreign programs. A scene that cannot be prepared, or
  /// is large, is not shown.
  CaseScene(const Scene& scene, std::span<const fuzz::Failure> failures);

  bool is_shown() const { return shown_; }
  /// Requires: is_shown().
  void write_view(report::TextSink& sink) const;
  /// Whether write_result() has something to tell.
  bool has_result() const { return result_.has_value(); }
  void write_result(report::TextSink& sink) const;

 private:
  static constexpr std::size_t kMostParts = 2000;

  void add_exact();
  void add_subject(const std::string& name);

  Scene scene_;
  PreparedScene prepared_;
  bool shown_ = false;
  std::optional<ShadowResult> result_;
  std::vector<Claims> answers_;  // the exact one first
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CASE_SCENE_H
