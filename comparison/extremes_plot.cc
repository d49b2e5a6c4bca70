// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "comparison/error_plot.h"
#include "comparison/extremes_text.h"

namespace gnomon::comparison {

namespace {

using report::Paint;
using report::PixelPoint;

using Curves = std::vector<const ExtremeCurve*>;

/// One axis by one method: steps to the right, wrong shares upwards, a line a kernel.
class Panel {
 public:
  static constexpr double kWidth = 460, kHeight = 290;

  Panel(report::SvgPicture& picture, PixelPoint corner, const Curves& curves)
      : picture_(picture),
        errors_{corner[0] + 85, corner[0] + kWidth - 15, corner[1] + 44, corner[1] + kHeight - 44},
        curves_(curves) {
    first_ = curves.front()->steps.front();
    last_ = std::max(first_ + 1, curves.front()->steps.back());
  }

  void draw(const KernelColours& colours) const {
    const ExtremeCurve& first = *curves_.front();
    const std::string name(first.axis->name);
    picture_.text({errors_.left, errors_.top - 24}, name + ", " + first.system, 13, kPlotInk,
                  "start", true);
    errors_.draw(picture_);
    Paint tolerance;
    tolerance.stroke = report::colour_text(kPlotInk);
    tolerance.stroke_width = 0.8;
    const double y = errors_.y_of(kUsualTolerance);
    picture_.line({errors_.left, y}, {errors_.right, y}, tolerance);
    for (const int step : first.steps) {
      picture_.text({x_of(step), errors_.bottom + 16}, std::to_string(step), 10, kPlotInk,
                    "middle");
    }
    picture_.text({(errors_.left + errors_.right) / 2, errors_.bottom + 32},
                  std::string(first.axis->summary) + ' ' + std::string(first.axis->value) + ": k",
                  11, kPlotInk, "middle");
    for (const ExtremeCurve* curve : curves_) draw_curve(*curve, colours);
  }

 private:
  /// What a verdict calls within tolerance (`certify --tolerance`).
  static constexpr double kUsualTolerance = 1e-9;

  double x_of(int step) const {
    return errors_.left + (errors_.right - errors_.left) * (step - first_) / (last_ - first_);
  }

  /// A run without an answer breaks the line.
  void draw_curve(const ExtremeCurve& curve, const KernelColours& colours) const {
    Paint line;
    line.stroke = report::colour_text(colours.at(curve.kernel));
    line.stroke_width = 1.5;
    Paint dot;
    dot.fill = line.stroke;
    std::optional<PixelPoint> before;
    for (std::size_t i = 0; i < curve.steps.size(); ++i) {
      const auto share = error_of(curve.rows[i]->measurement);
      if (!share) {
        before.reset();
        continue;
      }
      const PixelPoint at{x_of(curve.steps[i]), errors_.y_of(*share)};
      if (before) picture_.line(*before, at, line);
      picture_.circle(at, failure_of(*curve.rows[i]).empty() ? 1.8 : 3.2, dot);
      before = at;
    }
  }

  report::SvgPicture& picture_;
  ErrorAxis errors_;
  const Curves& curves_;
  int first_ = 0, last_ = 1;
};

}  // namespace

void write_extremes_plot(report::TextSink& sink, const Extremes& extremes) {
  constexpr double kLegend = 40;
  std::set<std::string> kernels;
  std::vector<std::string> systems;
  std::vector<const ExtremeAxis*> axes;
  std::map<std::pair<const ExtremeAxis*, std::string>, Curves> panels;
  for (const ExtremeCurve& curve : extremes.curves) {
    kernels.insert(curve.kernel);
    if (std::ranges::find(systems, curve.system) == systems.end()) systems.push_back(curve.system);
    if (std::ranges::find(axes, curve.axis) == axes.end()) axes.push_back(curve.axis);
    panels[{curve.axis, curve.system}].push_back(&curve);
  }
  const KernelColours colours = kernel_colours(kernels);
  report::SvgPicture picture(
      std::max(Panel::kWidth * static_cast<double>(systems.size()), legend_width(colours)),
      kLegend + Panel::kHeight * static_cast<double>(axes.size()),
      "Errors along axes of difficulty");
  draw_legend(picture, colours);
  double top = kLegend;
  for (const ExtremeAxis* axis : axes) {
    double left = 0;
    for (const std::string& system : systems) {
      const auto found = panels.find({axis, system});
      if (found == panels.end()) continue;
      Panel(picture, {left, top}, found->second).draw(colours);
      left += Panel::kWidth;
    }
    top += Panel::kHeight;
  }
  picture.write(sink);
}

}  // namespace gnomon::comparison
