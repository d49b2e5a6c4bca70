// SPDX-License-Identifier: GPL-3.0-or-later
// What has been measured, in a file that is written run by run, so that a long sweep that was
// interrupted goes on where it stopped.
//
// A line a run: the request and the measurement as JSON, with a tab between them. A line that was
// cut off in writing is left out when the file is read, and written again.
#ifndef GNOMON_COMPARISON_RUN_LOG_H
#define GNOMON_COMPARISON_RUN_LOG_H

#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "comparison/measurement.h"
#include "gnomon/kernel/error.h"

namespace gnomon::comparison {

class RunLog {
 public:
  /// Nothing is kept.
  RunLog() = default;
  /// Reads what is there, and goes on behind it. Errors: kFile; kFormat for a file that is none of
  /// these, which is left alone.
  static Expected<RunLog> open(const std::string& path);

  std::size_t size() const { return done_.size(); }
  std::optional<Measurement> find(const RunRequest& request) const;
  /// Errors: kFile.
  Expected<void> add(const RunRequest& request, const Measurement& measurement);

 private:
  std::string path_;
  std::ofstream file_;
  std::map<std::string, Measurement> done_;  // by the request's text
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_RUN_LOG_H
