// SPDX-License-Identifier: GPL-3.0-or-later
// What the pictures of errors have in common: one colour a kernel, and wrong shares upwards on a
// logarithmic scale.
#ifndef GNOMON_COMPARISON_ERROR_PLOT_H
#define GNOMON_COMPARISON_ERROR_PLOT_H

#include <map>
#include <set>
#include <string>

#include "report/pictures/svg.h"

namespace gnomon::comparison {

inline constexpr report::Colour kPlotInk{60, 60, 60}, kPlotGrid{225, 225, 225};

using KernelColours = std::map<std::string, report::Colour>;
KernelColours kernel_colours(const std::set<std::string>& kernels);
/// Pixels that draw_legend() takes to the right of x = 0.
double legend_width(const KernelColours& colours);
/// A dot and a name a kernel, in the picture's uppermost 40 pixels.
void draw_legend(report::SvgPicture& picture, const KernelColours& colours);

/// Wrong shares of the worst polygon, in a frame of pixels.
struct ErrorAxis {
  double left, right, top, bottom;

  /// Where a share is; what is below 1e-17 is on the lowest line.
  double y_of(double share) const;
  /// Lines across the frame, with their shares to its left.
  void draw(report::SvgPicture& picture) const;
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ERROR_PLOT_H
