// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "comparison/tradeoff_text.h"
#include "report/pictures/svg.h"
#include "report/text/number_text.h"

namespace gnomon::comparison {

namespace {

using report::Colour;
using report::Paint;
using report::PixelPoint;

/// Errors below are drawn as 0, on the lowest line.
constexpr int kLeastPower = -17;

// Colours that people who see no red or green tell apart (Okabe and Ito 2008).
constexpr std::array<Colour, 8> kColours = {{{0, 114, 178},
                                             {213, 94, 0},
                                             {0, 158, 115},
                                             {204, 121, 167},
                                             {230, 159, 0},
                                             {86, 180, 233},
                                             {110, 110, 110},
                                             {0, 0, 0}}};
constexpr Colour kInk{60, 60, 60}, kGrid{225, 225, 225};

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

  void draw(const std::string& title, const std::map<std::string, Colour>& colours) {
    picture_.text({kLeft, top_ + 20}, title, 14, kInk, "start", true);
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
  double y_of(double error) const {
    const double power = error > 0 ? std::max<double>(kLeastPower, std::log10(error)) : kLeastPower;
    return top_ + kTop + (kBottom - kTop) * power / kLeastPower;
  }
  PixelPoint place(const TradeoffRow& row) const {
    return {x_of(row.measurement.seconds * kMilli), y_of(*error_of(row.measurement))};
  }

  void draw_grid() {
    Paint paint;
    paint.stroke = report::colour_text(kGrid);
    paint.stroke_width = 1;
    for (int power = first_; power <= last_; ++power) {
      const double x = x_of(std::pow(10, power));
      picture_.line({x, top_ + kTop}, {x, top_ + kBottom}, paint);
      picture_.text({x, top_ + kBottom + 18}, report::shortest(std::pow(10, power)), 11, kInk,
                    "middle");
    }
    for (int power = kLeastPower; power <= 0; power += power == kLeastPower ? 2 : 3) {
      const double y = y_of(std::pow(10, power));
      picture_.line({kLeft, y}, {kRight, y}, paint);
      picture_.text({kLeft - 8, y + 4},
                    power == kLeastPower ? "below 1e-17" : "1e" + std::to_string(power), 11, kInk,
                    "end");
    }
    picture_.text({(kLeft + kRight) / 2, top_ + kBottom + 36}, "CPU time, milliseconds", 11, kInk,
                  "middle");
    picture_.text({kLeft, top_ + kTop - 6}, "wrong share of the worst polygon", 11, kInk);
  }

  void draw_front() {
    Rows front;
    std::ranges::copy_if(rows_, std::back_inserter(front), &TradeoffRow::on_front);
    std::ranges::sort(front, {}, [](const TradeoffRow* row) { return row->measurement.seconds; });
    Paint paint;
    paint.stroke = report::colour_text(kInk);
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
  constexpr double kLegend = 40, kStep = 110;
  const std::map<std::string, Rows> panels = panels_of(tradeoff);
  std::map<std::string, Colour> colours;
  for (const TradeoffRow& row : tradeoff.rows) {
    colours.try_emplace(row.request.kernel, kColours[colours.size() % kColours.size()]);
  }
  const double columns = std::max<double>(5, static_cast<double>(colours.size()));
  report::SvgPicture picture(std::max(Panel::kWidth, 40 + kStep * columns),
                             kLegend + Panel::kHeight * static_cast<double>(panels.size()),
                             "Time and error of kernels and methods");
  double x = 20;
  for (const auto& [kernel, colour] : colours) {
    Paint paint;
    paint.fill = report::colour_text(colour);
    picture.circle({x, 18}, 5, paint);
    picture.text({x + 10, 22}, kernel, 12, kInk);
    x += kStep;
  }
  double top = kLegend;
  for (const auto& [name, rows] : panels) {
    Panel(picture, top, rows).draw(name, colours);
    top += Panel::kHeight;
  }
  picture.write(sink);
}

}  // namespace gnomon::comparison
