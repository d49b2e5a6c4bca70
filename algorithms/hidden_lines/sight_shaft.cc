// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/hidden_lines/sight_shaft.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {

namespace {

using Point = NearPositions::Point;

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// value 2^-shift, off by 2^-52 of itself.
double scaled(const mpz_class& value, unsigned shift) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
  return std::ldexp(mantissa, static_cast<int>(exponent - static_cast<long>(shift)));
}

}  // namespace

NearPositions::NearPositions(const Geometry& geometry, const LightPoint& viewer)
    : directional_(viewer.directional) {
  const GridPositions& grid = geometry.grid;
  const unsigned shift = grid.is_narrow() ? 0 : grid.bits() - GridPositions::kNarrowBits;
  points_.resize(grid.size());
  for (VertexId v = 0; v < grid.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      double& x = points_[v][static_cast<std::size_t>(k)];
      x = grid.is_narrow() ? static_cast<double>(grid.narrow(v, k))
                           : scaled(grid.wide(v, k), shift);
      largest_ = std::max(largest_, x);
    }
  }
  if (directional_) {
    std::size_t bits = 0;
    for (const mpz_class& x : viewer.grid) {
      bits = std::max(bits, mpz_sizeinbase(x.get_mpz_t(), 2));
    }
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      viewer_[k] = scaled(viewer.grid[k], static_cast<unsigned>(bits));
      most = std::max(most, std::fabs(viewer_[k]));
    }
    for (double& x : viewer_) x /= most;
  } else {
    for (std::size_t k = 0; k < 3; ++k) {
      viewer_[k] = scaled(viewer.grid[k], shift);
      largest_ = std::max(largest_, std::fabs(viewer_[k]));
    }
  }
}

SightShaft::SightShaft(const NearPositions& positions, VertexId a, VertexId b)
    : positions_(positions), edge_(positions.box_of(std::array{a, b})), at_(positions[a]) {
  const Point along = difference(positions[b], positions[a]);
  const Point to_viewer =
      positions.directional() ? positions.viewer() : difference(positions.viewer(), positions[a]);
  if (!positions.directional()) {
    for (std::size_t k = 0; k < 3; ++k) {
      edge_.low[k] -= positions.viewer()[k];
      edge_.high[k] -= positions.viewer()[k];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    normal_[k] = along[u] * to_viewer[v] - along[v] * to_viewer[u];
  }
  // With M the largest coordinate, differences are below 2 M and off by 2^-50 M, a component of the
  // normal is below 8 M^2 and off by 2^-46 M^2, and its product with a difference of points is off
  // by less than 2^-42 M^3 for the three axes together. Along a direction one factor M is 1.
  const double m = positions.largest();
  plane_bound_ = 0x1p-40 * m * m * (positions.directional() ? 1 : m);
}

bool SightShaft::is_beside(const Box& box) const {
  const Point& viewer = positions_.viewer();
  double from = 0;
  double to = positions_.directional() ? std::numeric_limits<double>::infinity() : 1;
  // s factor <= bound.
  const auto bound_by = [&](double factor, double bound) {
    if (factor > 0) {
      to = std::min(to, bound / factor);
    } else if (factor < 0) {
      from = std::max(from, bound / factor);
    } else if (bound < 0) {
      to = -1;
    }
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (positions_.directional()) {
      bound_by(viewer[k], box.high[k] - edge_.low[k]);
      bound_by(-viewer[k], edge_.high[k] - box.low[k]);
    } else {
      bound_by(edge_.low[k], box.high[k] - viewer[k]);
      bound_by(-edge_.high[k], viewer[k] - box.low[k]);
    }
  }
  return from > to;
}

bool SightShaft::is_off_plane(const Box& box) const {
  double middle = 0, reach = plane_bound_;
  for (std::size_t k = 0; k < 3; ++k) {
    middle += normal_[k] * ((box.low[k] + box.high[k]) / 2 - at_[k]);
    reach += std::fabs(normal_[k]) * ((box.high[k] - box.low[k]) / 2);
  }
  return std::fabs(middle) > reach;
}

}  // namespace gnomon
