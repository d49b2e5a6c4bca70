// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/visible_pieces.h"

#include <algorithm>
#include <utility>

namespace gnomon {

LightPieces::LightPieces(const LightView& view) : view_(view) {
  const std::uint32_t n = view.corners();
  Piece light;
  for (std::uint32_t i = 0; i < n; ++i) {
    Line line;
    line.near = view.near_edge_line(i);
    line.index = i;
    lines_.push_back(std::move(line));
    Vertex vertex;
    vertex.near = view.near_corner(i);
    vertex.exact = view.corner(i);
    vertex.has_exact = true;
    vertex.known = 2;
    vertex.on = {(i + n - 1) % n, i, 0, 0};
    vertices_.push_back(std::move(vertex));
    light.vertices.push_back(i);
    light.lines.emplace_back(i);
  }
  pieces_.push_back(std::move(light));
}

std::uint32_t LightPieces::add_apex(Apex apex) {
  apexes_.push_back(std::move(apex));
  return static_cast<std::uint32_t>(apexes_.size() - 1);
}

PlaneRef LightPieces::line_of_plane(PlaneId plane) {
  const auto [found, is_new] =
      line_numbers_.try_emplace(std::uint64_t{plane}, static_cast<std::uint32_t>(lines_.size()));
  if (is_new) {
    Line line;
    line.source = Source::kPlane;
    line.index = plane;
    const VertexId a = view_.scene().geometry.planes[plane].a;
    line.near =
        view_.line_of(view_.normal(plane), difference_of(view_.origin_pairs(), view_.pairs(a), 1));
    lines_.push_back(std::move(line));
  }
  return PlaneRef(found->second);
}

PlaneRef LightPieces::line_of_edge(EdgeId edge, std::uint32_t apex) {
  const auto [found, is_new] =
      line_numbers_.try_emplace(std::uint64_t{edge} | std::uint64_t{apex + 1} << 32,
                                static_cast<std::uint32_t>(lines_.size()));
  if (is_new) {
    Line line;
    line.source = Source::kEdge;
    line.index = edge;
    line.apex = apex;
    const VertexId a = view_.scene().geometry.edges[edge].a;
    line.near = view_.line_of(view_.edge_normal(edge, apexes_[apex]),
                              difference_of(view_.origin_pairs(), view_.pairs(a), 1));
    lines_.push_back(std::move(line));
  }
  return PlaneRef(found->second);
}

bool LightPieces::is_on_edge(EdgeId edge, std::uint32_t apex) const {
  for (const Ball& c : view_.edge_normal(edge, apexes_[apex])) {
    if (certain_sign(c) != Sign::kZero) return false;
  }
  const ExactVector normal = view_.exact_edge_plane(edge, apexes_[apex]).normal;
  return sgn(normal[0]) == 0 && sgn(normal[1]) == 0 && sgn(normal[2]) == 0;
}

const ExactVector& LightPieces::exact_line(std::uint32_t index) {
  Line& line = lines_[index];
  if (!line.has_exact) {
    switch (line.source) {
      case Source::kLightEdge:
        line.exact = view_.edge_line(line.index);
        break;
      case Source::kPlane:
        line.exact = view_.line_of(view_.exact_plane(line.index));
        break;
      case Source::kEdge:
        line.exact = view_.line_of(view_.exact_edge_plane(line.index, apexes_[line.apex]));
        break;
    }
    line.has_exact = true;
  }
  return line.exact;
}

const ExactVector& LightPieces::exact(std::uint32_t index) {
  Vertex& vertex = vertices_[index];
  if (!vertex.has_exact) {
    vertex.exact = cross(exact_line(vertex.on[0]), exact_line(vertex.on[1]));
    if (sgn(vertex.exact[2]) < 0) {
      for (mpz_class& c : vertex.exact) c = -c;
    }
    vertex.has_exact = true;
  }
  return vertex.exact;
}

Sign LightPieces::sign(PlaneRef ref, std::uint32_t index, Ball& value) {
  ++counts.all;
  Vertex& vertex = vertices_[index];
  for (std::uint32_t i = 0; i < vertex.known; ++i) {
    if (vertex.on[i] == ref.index()) {
      value = Ball();
      return Sign::kZero;
    }
  }
  const std::array<Ball, 3>& line = lines_[ref.index()].near;
  value = line[0] * vertex.near[0] + line[1] * vertex.near[1] + line[2];
  if (ref.flipped()) value = -value;
  Sign result = certain_sign(value);
  if (result != Sign::kZero) return result;
  ++counts.exact;
  result = sign_of(mpz_class(dot(exact_line(ref.index()), exact(index))));
  if (result == Sign::kZero && vertex.known < Vertex::kMost) {
    vertex.on[vertex.known++] = ref.index();
  }
  return ref.flipped() ? -result : result;
}

std::uint32_t LightPieces::crossing(PlaneRef edge, PlaneRef line, std::uint32_t from,
                                    const Ball& from_value, std::uint32_t to,
                                    const Ball& to_value) {
  Vertex vertex;
  vertex.known = 2;
  vertex.on = {edge.index(), line.index(), 0, 0};
  const Ball t = from_value / (from_value - to_value);
  const std::array<Ball, 2>& a = vertices_[from].near;
  const std::array<Ball, 2>& b = vertices_[to].near;
  for (std::size_t k = 0; k < 2; ++k) vertex.near[k] = a[k] + t * (b[k] - a[k]);
  vertices_.push_back(std::move(vertex));
  const auto index = static_cast<std::uint32_t>(vertices_.size() - 1);
  const Vertex& made = vertices_.back();
  if (!(made.near[0].radius < kCoarse) || !(made.near[1].radius < kCoarse)) {
    enclose_exactly(index);
  }
  return index;
}

void LightPieces::enclose_exactly(std::uint32_t index) {
  const ExactVector& point = exact(index);
  for (std::size_t k = 0; k < 2; ++k) {
    vertices_[index].near[k] = rounded_ball(pair_of(point[k], point[2], 0).high);
  }
}

void LightPieces::refine() {
  for (const Piece& piece : pieces_) {
    for (const std::uint32_t vertex : piece.vertices) enclose_exactly(vertex);
  }
}

void LightPieces::classify(PlaneRef line, const Piece& piece, Classified& result) {
  const std::size_t n = piece.vertices.size();
  result.signs.resize(n);
  result.values.resize(n);
  result.front = result.back = false;
  for (std::size_t i = 0; i < n; ++i) {
    result.signs[i] = sign(line, piece.vertices[i], result.values[i]);
    result.front |= result.signs[i] == Sign::kPositive;
    result.back |= result.signs[i] == Sign::kNegative;
  }
}

void LightPieces::split(const Piece& piece, PlaneRef line, const Classified& sides, Piece& front,
                        Piece& back) {
  const std::size_t n = piece.vertices.size();
  const auto add = [](Piece& to, std::uint32_t vertex, PlaneRef edge) {
    to.vertices.push_back(vertex);
    to.lines.push_back(edge);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = i + 1 == n ? 0 : i + 1;
    const std::uint32_t vertex = piece.vertices[i];
    const PlaneRef edge = piece.lines[i];
    const Sign here = sides.signs[i], next = sides.signs[j];
    // An edge that leaves a half is followed there by the cut.
    switch (here) {
      case Sign::kPositive:
        add(front, vertex, edge);
        break;
      case Sign::kNegative:
        add(back, vertex, edge);
        break;
      case Sign::kZero:
        add(front, vertex, next == Sign::kNegative ? line : edge);
        add(back, vertex, next == Sign::kPositive ? -line : edge);
        break;
    }
    if (here * next == Sign::kNegative) {
      const std::uint32_t made =
          crossing(edge, line, vertex, sides.values[i], piece.vertices[j], sides.values[j]);
      add(front, made, here == Sign::kPositive ? line : edge);
      add(back, made, here == Sign::kPositive ? edge : -line);
    }
  }
}

bool LightPieces::is_apart(const Piece& piece, std::span<const PlaneRef> region) {
  for (const PlaneRef line : region) {
    classify(line, piece, sides_);
    if (!sides_.front) return true;
  }
  return false;
}

void LightPieces::clip(PlaneRef line) {
  std::vector<Piece> kept;
  for (Piece& piece : pieces_) {
    classify(line, piece, sides_);
    if (!sides_.front) continue;
    if (!sides_.back) {
      kept.push_back(std::move(piece));
      continue;
    }
    Piece front, back;
    split(piece, line, sides_, front, back);
    kept.push_back(std::move(front));
  }
  pieces_ = std::move(kept);
}

void LightPieces::subtract(std::span<const PlaneRef> region) {
  std::vector<Piece> kept, outside;
  std::vector<PlaneRef> cutting;
  for (Piece& piece : pieces_) {
    cutting.clear();
    bool apart = false;
    for (const PlaneRef line : region) {
      classify(line, piece, sides_);
      if (!sides_.front) {
        apart = true;
        break;
      }
      if (sides_.back) cutting.push_back(line);
    }
    outside.clear();
    Piece inside;
    if (!apart) {
      inside = piece;
      for (const PlaneRef line : cutting) {
        classify(line, inside, sides_);
        if (!sides_.front) {
          apart = true;
          break;
        }
        if (!sides_.back) continue;
        Piece front, back;
        split(inside, line, sides_, front, back);
        outside.push_back(std::move(back));
        inside = std::move(front);
      }
    }
    if (apart) {
      kept.push_back(std::move(piece));
    } else {
      std::move(outside.begin(), outside.end(), std::back_inserter(kept));
    }
  }
  pieces_ = std::move(kept);
}

mpq_class LightPieces::twice_area(const Piece& piece) {
  std::vector<std::array<mpq_class, 2>> points;
  for (const std::uint32_t vertex : piece.vertices) {
    const ExactVector& point = exact(vertex);
    std::array<mpq_class, 2> affine{mpq_class(point[0], point[2]), mpq_class(point[1], point[2])};
    for (mpq_class& c : affine) c.canonicalize();
    points.push_back(std::move(affine));
  }
  mpq_class sum;
  for (std::size_t i = 2; i < points.size(); ++i) {
    sum += (points[i - 1][0] - points[0][0]) * (points[i][1] - points[0][1]) -
           (points[i - 1][1] - points[0][1]) * (points[i][0] - points[0][0]);
  }
  return sum;
}

namespace {

/// The apex's side of a plane, or that of the limit towards it.
Sign side_towards(LightPieces& pieces, const LightView& view, PlaneId plane, std::uint32_t apex,
                  const std::uint32_t* inwards) {
  const Sign sign = view.side_of(plane, pieces.apex(apex), pieces.counts);
  if (sign != Sign::kZero || inwards == nullptr) return sign;
  return view.side_of(plane, pieces.apex(*inwards), pieces.counts);
}

}  // namespace

std::vector<PlaneRef> shadow_of(LightPieces& pieces, const LightView& view,
                                const LightView::Caster& caster, std::uint32_t apex,
                                const std::uint32_t* inwards) {
  const Part& part = view.scene().parts[caster.part];
  Sign at_apex = view.side_of(part.plane, pieces.apex(apex), pieces.counts);
  const bool touches = at_apex == Sign::kZero;
  if (touches) at_apex = side_towards(pieces, view, part.plane, apex, inwards);
  if (part.flipped) at_apex = -at_apex;
  if (at_apex == Sign::kZero) return {};
  // The side that looks away from the point is the one that stops the light.
  const bool front = at_apex == Sign::kNegative;
  if (front ? !caster.front : !caster.back) return {};

  std::vector<PlaneRef> region;
  for (const PlaneRef edge : view.scene().edges(part)) {
    std::uint32_t from = apex;
    if (touches && pieces.is_on_edge(edge.index(), apex)) from = *inwards;
    const PlaneRef line = pieces.line_of_edge(edge.index(), from);
    region.push_back(edge.flipped() == front ? -line : line);
  }
  if (caster.cuts) {
    const PlaneRef line = pieces.line_of_plane(part.plane);
    region.push_back(part.flipped == front ? -line : line);
  }
  return region;
}

bool clip_to_receiver(LightPieces& pieces, const LightView& view, const Part& part, Side side,
                      std::uint32_t apex) {
  // Points in the light's plane get nothing from it: towards them the cosine at the light goes to
  // 0.
  if (view.side_of_light(pieces.apex(apex), pieces.counts) != Sign::kPositive) return false;
  const PlaneRef line = pieces.line_of_plane(part.plane);
  pieces.clip(part.flipped == (side == Side::kFront) ? -line : line);
  return !pieces.empty();
}

std::uint64_t subtract_casters(LightPieces& pieces, const LightView& view, const Part& part,
                               Side side, std::uint32_t apex, const std::uint32_t* inwards) {
  std::vector<std::uint32_t> casters;
  view.find_casters(pieces.apex(apex), part.plane, part.flipped == (side == Side::kFront), casters);
  std::uint64_t asked = 0;
  for (const std::uint32_t caster : casters) {
    if (pieces.empty()) break;
    ++asked;
    const std::vector<PlaneRef> region =
        shadow_of(pieces, view, view.casters()[caster], apex, inwards);
    if (!region.empty()) pieces.subtract(region);
  }
  return asked;
}

}  // namespace gnomon
