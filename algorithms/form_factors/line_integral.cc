// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/form_factors/line_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace gnomon {

namespace {

constexpr int kNodes = 16;
/// Of the ellipse in which the integrand is analytic (docs: form-factors).
constexpr double kEllipse = 3;
/// Pieces of an edge that are shorter are bounded and not refined.
constexpr double kShortest = 0x1p-44;
constexpr int kMostIntervals = 4000;
/// Directions that differ by less are parallel.
constexpr double kParallel = 1e-14;
/// Share of its terms that a short sum of logarithms and arcs is off by: some nine units in the
/// last place.
constexpr double kRoundings = 1e-15;
/// Stands for a distance or a length of 0 where its logarithm or inverse is taken: any number far
/// below all others of a scene of extent 1, and above what underflows.
constexpr double kAlmostNothing = 1e-300;
/// Newton's steps end where they no longer change a node in (-1, 1).
constexpr double kLastStep = 1e-17;

struct Rule {
  std::array<double, kNodes> node{}, weight{};
};

/// Of [-1, 1]; by Newton's method on the Legendre polynomial.
Rule gauss_legendre() {
  Rule rule;
  for (int i = 0; i < kNodes; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (kNodes + 0.5)), slope = 1;
    for (int step = 0; step < 100; ++step) {
      double p = 1, before = 0;
      for (int k = 1; k <= kNodes; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = kNodes * (x * p - before) / (x * x - 1);
      const double change = p / slope;
      x -= change;
      if (std::fabs(change) < kLastStep) break;
    }
    rule.node[static_cast<std::size_t>(i)] = x;
    rule.weight[static_cast<std::size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

struct Segment {
  Vector start{}, direction{};  // of length 1
  double size = 0;
  Vector at(double s) const { return start + s * direction; }
};

Segment segment(const Vector& a, const Vector& b) { return {a, unit(b - a), length(b - a)}; }

/// The integral of ln(r / unit) along f, r the distance from the point.
double along(const Vector& point, const Segment& f, double log_unit) {
  const Vector from = point - f.start;
  const double foot = dot(from, f.direction);
  const Vector across = from - foot * f.direction;
  const double height = length(across);
  const auto part = [&](double u) {
    const double squared = u * u + height * height;
    const double log = squared > 0 ? 0.5 * u * std::log(squared) : 0;
    return log - u + (height > 0 ? height * std::atan(u / height) : 0);
  };
  return part(f.size - foot) - part(-foot) - f.size * log_unit;
}

/// The distance of a point from a segment.
double distance(const Vector& point, const Segment& f) {
  const double foot = std::clamp(dot(point - f.start, f.direction), 0.0, f.size);
  return length(point - f.at(foot));
}

/// A lower bound of the distance of e between s and t from f.
double least_distance(const Segment& e, double s, double t, const Segment& f) {
  return distance(e.at((s + t) / 2), f) - (t - s) / 2;
}

/// Of parallel edges, at a distance or on one line: the integral of ln r has a primitive of s - t.
Bounded parallel_edges(const Segment& e, const Segment& f, double log_unit) {
  const Vector from = f.start - e.start;
  const double begin = dot(from, e.direction);
  const double end = begin + f.size * dot(f.direction, e.direction);
  const double height = length(from - begin * e.direction);
  double terms = 0;
  const auto primitive = [&](double x) {
    const double squared = x * x + height * height;
    if (squared == 0) return 0.0;
    const double log = (x * x - height * height) / 4 * std::log(squared);
    const double angle = height > 0 ? height * x * std::atan(x / height) : 0;
    terms += std::fabs(log) + x * x + std::fabs(angle);
    return log - 0.75 * x * x + angle;
  };
  const double low = std::min(begin, end), high = std::max(begin, end);
  const double sum =
      primitive(high) - primitive(high - e.size) - primitive(low) + primitive(low - e.size);
  return {sum - e.size * f.size * log_unit, kRoundings * terms + kParallel * (e.size + f.size)};
}

/// The integral of ln(r / unit) along both.
Bounded along_both(const Segment& e, const Segment& f, double log_unit) {
  const bool close = least_distance(e, 0, e.size, f) < 2 * (kEllipse - 1) * e.size / 2;
  if (close && length(cross(e.direction, f.direction)) < kParallel) {
    return parallel_edges(e, f, log_unit);
  }
  static const Rule rule = gauss_legendre();
  struct Interval {
    double begin, end;
  };
  Bounded sum;
  std::vector<Interval> stack{{0, e.size}};
  for (int done = 0; !stack.empty(); ++done) {
    const auto [begin, end] = stack.back();
    stack.pop_back();
    const double half = (end - begin) / 2, middle = (begin + end) / 2;
    const double apart = least_distance(e, begin, end, f);
    const bool far = apart >= 2 * (kEllipse - 1) * half;
    if (!far && half > kShortest && done < kMostIntervals) {
      stack.push_back({begin, middle});
      stack.push_back({middle, end});
      continue;
    }
    double own = 0;
    for (std::size_t i = 0; i < kNodes; ++i) {
      own += rule.weight[i] * along(e.at(middle + half * rule.node[i]), f, log_unit);
    }
    sum.value += half * own;
    const double least = std::max(apart, kAlmostNothing);
    const double most = f.size * (std::fabs(std::log(least)) + std::fabs(log_unit) + 3);
    const double decay = std::pow(kEllipse, -2 * (kNodes - 1)) / (1 - 1 / (kEllipse * kEllipse));
    const double unknown = f.size * (std::fabs(std::log(f.size)) + std::fabs(log_unit) + 8);
    sum.error += half * (far ? 64.0 / 15 * decay * most : 2 * unknown);
    sum.error += kRoundings * half * std::fabs(own);
  }
  return sum;
}

}  // namespace

Bounded exchange_area(std::span<const Vector> from, std::span<const Vector> to) {
  // Loops are closed, so that a factor of r does not matter: the sizes of the terms are least where
  // it is about the distance.
  Vector middle{};
  for (const Vector& a : from) middle = middle + 1.0 / static_cast<double>(from.size()) * a;
  Vector other{};
  for (const Vector& b : to) other = other + 1.0 / static_cast<double>(to.size()) * b;
  const double apart = length(other - middle);
  const double log_unit = apart > 0 ? std::log(apart) : 0;
  Bounded sum;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Segment e = segment(from[i], from[i + 1 == from.size() ? 0 : i + 1]);
    for (std::size_t j = 0; j < to.size(); ++j) {
      const Segment f = segment(to[j], to[j + 1 == to.size() ? 0 : j + 1]);
      const double cosine = dot(e.direction, f.direction);
      if (cosine == 0 || e.size == 0 || f.size == 0) continue;
      const Bounded own = along_both(e, f, log_unit);
      sum.value += cosine * own.value;
      sum.error += std::fabs(cosine) * own.error + kRoundings * std::fabs(own.value);
    }
  }
  return {std::fabs(sum.value) / (2 * std::numbers::pi), sum.error / (2 * std::numbers::pi)};
}

}  // namespace gnomon
