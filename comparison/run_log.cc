// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/run_log.h"

#include <filesystem>
#include <sstream>
#include <utility>

namespace gnomon::comparison {

Expected<RunLog> RunLog::open(const std::string& path) {
  RunLog log;
  log.path_ = path;
  std::string text;
  if (std::filesystem::exists(path)) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream all;
    if (!file || !(all << file.rdbuf() || file.peek() == std::ifstream::traits_type::eof())) {
      return fail(ErrorCode::kFile, path + ": cannot be read");
    }
    text = all.str();
  }
  std::size_t begin = 0, line = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    ++line;
    const std::string_view words = std::string_view(text).substr(begin, end - begin);
    const std::size_t tab = words.find('\t');
    const auto request = parse_request(words.substr(0, tab));
    const auto measurement = tab == std::string_view::npos
                                 ? parse_measurement("")
                                 : parse_measurement(words.substr(tab + 1));
    if (!request || !measurement) {
      return fail(ErrorCode::kFormat,
                  path + ", line " + std::to_string(line) + ": no run that was measured",
                  "a file that this command wrote, or none");
    }
    log.done_[request_text(*request)] = *measurement;
  }
  std::error_code error;
  if (begin < text.size()) std::filesystem::resize_file(path, begin, error);
  log.file_.open(path, std::ios::binary | std::ios::app);
  if (error || !log.file_) return fail(ErrorCode::kFile, path + ": cannot be written");
  return log;
}

std::optional<Measurement> RunLog::find(const RunRequest& request) const {
  const auto found = done_.find(request_text(request));
  if (found == done_.end()) return std::nullopt;
  return found->second;
}

Expected<void> RunLog::add(const RunRequest& request, const Measurement& measurement) {
  const std::string key = request_text(request);
  done_[key] = measurement;
  if (path_.empty()) return {};
  file_ << key << '\t' << measurement_text(measurement) << '\n' << std::flush;
  if (!file_) return fail(ErrorCode::kFile, path_ + ": cannot be written");
  return {};
}

}  // namespace gnomon::comparison
