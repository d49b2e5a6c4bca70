// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/lines_check.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <vector>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "gnomon/oracle/line_counts.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

template <class Parts>
std::string parts_text(const Parts& parts) {
  std::string text;
  for (const auto& part : parts) {
    text +=
        (text.empty() ? "" : ", ") + std::to_string(part.hidden_by) + " to " + part.end.get_str();
  }
  return text;
}

/// Empty if the edge is right. Counts the points that were judged.
std::string problem_of(const oracle::LineCounts& truth, const HiddenLine& line,
                       std::atomic<std::uint64_t>& points) {
  const std::vector<oracle::CountedPart> right = truth.parts(line.edge);
  const std::string found = parts_text(line.parts), told = parts_text(right);
  if (found != told) return "found " + found + "; the oracle has " + told;
  mpq_class from = 0;
  for (const LinePart& part : line.parts) {
    const mpq_class middle = (from + part.end) / 2;
    from = part.end;
    const auto count = truth.count_at(line.edge, middle);
    if (!count) continue;  // a border of some polygon, where the count stays as it is
    ++points;
    if (*count != part.hidden_by) {
      return "found " + found + "; at " + middle.get_str() + " the segment meets " +
             std::to_string(*count);
    }
  }
  return {};
}

}  // namespace

Expected<LinesVerdict> check_lines(const PreparedScene& scene, const PreparedLight& light,
                                   const HiddenLines& lines) {
  constexpr std::uint64_t kMostPairs = 10'000'000;
  LinesVerdict verdict;
  const std::uint64_t pairs = lines.lines.size() * lines.facing_polygons;
  verdict.every = 1 + pairs / kMostPairs;
  const std::size_t count =
      (lines.lines.size() + verdict.every - 1) / static_cast<std::size_t>(verdict.every);
  const oracle::LineCounts truth(scene, light);
  ProgressBar progress("checking");
  const auto show = progress.callback();
  std::atomic<std::uint64_t> points = 0, done = 0;
  std::vector<std::string> problems(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (interrupted()) return;
    problems[i] = problem_of(truth, lines.lines[i * verdict.every], points);
    if (show) show(static_cast<double>(++done) / static_cast<double>(count));
  });
  progress.clear();
  if (interrupted()) return fail(ErrorCode::kInterrupted, "interrupted");
  verdict.edges = count;
  verdict.points = points;
  for (std::size_t i = 0; i < count; ++i) {
    if (problems[i].empty()) continue;
    ++verdict.wrong;
    if (!verdict.first_wrong) {
      verdict.first_wrong =
          "edge " + std::to_string(lines.lines[i * verdict.every].edge) + ": " + problems[i];
    }
  }
  return verdict;
}

std::string verdict_text(const LinesVerdict& verdict) {
  std::string text = report::grouped(verdict.edges) + " edges";
  if (verdict.every > 1) text += " (one of " + report::grouped(verdict.every) + ')';
  text += ", " + report::grouped(verdict.points) + " points: ";
  if (!verdict.first_wrong) return text + "identical";
  return text + report::grouped(verdict.wrong) + " edges wrong; " + *verdict.first_wrong;
}

}  // namespace gnomon::cli
