// SPDX-License-Identifier: GPL-3.0-or-later
// Slater 1992, Figures 9 to 12: time against pieces of the scene BSP, one dot a room. Where the
// paper has a least squares line there is one, where it joins the dots they are joined.
#include <algorithm>
#include <cmath>
#include <set>

#include "comparison/error_plot.h"
#include "papers.h"
#include "report/pictures/svg.h"
#include "report/text/number_text.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

using comparison::kPlotGrid;
using comparison::kPlotInk;
using report::Paint;
using report::PixelPoint;

struct Curve {
  std::size_t method;
  std::vector<double> x, y;  // by x
};

Curve curve_of(const RoomSeries& series, std::size_t method) {
  std::vector<std::pair<double, double>> dots;
  for (std::size_t i = 0; i < series.pieces.size(); ++i) {
    dots.emplace_back(series.pieces[i], series.milliseconds[method][i]);
  }
  std::ranges::sort(dots);
  Curve curve{method, {}, {}};
  for (const auto& [x, y] : dots) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  return curve;
}

/// 1, 2 or 5 times a power of ten, so that there are at most `most` steps to `value`.
double step_to(double value, double most) {
  const double power = std::pow(10, std::floor(std::log10(value / most)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (value / (factor * power) <= most) return factor * power;
  }
  return 10 * power;
}

/// One figure: pieces to the right, milliseconds upwards, both from 0.
class Panel {
 public:
  static constexpr double kWidth = 430, kHeight = 300;

  Panel(report::SvgPicture& picture, PixelPoint corner, const std::vector<Curve>& curves)
      : picture_(picture),
        left_(corner[0] + 62),
        right_(corner[0] + kWidth - 20),
        top_(corner[1] + 42),
        bottom_(corner[1] + kHeight - 46),
        curves_(curves) {
    for (const Curve& curve : curves) {
      most_x_ = std::max(most_x_, std::ranges::max(curve.x) * 1.05);
      most_y_ = std::max(most_y_, std::ranges::max(curve.y) * 1.05);
    }
  }

  void draw(const std::string& title, bool fitted, const comparison::KernelColours& colours) const {
    picture_.text({left_, top_ - 18}, title, 13, kPlotInk, "start", true);
    draw_grid();
    for (const Curve& curve : curves_) {
      const std::string colour =
          report::colour_text(colours.at(std::string(kSlatersMethods[curve.method])));
      Paint line;
      line.stroke = colour;
      line.stroke_width = 1.4;
      if (fitted) {
        const Line fit = line_through(curve.x, curve.y);
        const auto at = [&](double x) {
          return PixelPoint{x_of(x), y_of(fit.at_zero + fit.slope * x)};
        };
        // From where it is not below zero.
        const double from = fit.slope > 0 ? std::max(0.0, -fit.at_zero / fit.slope) : 0;
        picture_.line(at(from), at(curve.x.back()), line);
      }
      Paint dot;
      dot.fill = colour;
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        const PixelPoint at{x_of(curve.x[i]), y_of(curve.y[i])};
        if (!fitted && i > 0) picture_.line({x_of(curve.x[i - 1]), y_of(curve.y[i - 1])}, at, line);
        picture_.circle(at, 3, dot);
      }
    }
  }

 private:
  double x_of(double x) const { return left_ + (right_ - left_) * x / most_x_; }
  double y_of(double y) const { return bottom_ + (top_ - bottom_) * y / most_y_; }

  void draw_grid() const {
    Paint paint;
    paint.stroke = report::colour_text(kPlotGrid);
    paint.stroke_width = 1;
    const double step_x = step_to(most_x_, 6), step_y = step_to(most_y_, 6);
    for (int i = 0; i * step_x <= most_x_; ++i) {
      const double x = x_of(i * step_x);
      picture_.line({x, top_}, {x, bottom_}, paint);
      picture_.text({x, bottom_ + 16}, report::rounded(i * step_x), 10, kPlotInk, "middle");
    }
    for (int i = 0; i * step_y <= most_y_; ++i) {
      const double y = y_of(i * step_y);
      picture_.line({left_, y}, {right_, y}, paint);
      picture_.text({left_ - 6, y + 4}, report::rounded(i * step_y), 10, kPlotInk, "end");
    }
    picture_.text({(left_ + right_) / 2, bottom_ + 32}, "pieces of the scene BSP", 11, kPlotInk,
                  "middle");
    picture_.text({left_, top_ - 4}, "CPU time, milliseconds", 10, kPlotInk);
  }

  report::SvgPicture& picture_;
  double left_, right_, top_, bottom_;
  const std::vector<Curve>& curves_;
  double most_x_ = 0, most_y_ = 0;
};

struct Figure {
  const char* name;
  const char* lamps;
  std::vector<std::size_t> methods;
  bool fitted;
  const char* kernel;  // ours
  bool is_printed;     // as numbers
};
const std::vector<Figure>& figures() {
  static const std::vector<Figure> kFigures = {
      {"Figure 9", "one lamp", {0, 1, 2}, true, "double", true},
      {"Figure 10", "both lamps", {0, 1, 2}, true, "double", true},
      {"Figure 11", "both lamps", {1, 2}, false, "double", true},
      {"Figure 12", "both lamps", {1, 2}, false, "plane", false}};
  return kFigures;
}

}  // namespace

std::string slater_figures(const std::vector<RoomSeries>& printed,
                           const std::vector<RoomSeries>& ours) {
  constexpr double kLegend = 40;
  std::set<std::string> names;
  for (const std::string_view method : kSlatersMethods) names.emplace(method);
  const comparison::KernelColours colours = comparison::kernel_colours(names);
  report::SvgPicture picture(2 * Panel::kWidth,
                             kLegend + Panel::kHeight * static_cast<double>(figures().size()),
                             "Slater 1992, Figures 9 to 12");
  comparison::draw_legend(picture, colours);
  double top = kLegend;
  for (const Figure& figure : figures()) {
    double left = 0;
    for (const auto* all : {&printed, &ours}) {
      for (const RoomSeries& series : *all) {
        const bool is_ours = all == &ours;
        if (series.lamps != figure.lamps || (is_ours && series.machine != figure.kernel) ||
            (!is_ours && !figure.is_printed)) {
          continue;
        }
        std::vector<Curve> curves;
        for (const std::size_t method : figure.methods) curves.push_back(curve_of(series, method));
        Panel(picture, {left, top}, curves)
            .draw(std::string(figure.name) + ", " + series.lamps + ": " + series.machine,
                  figure.fitted, colours);
      }
      left += Panel::kWidth;
    }
    top += Panel::kHeight;
  }
  report::StringSink sink;
  picture.write(sink);
  return sink.text();
}

}  // namespace gnomon::bench
