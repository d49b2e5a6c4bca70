// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "comparison/error_plot.h"
#include "comparison/tradeoff_text.h"
#include "report/pictures/svg.h"
#include "report/text/number_text.h"

namespace gnomon::comparison {

namespace {

using report::Paint;
using report::PixelPoint;

using Rows = std::vector<const TradeoffRow*>;

std::map<std::string, Rows> panels_of(const Tradeoff& tradeoff) {
  std::map<std::string, Rows> panels;
  for (const TradeoffRow& row : tradeoff.rows) {
    if (!row.measurement.timed() || !error_of(row.measurement) || row.measurement.seconds <= 0) {
      continue;
    }
    std::string name = row.request.scene;
    if (row.request.size) name += ", " + report::grouped(row.polygons) + " polygons";
    if (row.request.lights == LightsAsked::kArea) name += ", area lights";
    panels[name].push_back(&row);
  }
  return panels;
}

/// One scene: milliseconds to the right, wrong shares upwards.
class Panel {
 public:
  static constexpr double kWidth = 620, kHeight = 380;

  Panel(report::SvgPicture& picture, double top, const Rows& rows)
      : picture_(picture), top_(top), rows_(rows) {
    double least = INFINITY, most = 0;
    for (const TradeoffRow* row : rows) {
      least = std::min(least, row->measurement.seconds);
      most = std::max(most, row->measurement.seconds);
    }
    first_ = static_cast<int>(std::floor(std::log10(least * kMilli)));
    last_ = std::max(first_ + 1, static_cast<int>(std::ceil(std::log10(most * kMilli))));
  }

  void draw(const std::string& title, const KernelColours& colours) {
    picture_.text({kLeft, top_ + 20}, title, 14, kPlotInk, "start", true);
    draw_grid();
    draw_front();
    for (const TradeoffRow* row : rows_) {
      Paint paint;
      paint.fill = report::colour_text(colours.at(row->request.kernel));
      paint.opacity = row->on_front ? 1 : 0.55;
      picture_.circle(place(*row), row->on_front ? 5 : 3.2, paint);
    }
  }

 private:
  static constexpr double kLeft = 80, kRight = 600, kTop = 40, kBottom = 330, kMilli = 1000;

  double x_of(double milliseconds) const {
    return kLeft + (kRight - kLeft) * (std::log10(milliseconds) - first_) / (last_ - first_);
  }
  ErrorAxis errors() const { return {kLeft, kRight, top_ + kTop, top_ + kBottom}; }
  PixelPoint place(const TradeoffRow& row) const {
    return {x_of(row.measurement.seconds * kMilli), errors().y_of(*error_of(row.measurement))};
  }

  void draw_grid() {
    Paint paint;
    paint.stroke = report::colour_text(kPlotGrid);
    paint.stroke_width = 1;
    for (int power = first_; power <= last_; ++power) {
      const double x = x_of(std::pow(10, power));
      picture_.line({x, top_ + kTop}, {x, top_ + kBottom}, paint);
      picture_.text({x, top_ + kBottom + 18}, report::shortest(std::pow(10, power)), 11, kPlotInk,
                    "middle");
    }
    errors().draw(picture_);
    picture_.text({(kLeft + kRight) / 2, top_ + kBottom + 36}, "CPU time, milliseconds", 11,
                  kPlotInk, "middle");
  }

  void draw_front() {
    Rows front;
    std::ranges::copy_if(rows_, std::back_inserter(front), &TradeoffRow::on_front);
    std::ranges::sort(front, {}, [](const TradeoffRow* row) { return row->measurement.seconds; });
    Paint paint;
    paint.stroke = report::colour_text(kPlotInk);
    paint.stroke_width = 1.2;
    for (std::size_t i = 1; i < front.size(); ++i) {
      const PixelPoint a = place(*front[i - 1]), b = place(*front[i]);
      picture_.line(a, {b[0], a[1]}, paint);
      picture_.line({b[0], a[1]}, b, paint);
    }
  }

  report::SvgPicture& picture_;
  double top_;
  const Rows& rows_;
  int first_ = 0, last_ = 1;  // powers of ten of milliseconds
};

}  // namespace

void write_tradeoff_plot(report::TextSink& sink, const Tradeoff& tradeoff) {
  constexpr double kLegend = 40;
  const std::map<std::string, Rows> panels = panels_of(tradeoff);
  std::set<std::string> kernels;
  for (const TradeoffRow& row : tradeoff.rows) kernels.insert(row.request.kernel);
  const KernelColours colours = kernel_colours(kernels);
  report::SvgPicture picture(std::max(Panel::kWidth, legend_width(colours)),
                             kLegend + Panel::kHeight * static_cast<double>(panels.size()),
                             "Time and error of kernels and methods");
  draw_legend(picture, colours);
  double top = kLegend;
  for (const auto& [name, rows] : panels) {
    Panel(picture, top, rows).draw(name, colours);
    top += Panel::kHeight;
  }
  picture.write(sink);
}

}  // namespace gnomon::comparison
