// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gnomon::oracle {

namespace {

constexpr int kApproximationBits = 52;
constexpr double kUnitRoundoff = 0x1p-53;

bool is_zero(const Winding& winding) {
  return std::all_of(winding.begin(), winding.end(), [](std::int32_t w) { return w == 0; });
}

long size_in_bits(const mpz_class& value) {
  return value == 0 ? 0 : static_cast<long>(mpz_sizeinbase(value.get_mpz_t(), 2));
}

// floor(numerator 2^shift / denominator)
void scaled_quotient(mpz_class& result, const mpz_class& numerator, const mpz_class& denominator,
                     long shift) {
  if (shift >= 0) {
    mpz_mul_2exp(result.get_mpz_t(), numerator.get_mpz_t(), static_cast<mp_bitcnt_t>(shift));
    mpz_fdiv_q(result.get_mpz_t(), result.get_mpz_t(), denominator.get_mpz_t());
  } else {
    mpz_fdiv_q(result.get_mpz_t(), numerator.get_mpz_t(), denominator.get_mpz_t());
    mpz_fdiv_q_2exp(result.get_mpz_t(), result.get_mpz_t(), static_cast<mp_bitcnt_t>(-shift));
  }
}

double to_double(const mpz_class& value) {
  return size_in_bits(value) > 1000 ? std::numeric_limits<double>::infinity() * sgn(value)
                                    : value.get_d();
}

mpq_class unreduced_tree_sum(std::vector<mpq_class> terms) {
  // Neighbours are added first, so that operands stay of similar size.
  if (terms.empty()) return 0;
  while (terms.size() > 1) {
    std::size_t out = 0;
    for (std::size_t i = 0; i < terms.size(); i += 2) {
      if (i + 1 < terms.size()) terms[i] += terms[i + 1];
      if (out != i) terms[out].swap(terms[i]);
      ++out;
    }
    terms.resize(out);
  }
  return terms[0];
}

/// Sums of zero are not kept.
void add_mark(Overlay::MarkWindings& marks, std::uint32_t mark, int weight) {
  const auto place = std::ranges::find(marks, mark, &Overlay::MarkWinding::mark);
  if (place == marks.end()) {
    marks.push_back({mark, weight});
  } else if (place->winding += weight; place->winding == 0) {
    *place = marks.back();
    marks.pop_back();
  }
}

}  // namespace

bool Overlay::Segment::vanishes() const { return is_zero(delta) && marks.empty(); }

std::size_t Overlay::PointHash::operator()(std::uint32_t vertex) const {
  const ChartPoint& p = (*points)[vertex];
  std::uint64_t hash = mpz_get_ui(p.x.get_mpz_t()) * 0x9e3779b97f4a7c15ull;
  hash = (hash ^ (hash >> 29)) + mpz_get_ui(p.y.get_mpz_t()) * 0xbf58476d1ce4e5b9ull;
  hash = (hash ^ (hash >> 31)) + mpz_get_ui(p.w.get_mpz_t()) * 0x94d049bb133111ebull;
  return hash ^ (hash >> 30);
}

std::uint32_t Overlay::intern(const ChartPoint& point) {
  points_.push_back(point);
  const auto id = static_cast<std::uint32_t>(points_.size() - 1);
  const auto [place, inserted] = ids_.try_emplace(id, id);
  if (!inserted) points_.pop_back();
  return place->second;
}

void Overlay::add_edge(const ChartPoint& a, const ChartPoint& b, Layer layer, int weight,
                       std::uint32_t mark) {
  std::uint32_t from = intern(a), to = intern(b);
  if (from == to) return;
  if (compare(points_[from], points_[to]) > 0) {
    std::swap(from, to);
    weight = -weight;
  }
  const std::uint64_t key = (std::uint64_t{from} << 32) | to;
  const auto [place, inserted] =
      segment_ids_.try_emplace(key, static_cast<std::uint32_t>(segments_.size()));
  if (inserted) segments_.push_back(Segment{from, to});
  Segment& segment = segments_[place->second];
  segment.delta[layer] += weight;
  if (mark != kNone) add_mark(segment.marks, mark, weight);
  segment.candidate = segment.candidate || (layer >= kLit && layer <= kUmbra);
}

void Overlay::add_loop(const std::vector<ChartPoint>& loop, Layer layer, int weight) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    add_edge(loop[i], loop[(i + 1) % loop.size()], layer, weight);
  }
}

void Overlay::set_scale() {
  if (points_.empty()) return;
  const ChartPoint* low_x = &points_[0];
  const ChartPoint* high_x = low_x;
  const ChartPoint* low_y = low_x;
  const ChartPoint* high_y = low_x;
  for (const ChartPoint& point : points_) {
    if (compare_x(point, *low_x) < 0) low_x = &point;
    if (compare_x(point, *high_x) > 0) high_x = &point;
    if (compare_y(point, *low_y) < 0) low_y = &point;
    if (compare_y(point, *high_y) > 0) high_y = &point;
  }
  const auto difference = [](const mpz_class& a, const mpz_class& v, const mpz_class& b,
                             const mpz_class& w) {
    mpq_class result(a * w - b * v, v * w);
    result.canonicalize();
    return result;
  };
  mpq_class width = difference(high_x->x, high_x->w, low_x->x, low_x->w);
  const mpq_class height = difference(high_y->y, high_y->w, low_y->y, low_y->w);
  if (height > width) width = height;
  const long bits = size_in_bits(width.get_num()) - size_in_bits(width.get_den());
  scale_ = kApproximationBits - bits;
  mpz_class x, y;
  scaled_quotient(x, low_x->x, low_x->w, scale_);
  scaled_quotient(y, low_y->y, low_y->w, scale_);
  corner_ = {x, y, 1};
}

void Overlay::fixed(const ChartPoint& point, int bits, mpz_class& x, mpz_class& y) const {
  // floor(coordinate 2^(scale + bits)) - corner 2^bits: off by less than one unit.
  scaled_quotient(x, point.x, point.w, scale_ + bits);
  scaled_quotient(y, point.y, point.w, scale_ + bits);
  x -= corner_.x << bits;
  y -= corner_.y << bits;
}

Overlay::FixedPoint Overlay::fixed(const ChartPoint& point) const {
  FixedPoint result;
  fixed(point, kFixedBits, result.x, result.y);
  return result;
}

const Overlay::FixedPoint& Overlay::fixed(std::uint32_t vertex) const {
  if (fixed_.size() < points_.size()) fixed_.resize(points_.size());
  std::optional<FixedPoint>& known = fixed_[vertex];
  if (!known) known = fixed(points_[vertex]);
  return *known;
}

long double Overlay::box_unit() const {
  return std::ldexp(1.0L, static_cast<int>(std::clamp(-scale_, -16000L, 16000L)));
}

Overlay::Approximation Overlay::approximation_of(const ChartPoint& point) const {
  mpz_class x, y;
  fixed(point, 12, x, y);
  return {std::ldexp(to_double(x), -12), std::ldexp(to_double(y), -12)};
}

void Overlay::approximate() {
  const std::size_t known = approximations_.size();
  approximations_.resize(points_.size());
  for (std::size_t i = known; i < points_.size(); ++i) {
    approximations_[i] = approximation_of(points_[i]);
    const double largest =
        std::max(std::fabs(approximations_[i].x), std::fabs(approximations_[i].y));
    // One unit of 2^-12 from the floor, one conversion that truncates to 53 bits.
    error_ = std::max(error_, 0x1p-12 + 2 * kUnitRoundoff * largest);
  }
}

int Overlay::orient(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  if (a == b || b == c || a == c) return 0;
  const Approximation &p = approximations_[a], &q = approximations_[b], &r = approximations_[c];
  const double qx = q.x - p.x, qy = q.y - p.y, rx = r.x - p.x, ry = r.y - p.y;
  const double value = qx * ry - qy * rx;
  // Each difference is off by 2 error_ (+ rounding, which 4 error_ covers); each product by the sum
  // of factors times that, and by rounding.
  const double sum = std::fabs(qx) + std::fabs(qy) + std::fabs(rx) + std::fabs(ry);
  const double bound = 4 * error_ * sum + 32 * error_ * error_ +
                       4 * kUnitRoundoff * (std::fabs(qx * ry) + std::fabs(qy * rx));
  if (value > 1.001 * bound) return 1;
  if (value < -1.001 * bound) return -1;
  return orientation(points_[a], points_[b], points_[c]);
}

int Overlay::order(std::uint32_t a, std::uint32_t b) const {
  if (a == b) return 0;
  const double difference = approximations_[a].x - approximations_[b].x;
  if (difference > 4 * error_) return 1;
  if (difference < -4 * error_) return -1;
  return compare(points_[a], points_[b]);
}

int Overlay::order_along(int u, int v, std::uint32_t a, std::uint32_t b) const {
  if (a == b) return 0;
  const Approximation &p = approximations_[a], &q = approximations_[b];
  const double x = u * (p.x - q.x), y = v * (p.y - q.y);
  // As in order(), for each coordinate, and three roundings.
  const double bound =
      4 * error_ * (std::abs(u) + std::abs(v)) + 4 * kUnitRoundoff * (std::fabs(x) + std::fabs(y));
  if (x + y > bound) return 1;
  if (x + y < -bound) return -1;
  const ChartPoint &r = points_[a], &s = points_[b];
  return sgn(mpz_class((u * r.x + v * r.y) * s.w - (u * s.x + v * s.y) * r.w));
}

bool Overlay::strictly_within(std::uint32_t vertex, const Segment& segment) const {
  return order(segment.a, vertex) < 0 && order(vertex, segment.b) < 0;
}

const ChartLine& Overlay::line_of(std::size_t segment) {
  if (!has_line_[segment]) {
    lines_[segment] = line_through(points_[segments_[segment].a], points_[segments_[segment].b]);
    has_line_[segment] = true;
  }
  return lines_[segment];
}

void Overlay::intersect(std::size_t s, std::size_t t,
                        std::vector<std::vector<std::uint32_t>>& splits) {
  const Segment &first = segments_[s], &second = segments_[t];
  // A segment whose windings cancel is no edge; it counts for T-vertices only.
  const bool edges = !first.vanishes() && !second.vanishes();
  if (!edges && !(first.candidate && second.candidate)) return;
  const int a = orient(first.a, first.b, second.a);
  const int b = orient(first.a, first.b, second.b);
  if (a * b > 0) return;
  const int c = orient(second.a, second.b, first.a);
  const int d = orient(second.a, second.b, first.b);
  if (c * d > 0) return;
  if (a * b < 0 && c * d < 0) {
    if (!edges) return;
    const std::uint32_t crossing = intern(meet(line_of(s), line_of(t)));
    approximate();
    splits[s].push_back(crossing);
    splits[t].push_back(crossing);
    return;
  }
  const auto touch = [&](std::uint32_t vertex, std::size_t segment, bool other_is_candidate) {
    if (!strictly_within(vertex, segments_[segment])) return;
    // A vertex of what is no edge splits nothing: edges of other layers on the same line, which do
    // not look for T-vertices, would not be split there.
    if (edges) splits[segment].push_back(vertex);
    if (segments_[segment].candidate && other_is_candidate) is_t_vertex_[vertex] = true;
  };
  if (a == 0) touch(second.a, s, second.candidate);
  if (b == 0) touch(second.b, s, second.candidate);
  if (c == 0) touch(first.a, t, first.candidate);
  if (d == 0) touch(first.b, t, first.candidate);
}

void Overlay::find_intersections(std::vector<std::vector<std::uint32_t>>& splits) {
  struct Box {
    double low_x, high_x, low_y, high_y;
    std::uint32_t segment;
  };
  std::vector<Box> boxes;
  boxes.reserve(segments_.size());
  for (std::size_t s = 0; s < segments_.size(); ++s) {
    const Approximation &p = approximations_[segments_[s].a], &q = approximations_[segments_[s].b];
    const double pad = 2 * error_;
    boxes.push_back({std::min(p.x, q.x) - pad, std::max(p.x, q.x) + pad, std::min(p.y, q.y) - pad,
                     std::max(p.y, q.y) + pad, static_cast<std::uint32_t>(s)});
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& p, const Box& q) { return p.low_x < q.low_x; });
  std::vector<Box> active;
  for (const Box& box : boxes) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (active[i].high_x < box.low_x) continue;
      if (kept != i) active[kept] = active[i];
      ++kept;
    }
    active.resize(kept);
    for (const Box& other : active) {
      if (other.high_y < box.low_y || other.low_y > box.high_y) continue;
      intersect(other.segment, box.segment, splits);
    }
    active.push_back(box);
  }
}

void Overlay::split_segments(const std::vector<std::vector<std::uint32_t>>& splits) {
  std::unordered_map<std::uint64_t, std::uint32_t> edge_ids;
  edge_ids.reserve(segments_.size() * 2);
  std::vector<Segment> pieces;
  std::vector<std::uint32_t> chain;
  for (std::size_t s = 0; s < segments_.size(); ++s) {
    const Segment& segment = segments_[s];
    if (segment.vanishes()) continue;
    chain.assign(1, segment.a);
    chain.insert(chain.end(), splits[s].begin(), splits[s].end());
    chain.push_back(segment.b);
    std::sort(chain.begin() + 1, chain.end() - 1,
              [this](std::uint32_t p, std::uint32_t q) { return order(p, q) < 0; });
    chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::uint64_t key = (std::uint64_t{chain[i]} << 32) | chain[i + 1];
      const auto [place, inserted] =
          edge_ids.try_emplace(key, static_cast<std::uint32_t>(pieces.size()));
      if (inserted) pieces.push_back(Segment{chain[i], chain[i + 1]});
      Segment& piece = pieces[place->second];
      for (int layer = 0; layer < kLayers; ++layer) piece.delta[layer] += segment.delta[layer];
      for (const auto& [mark, weight] : segment.marks) add_mark(piece.marks, mark, weight);
    }
  }
  edges_.clear();
  for (const Segment& piece : pieces) {
    if (!piece.vanishes()) edges_.push_back(piece);
  }
}

void Overlay::link() {
  halfedges_.assign(2 * edges_.size(), {});
  outgoing_.assign(points_.size(), {});
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto forward = static_cast<std::uint32_t>(2 * e);
    halfedges_[forward].origin = edges_[e].a;
    halfedges_[forward + 1].origin = edges_[e].b;
    outgoing_[edges_[e].a].push_back(forward);
    outgoing_[edges_[e].b].push_back(forward + 1);
  }
  for (std::size_t v = 0; v < outgoing_.size(); ++v) {
    std::vector<std::uint32_t>& around = outgoing_[v];
    const auto vertex = static_cast<std::uint32_t>(v);
    // Even halfedges go to a later point in the order x, y: their angles are in (-90, 90] degrees.
    // They come first, each half by orientation.
    std::sort(around.begin(), around.end(), [&](std::uint32_t p, std::uint32_t q) {
      if ((p & 1u) != (q & 1u)) return (p & 1u) < (q & 1u);
      return p != q && orient(vertex, target(p), target(q)) > 0;
    });
    for (std::size_t i = 0; i < around.size(); ++i) {
      // Coming in along the twin of around[i], turn to the next outgoing one clockwise.
      const std::size_t clockwise = (i + around.size() - 1) % around.size();
      halfedges_[twin(around[i])].next = around[clockwise];
    }
  }
}

std::uint32_t Overlay::halfedge_below(std::uint32_t vertex, std::uint32_t component,
                                      const std::vector<std::uint32_t>& component_of) const {
  std::uint32_t best = kNone;
  const double x = approximations_[vertex].x;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Segment& edge = edges_[e];
    // Half-open in x, as if the ray down were tilted to the right by nothing.
    if (approximations_[edge.a].x > x + 4 * error_ || approximations_[edge.b].x < x - 4 * error_) {
      continue;
    }
    if (component_of[edge.a] == component) continue;
    if (compare_x(points_[edge.a], points_[vertex]) > 0) continue;
    if (compare_x(points_[edge.b], points_[vertex]) <= 0) continue;
    if (orient(edge.a, edge.b, vertex) <= 0) continue;
    if (best != kNone) {
      const Segment& other = edges_[best];
      // Edges do not cross: the higher one is decided at whichever of their ends both span.
      int higher = 0;  // of `edge` against `other`
      if (edge.a == other.a) {
        higher = orient(other.a, other.b, edge.b);
      } else if (order(edge.a, other.a) > 0) {
        higher = orient(other.a, other.b, edge.a);
        if (higher == 0) higher = orient(other.a, other.b, edge.b);
      } else {
        higher = -orient(edge.a, edge.b, other.a);
        if (higher == 0) higher = -orient(edge.a, edge.b, other.b);
      }
      if (higher <= 0) continue;
    }
    best = static_cast<std::uint32_t>(e);
  }
  return best == kNone ? kNone : 2 * best;
}

void Overlay::trace_faces() {
  // Components by union-find, each with its first vertex in the order x, y.
  std::vector<std::uint32_t> parent(points_.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Segment& edge : edges_) parent[find(edge.a)] = find(edge.b);
  std::vector<std::uint32_t> component_of(points_.size()), first(points_.size(), kNone);
  std::vector<std::uint32_t> components;
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    component_of[v] = find(v);
    if (outgoing_[v].empty()) continue;
    std::uint32_t& lowest = first[component_of[v]];
    if (lowest == kNone) components.push_back(component_of[v]);
    if (lowest == kNone || order(v, lowest) < 0) lowest = v;
  }

  std::vector<std::uint32_t> cycle_of(halfedges_.size(), kNone);
  std::vector<std::uint32_t> cycles;
  for (std::uint32_t h = 0; h < halfedges_.size(); ++h) {
    if (cycle_of[h] != kNone) continue;
    for (std::uint32_t walk = h; cycle_of[walk] == kNone; walk = halfedges_[walk].next) {
      cycle_of[walk] = static_cast<std::uint32_t>(cycles.size());
    }
    cycles.push_back(h);
  }

  // At a component's first vertex everything left of it is outside: the cycle of the outgoing edge
  // of greatest angle is the component's outer one. Every other cycle bounds a face of its own.
  std::vector<bool> is_outer(cycles.size(), false);
  std::vector<std::uint32_t> face_of(cycles.size(), kNone);
  for (std::uint32_t component : components) {
    is_outer[cycle_of[outgoing_[first[component]].back()]] = true;
  }
  faces_.assign(1, Face{});
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    if (is_outer[c]) continue;
    face_of[c] = static_cast<std::uint32_t>(faces_.size());
    faces_.push_back(Face{{}, {cycles[c]}});
  }
  std::sort(components.begin(), components.end(),
            [&](std::uint32_t p, std::uint32_t q) { return order(first[p], first[q]) < 0; });
  for (std::uint32_t component : components) {
    const std::uint32_t lowest = first[component];
    const std::uint32_t below = halfedge_below(lowest, component, component_of);
    const std::uint32_t around = below == kNone ? 0u : face_of[cycle_of[below]];
    const std::uint32_t outer = cycle_of[outgoing_[lowest].back()];
    if (around == kNone) {
      consistent_ = false;
      return;
    }
    face_of[outer] = around;
    faces_[around].cycles.push_back(cycles[outer]);
  }
  for (std::uint32_t h = 0; h < halfedges_.size(); ++h) {
    halfedges_[h].face = face_of[cycle_of[h]];
  }
}

bool Overlay::spread_windings() {
  std::vector<bool> reached(faces_.size(), false);
  std::vector<std::uint32_t> stack{0};
  reached[0] = true;
  while (!stack.empty()) {
    const std::uint32_t face = stack.back();
    stack.pop_back();
    for (std::uint32_t start : faces_[face].cycles) {
      std::uint32_t walk = start;
      do {
        const std::uint32_t across = halfedges_[twin(walk)].face;
        const Winding& delta = edges_[walk / 2].delta;
        Winding expected = faces_[face].winding;
        for (int layer = 0; layer < kLayers; ++layer) {
          expected[layer] -= (walk & 1u) == 0 ? delta[layer] : -delta[layer];
        }
        if (!reached[across]) {
          reached[across] = true;
          faces_[across].winding = expected;
          stack.push_back(across);
        } else if (faces_[across].winding != expected) {
          return false;
        }
        walk = halfedges_[walk].next;
      } while (walk != start);
    }
  }
  return std::find(reached.begin(), reached.end(), false) == reached.end();
}

void Overlay::for_each_marked_face(
    const std::function<void(std::uint32_t face, const MarkWindings&)>& visit) const {
  // A walk from face to face that goes back the way it came: what winds around the present face
  // changes by one edge at a time.
  struct Step {
    std::uint32_t halfedge = 0;  // from its face to its twin's
    bool back = false;           // leaves a face for good
  };
  MarkWindings around;
  const auto cross = [&](std::uint32_t halfedge) {
    for (const auto& [mark, weight] : edges_[halfedge / 2].marks) {
      add_mark(around, mark, (halfedge & 1u) == 0 ? -weight : weight);
    }
  };
  std::vector<bool> reached(faces_.size(), false);
  std::vector<Step> steps;
  const auto enter = [&](std::uint32_t face) {
    reached[face] = true;
    for_each_halfedge(face, [&](std::uint32_t halfedge) { steps.push_back({halfedge, false}); });
  };
  enter(0);
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();
    const std::uint32_t face = halfedges_[twin(step.halfedge)].face;
    if (!step.back && reached[face]) continue;
    cross(step.halfedge);
    if (step.back) continue;
    visit(face, around);
    steps.push_back({twin(step.halfedge), true});
    enter(face);
  }
}

void Overlay::build() {
  set_scale();
  approximate();
  lines_.resize(segments_.size());
  has_line_.assign(segments_.size(), false);
  // Crossings are interned while this runs, but only endpoints can be T-vertices.
  is_t_vertex_.assign(points_.size(), false);
  std::vector<std::vector<std::uint32_t>> splits(segments_.size());
  find_intersections(splits);
  t_vertices_ =
      static_cast<std::uint64_t>(std::count(is_t_vertex_.begin(), is_t_vertex_.end(), true));
  split_segments(splits);
  link();
  trace_faces();
  consistent_ = consistent_ && spread_windings();
}

void Overlay::for_each_halfedge(std::uint32_t face,
                                const std::function<void(std::uint32_t)>& visit) const {
  for (std::uint32_t start : faces_[face].cycles) {
    std::uint32_t walk = start;
    do {
      visit(walk);
      walk = halfedges_[walk].next;
    } while (walk != start);
  }
}

std::size_t Overlay::boundary_size(const std::vector<bool>& face_in_set) const {
  std::size_t size = 0;
  for (std::size_t h = 0; h < halfedges_.size(); ++h) {
    const auto halfedge = static_cast<std::uint32_t>(h);
    if (face_in_set[halfedges_[h].face] && !face_in_set[halfedges_[twin(halfedge)].face]) ++size;
  }
  return size;
}

Overlay::FixedArea Overlay::area(const std::vector<bool>& face_in_set) const {
  FixedArea result;
  mpz_class largest;
  unsigned long terms = 0;
  for (std::size_t h = 0; h < halfedges_.size(); ++h) {
    const auto halfedge = static_cast<std::uint32_t>(h);
    if (!face_in_set[halfedges_[h].face] || face_in_set[halfedges_[twin(halfedge)].face]) continue;
    const auto& [ax, ay] = fixed(halfedges_[h].origin);
    const auto& [bx, by] = fixed(target(halfedge));
    result.value += ax * by - ay * bx;
    for (const mpz_class* coordinate : {&ax, &ay, &bx, &by}) {
      if (cmp(abs(*coordinate), largest) > 0) largest = abs(*coordinate);
    }
    ++terms;
  }
  // (x + e)(y + f) - x y with |e|, |f| <= 1: at most |x| + |y| + 1, twice a term.
  result.error = (4 * largest + 2) * terms;
  return result;
}

mpq_class Overlay::exact_area(const std::vector<bool>& face_in_set) const {
  std::vector<mpq_class> terms;
  for (std::size_t h = 0; h < halfedges_.size(); ++h) {
    const auto halfedge = static_cast<std::uint32_t>(h);
    if (!face_in_set[halfedges_[h].face] || face_in_set[halfedges_[twin(halfedge)].face]) continue;
    const ChartPoint& a = points_[halfedges_[h].origin];
    const ChartPoint& b = points_[target(halfedge)];
    mpq_class term(a.x * b.y - a.y * b.x, a.w * b.w);
    term.canonicalize();
    terms.push_back(std::move(term));
  }
  mpq_class sum = unreduced_tree_sum(std::move(terms));
  sum /= 2;
  return sum;
}

NormalisedLoop normalise(std::vector<ChartPoint> loop) { return normalise(std::move(loop), {}); }

NormalisedLoop normalise(std::vector<ChartPoint> loop,
                         const std::vector<std::vector<ChartPoint>>& holes) {
  NormalisedLoop result;
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  if (loop.size() < 3) return result;
  const std::size_t size = loop.size();
  int turn = 0, flips = 0;
  bool one_way = true;
  for (std::size_t i = 0; i < size && one_way; ++i) {
    const ChartPoint &a = loop[i], &b = loop[(i + 1) % size], &c = loop[(i + 2) % size];
    const int sign = orientation(a, b, c);
    if (sign != 0 && turn != 0 && sign != turn) one_way = false;
    if (sign != 0) turn = sign;
    if (compare(a, b) != compare(b, c)) ++flips;
  }
  if (one_way && turn != 0 && flips == 2 && holes.empty()) {
    if (turn < 0) std::reverse(loop.begin(), loop.end());
    result.convex = true;
    result.loop = std::move(loop);
    return result;
  }
  if (turn == 0) return result;  // no area
  Overlay own;
  own.add_loop(loop, kReceiver);
  for (const std::vector<ChartPoint>& hole : holes) own.add_loop(hole, kTruth);
  own.build();
  bool positive = false, negative = false, twice = false;
  for (const Overlay::Face& face : own.faces()) {
    const int winding = face.winding[kReceiver];
    positive = positive || winding > 0;
    negative = negative || winding < 0;
    twice = twice || winding > 1 || winding < -1;
  }
  result.crosses_itself = twice || (positive && negative);
  const auto holds = [&](std::uint32_t h) {
    const Winding& winding = own.faces()[own.halfedges()[h].face].winding;
    return winding[kReceiver] != 0 && winding[kTruth] == 0;
  };
  for (std::uint32_t h = 0; h < own.halfedges().size(); ++h) {
    if (holds(h) && !holds(Overlay::twin(h))) {
      result.edges.emplace_back(own.point(own.halfedges()[h].origin), own.point(own.target(h)));
    }
  }
  return result;
}

}  // namespace gnomon::oracle
