// SPDX-License-Identifier: LGPL-3.0-or-later
// Decisions in words, and where they are.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "gnomon/algorithms/explain.h"
#include "kernel/signs/corner.h"

namespace gnomon {
namespace {

using Kind = PlaneName::Kind;

const char* name(Side side) {
  switch (side) {
    case Side::kFront:
      return "in front";
    case Side::kBack:
      return "behind";
    case Side::kOn:
      return "on it";
  }
  return "?";
}

std::string text(const std::array<double, 3>& point) {
  std::string result = "(";
  for (int k = 0; k < 3; ++k) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), point[k]).ptr;
    result.append(buffer.data(), end);
    result += k < 2 ? ", " : ")";
  }
  return result;
}

std::string point_in_words(std::uint32_t vertex) {
  return vertex == kMadeVertex ? "a made point" : "input vertex " + std::to_string(vertex);
}

std::string in_words(const PlaneName& plane, const Geometry& geometry) {
  switch (plane.kind) {
    case Kind::kSupport:
      return "support plane " + std::to_string(plane.of[0]);
    case Kind::kEdge: {
      const EdgeEnds ends = geometry.edges[plane.of[0]];
      return "the shadow plane of edge " + std::to_string(ends.a) + "-" + std::to_string(ends.b);
    }
    case Kind::kCut:
      return "a plane through the light along a cut";
    case Kind::kThrough:
      return "the plane through " + point_in_words(plane.of[0]) + ", " +
             point_in_words(plane.of[1]) + " and " + point_in_words(plane.of[2]);
    case Kind::kBorder:
    case Kind::kNone:
      break;
  }
  return "a border between cells";
}

std::string vertex_in_words(const DifferingDecision& decision, const Geometry& geometry) {
  const CornerName& corner = decision.corner;
  if (decision.predicate == Predicate::kFacing) return "the light";
  if (corner.source != kMadeVertex) return point_in_words(corner.source);
  std::string words = "a vertex made by splitting";
  // In the scene BSP edges are names of edges alone.
  if (decision.predicate == Predicate::kSceneBsp) return words;
  return words + ", where " + in_words(corner.before, geometry) + " meets " +
         in_words(corner.after, geometry);
}

/// How far a point in the plane of a part is outside of it; negative inside. Seen along the
/// largest component of the normal.
double outside(const PreparedScene& scene, const Part& part, const std::array<double, 3>& point) {
  const auto loop = scene.loop(part);
  const auto at = [&](std::size_t i) { return scene.geometry.positions[loop[i]]; };
  std::array<double, 3> normal{};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = at(i), b = at((i + 1) % loop.size()), c = at(0);
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      normal[k] += (a[u] - c[u]) * (b[v] - c[v]) - (a[v] - c[v]) * (b[u] - c[u]);
    }
  }
  const auto larger = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  const auto largest = std::max_element(normal.begin(), normal.end(), larger);
  const auto z = static_cast<std::size_t>(largest - normal.begin());
  const std::size_t u = (z + 1) % 3, v = (z + 2) % 3;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = at(i), b = at((i + 1) % loop.size());
    const double du = b[u] - a[u], dv = b[v] - a[v];
    const double left = du * (point[v] - a[v]) - dv * (point[u] - a[u]);
    most = std::max(most, (*largest > 0 ? -left : left) / std::hypot(du, dv));
  }
  return most;
}

}  // namespace

std::optional<std::uint32_t> part_of(const DifferingDecision& decision,
                                     const PreparedScene& scene) {
  const CornerName& corner = decision.corner;
  if (corner.support == CornerName::kNoSupport) return std::nullopt;
  std::optional<std::uint32_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    const Part& part = scene.parts[i];
    if (part.plane != corner.support) continue;
    if (decision.predicate == Predicate::kFacing) return i;  // one of those in the plane
    const bool is_own =
        corner.source != kMadeVertex &&
        std::ranges::find(scene.loop(part), corner.source) != scene.loop(part).end();
    if (is_own) return i;
    const double by = outside(scene, part, decision.position);
    if (by < least || !nearest) {
      least = by;
      nearest = i;
    }
  }
  return nearest;
}

std::string to_sentence(const DifferingDecision& decision, const PreparedScene& scene,
                        const std::string& kernel, const std::vector<std::string>& light_names) {
  const Geometry& geometry = scene.geometry;
  const bool has_point =
      decision.predicate != Predicate::kFacing && decision.predicate != Predicate::kThreePoints;
  std::string where = "building the scene BSP";
  if (decision.light) where = "light " + light_names[scene.lights[*decision.light].light];
  std::string sentence =
      "Decision " + std::to_string(decision.decisions + 1) + " (" + where + "): ";
  if (decision.predicate == Predicate::kThreePoints) {
    const bool tested = decision.tested == Side::kFront;
    return sentence + "whether there is " + in_words(decision.plane, geometry) + ". " + kernel +
           (tested ? " finds one, exactly they are on a line."
                   : " finds them on a line, exactly they are not.");
  }
  sentence += vertex_in_words(decision, geometry);
  if (has_point) sentence += ", at " + text(decision.position) + ",";
  sentence += " is asked against " + in_words(decision.plane, geometry) +
              (decision.predicate == Predicate::kSceneBsp ? " of the scene BSP" : "") + ". " +
              kernel + " says " + name(decision.tested) + ", exact says " + name(decision.exact) +
              ".";
  if (has_point && decision.tested_position != decision.position) {
    sentence += " " + kernel + " has the vertex at " + text(decision.tested_position) + ".";
  }
  return sentence;
}

}  // namespace gnomon
