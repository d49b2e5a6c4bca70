// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/error_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::comparison {

namespace {

using report::Colour;
using report::Paint;

// Colours that people who see no red or green tell apart (Okabe and Ito 2008).
constexpr std::array<Colour, 8> kColours = {{{0, 114, 178},
                                             {213, 94, 0},
                                             {0, 158, 115},
                                             {204, 121, 167},
                                             {230, 159, 0},
                                             {86, 180, 233},
                                             {110, 110, 110},
                                             {0, 0, 0}}};
constexpr double kLegendStep = 110, kLegendLeft = 20;
constexpr int kLeastPower = -17;

}  // namespace

KernelColours kernel_colours(const std::set<std::string>& kernels) {
  KernelColours colours;
  for (const std::string& kernel : kernels) {
    colours.emplace(kernel, kColours[colours.size() % kColours.size()]);
  }
  return colours;
}

double legend_width(const KernelColours& colours) {
  return kLegendLeft + kLegendStep * static_cast<double>(colours.size());
}

void draw_legend(report::SvgPicture& picture, const KernelColours& colours) {
  double x = kLegendLeft;
  for (const auto& [kernel, colour] : colours) {
    Paint paint;
    paint.fill = report::colour_text(colour);
    picture.circle({x, 18}, 5, paint);
    picture.text({x + 10, 22}, kernel, 12, kPlotInk);
    x += kLegendStep;
  }
}

double ErrorAxis::y_of(double share) const {
  const double power = share > 0 ? std::max<double>(kLeastPower, std::log10(share)) : kLeastPower;
  return top + (bottom - top) * std::min(power, 0.0) / kLeastPower;
}

void ErrorAxis::draw(report::SvgPicture& picture) const {
  Paint paint;
  paint.stroke = report::colour_text(kPlotGrid);
  paint.stroke_width = 1;
  for (int power = kLeastPower; power <= 0; power += power == kLeastPower ? 2 : 3) {
    const double y = y_of(std::pow(10, power));
    picture.line({left, y}, {right, y}, paint);
    picture.text({left - 8, y + 4},
                 power == kLeastPower ? "below 1e-17" : "1e" + std::to_string(power), 11, kPlotInk,
                 "end");
  }
  picture.text({left, top - 6}, "wrong share of the worst polygon", 11, kPlotInk);
}

}  // namespace gnomon::comparison
