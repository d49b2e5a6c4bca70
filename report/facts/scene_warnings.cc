// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/facts/scene_warnings.h"

#include <algorithm>
#include <map>

#include "report/facts/scene_facts.h"
#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

constexpr std::size_t kExamples = 3;

}  // namespace

std::string left_out_warning(const ReadResult& read) {
  const std::size_t count = read.left_out.size();
  std::string text = read.scene.file + ": " + std::to_string(count) + " of " +
                     std::to_string(count + read.scene.polygons.size()) +
                     (count + read.scene.polygons.size() == 1 ? " polygon" : " polygons") +
                     " left out: ";
  for (std::size_t i = 0; i < std::min(count, kExamples); ++i) {
    if (i > 0) text += "; ";
    text += left_out_polygon(read.left_out[i]);
  }
  if (count > kExamples) {
    text += "; and " + std::to_string(count - kExamples) + " more ('gnomon info --all' lists them)";
  }
  return text;
}

std::vector<std::string> dropped_warnings(const Scene& scene, const PreparedScene& prepared) {
  std::map<std::string, std::vector<std::uint32_t>> dropped;
  for (const PreparationNote& note : prepared.notes) {
    if (note.repair == Repair::kZeroArea) dropped[note.detail].push_back(note.polygon);
  }
  std::vector<std::string> lines;
  for (const auto& [reason, polygons] : dropped) {
    std::string ids;
    for (std::size_t i = 0; i < polygons.size() && i < kExamples; ++i) {
      ids += (i == 0 ? "" : ", ") + scene.polygons[polygons[i]].id;
    }
    if (polygons.size() > kExamples) ids += ", ...";
    const std::string what =
        polygons.size() == 1
            ? "polygon " + ids + " is dropped: " + reason
            : grouped(polygons.size()) + " polygons are dropped (" + ids + "): " + reason;
    lines.push_back(scene.file + ": " + what);
  }
  return lines;
}

}  // namespace gnomon::report
