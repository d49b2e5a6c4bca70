// SPDX-License-Identifier: LGPL-3.0-or-later
// Triangles of a convex face with corners between collinear edges: ears are clipped, the best
// shaped first, never one without area and never one that leaves collinear corners alone.
#include <algorithm>
#include <cmath>

#include "gnomon/algorithms/shading_mesh.h"

namespace gnomon {

namespace {

using Point = std::array<double, 3>;

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Three points are collinear if all 3x3 minors of their homogeneous coordinates vanish.
bool exactly_collinear(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const mpz_class bc = b.numerator[k] * c.numerator[i] - b.numerator[i] * c.numerator[k];
    const mpz_class ca = c.numerator[k] * a.numerator[i] - c.numerator[i] * a.numerator[k];
    const mpz_class ab = a.numerator[k] * b.numerator[i] - a.numerator[i] * b.numerator[k];
    if (a.denominator * bc + b.denominator * ca + c.denominator * ab != 0) return false;
  }
  return true;
}

class EarClipping {
 public:
  EarClipping(const ShadingMesh& mesh, const MeshFace& face)
      : mesh_(mesh), loop_(mesh.loop(face)) {}

  std::vector<std::array<std::uint32_t, 3>> run() {
    std::vector<std::uint32_t> left(loop_.size());
    for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
    std::vector<double> quality(left.size());
    for (std::size_t i = 0; i < left.size(); ++i) quality[i] = quality_at(left, i);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    while (left.size() > 3) {
      std::size_t best = left.size();
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (quality[i] <= 0 || (best < left.size() && quality[i] <= quality[best])) continue;
        if (leaves_area(left, i)) best = i;
      }
      if (best == left.size()) break;  // the face has no area: no face of a mesh
      triangles.push_back(corner(left, best));
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
      quality.erase(quality.begin() + static_cast<std::ptrdiff_t>(best));
      const std::size_t n = left.size();
      for (const std::size_t i : {(best + n - 1) % n, best % n}) quality[i] = quality_at(left, i);
    }
    if (left.size() == 3) triangles.push_back({left[0], left[1], left[2]});
    return triangles;
  }

 private:
  std::array<std::uint32_t, 3> corner(const std::vector<std::uint32_t>& left, std::size_t i) const {
    const std::size_t n = left.size();
    return {left[(i + n - 1) % n], left[i], left[(i + 1) % n]};
  }
  const Point& at(std::uint32_t i) const { return mesh_.points[loop_[i].vertex]; }

  bool collinear(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    // Nearest doubles err by u |x| each: differences by 3u size, the cross product by less than
    // 32u size^2, which decides unless it is near zero.
    double size = 0;
    for (const std::uint32_t i : {a, b, c}) {
      for (const double x : at(i)) size = std::max(size, std::fabs(x));
    }
    const Point n = cross(difference(at(b), at(a)), difference(at(c), at(a)));
    const double largest = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
    if (largest > 0x1p-48 * size * size && size > 0x1p-400 && std::isfinite(largest)) return false;
    return exactly_collinear(mesh_.exact_points[loop_[a].vertex],
                             mesh_.exact_points[loop_[b].vertex],
                             mesh_.exact_points[loop_[c].vertex]);
  }

  /// Area over the square of the longest side: 0 for a corner between collinear edges, else
  /// positive, however small it comes out.
  double quality_at(const std::vector<std::uint32_t>& left, std::size_t i) const {
    const auto [a, b, c] = corner(left, i);
    if (collinear(a, b, c)) return 0;
    const Point ab = difference(at(b), at(a)), bc = difference(at(c), at(b));
    const Point ca = difference(at(a), at(c));
    const Point n = cross(ab, bc);
    const double longest = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
    const double quality = std::sqrt(dot(n, n)) / longest;
    return quality > 0 ? quality : 0x1p-1000;
  }

  /// What is left of a convex loop without corner i has no area only if all of it lies on the line
  /// from the corner before to the corner after.
  bool leaves_area(const std::vector<std::uint32_t>& left, std::size_t i) const {
    const auto [a, b, c] = corner(left, i);
    for (const std::uint32_t other : left) {
      if (other != a && other != b && other != c && !collinear(a, c, other)) return true;
    }
    return false;
  }

  const ShadingMesh& mesh_;
  std::span<const MeshCorner> loop_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const ShadingMesh& mesh,
                                                      const MeshFace& face) {
  return EarClipping(mesh, face).run();
}

}  // namespace gnomon
