// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "comparison/received_light/received_light.h"
#include "gnomon/kernel/kernel_list.h"
#include "gnomon/result/classes.h"
#include "gnomon/scene/rational_text.h"
#include "report/text/number_text.h"
#include "report/text/shell_word.h"
#include "report/text/table.h"

namespace gnomon::comparison {

namespace {

using report::Align;
using report::grouped;
using report::rounded;
using report::TextTable;

constexpr std::string_view kReference = "double";

std::string side_text(const ReceivedLightReport& report) {
  return std::string(name_of(report.receiver.side)) + " of " +
         report.scene->polygons[report.receiver.polygon].id;
}

std::string position_text(const Position& position) {
  return position[0].to_text() + ',' + position[1].to_text() + ',' + position[2].to_text();
}

std::string points_text(const ReceivedLightReport& report) {
  std::array<std::size_t, 3> counts{};
  for (const PointSight& point : report.points) ++counts[static_cast<std::size_t>(point.sight)];
  return fmt::format(
      "{} on the {}: {} see all of the light, {} a part, {} nothing\n",
      report.points.size() == 1 ? "1 point" : grouped(report.points.size()) + " points",
      side_text(report), counts[2], counts[1], counts[0]);
}

std::string list_text(const ReceivedLightReport& report) {
  TextTable table({{"point"},
                   {"sees"},
                   {"of the light", Align::kRight},
                   {"receives", Align::kRight},
                   {"without casters", Align::kRight}});
  for (const PointSight& point : report.points) {
    table.add_row({position_text(point.position), name_of(point.sight),
                   text_for_people(point.visible), rounded(point.received.value, 9),
                   rounded(point.unobstructed.value, 9)});
  }
  return table.to_string() + '\n';
}

/// How to see the worst point of a kernel alone; empty where a command line cannot name the point.
std::string repeat_text(const ReceivedLightReport& report, const KernelReceipt& kernel) {
  const Position& point = report.points[kernel.worst].position;
  const bool is_named = report.scene->numbers == NumberMeaning::kDecimal ||
                        std::ranges::all_of(point, &Number::is_double);
  if (!is_named || report.scene->file.empty()) return {};
  std::string on = report.scene->polygons[report.receiver.polygon].id;
  if (report.receiver.side == Side::kBack) on += ":back";
  return fmt::format("gnomon convert {} seen.json --from={} --on {} --area-light {}",
                     report::shell_word(report.scene->file), position_text(point),
                     report::shell_word(on),
                     report::shell_word(report.scene->lights[report.receiver.light].id));
}

std::string verdict_of(const KernelReceipt& kernel, double tolerance) {
  if (kernel.exact && kernel.differs) return "differs";
  if (kernel.failed(tolerance)) return "failed";
  return kernel.exact ? "exact shares" : "within tolerance";
}

std::string kernels_text(const ReceivedLightReport& report) {
  TextTable table({{"kernel"},
                   {"verdict"},
                   {"points", Align::kRight},
                   {"wrong", Align::kRight},
                   {"share off", Align::kRight},
                   {"received off", Align::kRight},
                   {"of its own", Align::kRight},
                   {"time", Align::kRight}});
  const auto reference = std::ranges::find(report.kernels, kReference, &KernelReceipt::kernel);
  for (const KernelReceipt& kernel : report.kernels) {
    std::string time = "-";
    if (reference != report.kernels.end() && reference->cpu_seconds > 0) {
      time = rounded(kernel.cpu_seconds / reference->cpu_seconds, 2) + 'x';
    }
    table.add_row({kernel.kernel, verdict_of(kernel, report.tolerance), grouped(kernel.points),
                   grouped(kernel.wrong), rounded(kernel.share_off, 3),
                   rounded(kernel.received_off, 3), rounded(kernel.relative_off, 3), time});
    if (!kernel.error.empty()) table.add_note(kernel.error);
    if (kernel.points == 0 || !kernel.failed(report.tolerance)) continue;
    const std::string& at = position_text(report.points[kernel.worst].position);
    table.add_note("worst at " + at);
    if (const std::string repeat = repeat_text(report, kernel); !repeat.empty()) {
      table.add_note(repeat);
    }
  }
  return table.to_string();
}

}  // namespace

std::string received_light_text(const ReceivedLightReport& report) {
  const Scene& scene = *report.scene;
  std::string text =
      fmt::format("scene {}, light {}; ", scene.name.empty() ? scene.file : scene.name,
                  scene.lights[report.receiver.light].id);
  text += points_text(report);
  if (!report.kernels.empty()) {
    text += fmt::format(
        "visible part of the light by {}; tolerance {} of the light's area, and of "
        "what\nis received without casters\n",
        report.kernels.front().algorithm, rounded(report.tolerance, 3));
  }
  text += '\n';
  if (report.list_points) text += list_text(report);
  if (!report.kernels.empty()) text += kernels_text(report);
  if (report.interrupted) text += "Interrupted: the points above were judged.\n";
  return text;
}

}  // namespace gnomon::comparison
