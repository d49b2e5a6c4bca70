// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/region_width.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

#include "oracle/geometry/box_tree.h"

namespace gnomon::oracle {

namespace {

constexpr std::size_t kMostTrapezoids = 100'000;
constexpr std::size_t kStepsAnEdge = 400;  // a break between two edges takes some 160 to isolate
constexpr std::size_t kMostSteps = 40'000;
constexpr double kCloseEnough = 1.05;  // ratio of the bounds
constexpr int kBits = 256;             // of coordinates relative to the overlay's box

struct Planar {
  double x = 0, y = 0;
};

struct BoundaryEdge {
  ChartPoint left, right;  // in the order x, y
  ChartLine line;
  Planar a, b;
};

struct Piece {
  std::array<Planar, 4> corners;
  int count = 4;
  std::uint32_t below = 0, above = 0;  // the edges that it lies between
  double upper = 0;                    // bound of the radius
  bool refined = false;                // against all edges, not only its own
  bool operator<(const Piece& other) const { return upper < other.upper; }
};

double distance(Planar p, Planar a, Planar b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double px = p.x - a.x, py = p.y - a.y;
  const double squared = dx * dx + dy * dy;
  if (squared == 0) return std::hypot(px, py);
  const double t = std::clamp((px * dx + py * dy) / squared, 0.0, 1.0);
  if (t > 0 && t < 1) return std::fabs(px * dy - py * dx) / std::sqrt(squared);
  return std::hypot(px - t * dx, py - t * dy);
}

/// Of a box from a point; a little less where rounding might make it more than that of what it
/// holds.
double distance(Planar p, const PlanarBox& box) {
  const double dx =
      std::max({0.0, static_cast<double>(box.low.x) - p.x, p.x - static_cast<double>(box.high.x)});
  const double dy =
      std::max({0.0, static_cast<double>(box.low.y) - p.y, p.y - static_cast<double>(box.high.y)});
  return (1 - 0x1p-40) * std::sqrt(dx * dx + dy * dy);
}

double farthest(const Piece& piece, const BoundaryEdge& edge) {
  double result = 0;
  for (int i = 0; i < piece.count; ++i) {
    result = std::max(result, distance(piece.corners[i], edge.a, edge.b));
  }
  return result;
}

/// No disc has a radius above the mean of its centre's distances from two edges, which is convex.
double half_between(const Piece& piece, const BoundaryEdge& below, const BoundaryEdge& above) {
  double result = 0;
  for (int i = 0; i < piece.count; ++i) {
    result = std::max(result, distance(piece.corners[i], below.a, below.b) +
                                  distance(piece.corners[i], above.a, above.b));
  }
  return result / 2;
}

Planar centre_of(const Piece& piece) {
  Planar sum;
  for (int i = 0; i < piece.count; ++i) {
    sum.x += piece.corners[i].x / piece.count;
    sum.y += piece.corners[i].y / piece.count;
  }
  return sum;
}

std::array<Piece, 2> halve(const Piece& piece) {
  std::array<Piece, 2> halves{piece, piece};
  for (Piece& half : halves) half.count = 3, half.refined = false;
  if (piece.count == 4) {
    halves[0].corners = {piece.corners[0], piece.corners[1], piece.corners[2], Planar{}};
    halves[1].corners = {piece.corners[0], piece.corners[2], piece.corners[3], Planar{}};
    return halves;
  }
  int longest = 0;
  double length = -1;
  for (int i = 0; i < 3; ++i) {
    const Planar &p = piece.corners[i], &q = piece.corners[(i + 1) % 3];
    const double own = std::hypot(p.x - q.x, p.y - q.y);
    if (own > length) length = own, longest = i;
  }
  const Planar p = piece.corners[longest], q = piece.corners[(longest + 1) % 3],
               r = piece.corners[(longest + 2) % 3];
  const Planar middle{p.x + (q.x - p.x) / 2, p.y + (q.y - p.y) / 2};
  halves[0].corners = {p, middle, r, Planar{}};
  halves[1].corners = {middle, q, r, Planar{}};
  return halves;
}

/// An integer of kBits binary places as a double.
double scaled(const mpz_class& value) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
  return std::ldexp(mantissa, static_cast<int>(std::clamp(exponent - kBits, -5000L, 5000L)));
}

/// A rational that is not reduced, which costs more than all else here; the denominator is
/// positive.
struct Fraction {
  mpz_class numerator, denominator = 1;
  friend bool operator<(const Fraction& a, const Fraction& b) {
    return cmp(mpz_class(a.numerator * b.denominator), mpz_class(b.numerator * a.denominator)) < 0;
  }
};

Fraction middle_of(const Fraction& a, const Fraction& b) {
  return {a.numerator * b.denominator + b.numerator * a.denominator,
          2 * a.denominator * b.denominator};
}

/// y of a line that is not vertical, at x: exactly.
Fraction height_at(const ChartLine& line, const Fraction& x) {
  Fraction y{line.a * x.numerator + line.c * x.denominator, line.b * x.denominator};
  if (y.denominator < 0) {
    y.denominator = -y.denominator;
  } else {
    y.numerator = -y.numerator;
  }
  return y;
}

}  // namespace

ChartMetric::ChartMetric(const Chart& chart) {
  const Integers3& normal = chart.support().normal;
  const int k = chart.axis();
  const auto slope = [&](int axis) {
    const double size = enclose(mpq_class(abs(normal[axis])) / mpq_class(abs(normal[k]))).middle();
    return sgn(normal[axis]) * sgn(normal[k]) < 0 ? -size : size;
  };
  const double g = slope((k + 1) % 3), h = slope((k + 2) % 3);
  a = std::sqrt(1 + g * g);
  b = g * h / a;
  c = std::sqrt((1 + g * g + h * h) / (1 + g * g));
}

namespace {

/// Slabs are cut along a direction (p, q) that is as far from parallel to all long edges as
/// possible: then the two edges that bound a trapezoid are near everywhere in it, however the
/// region winds.
struct SlabDirection {
  int p = 0, q = 1;
  ChartPoint turn(const ChartPoint& point) const {
    return {q * point.x - p * point.y, p * point.x + q * point.y, point.w};
  }
  /// The inverse: back to the chart. Not reduced.
  ChartPoint turn_back(const Fraction& x, const Fraction& y) const {
    const mpz_class u = x.numerator * y.denominator, v = y.numerator * x.denominator;
    return {q * u + p * v, q * v - p * u, (p * p + q * q) * x.denominator * y.denominator};
  }
};

SlabDirection best_direction(const std::vector<Planar>& edges) {
  constexpr int kReach = 7;       // some 70 directions, none special to axes or diagonals alone
  constexpr double kLong = 1e-6;  // of the longest edge
  double longest = 0;
  for (const Planar& edge : edges) longest = std::max(longest, std::hypot(edge.x, edge.y));
  SlabDirection best;
  double best_sine = -1;
  for (int p = -kReach; p <= kReach; ++p) {
    for (int q = p > 0 ? 0 : 1; q <= kReach; ++q) {
      if (std::gcd(p, q) != 1) continue;
      double least = 1;
      for (const Planar& edge : edges) {
        const double length = std::hypot(edge.x, edge.y);
        if (length <= kLong * longest) continue;
        least = std::min(least, std::fabs(p * edge.y - q * edge.x) / (length * std::hypot(p, q)));
        if (least <= best_sine) break;
      }
      if (least > best_sine) best_sine = least, best = {p, q};
    }
  }
  return best;
}

/// The boundary's edges of a region, turned so that slabs are upright, and the region between them
/// as trapezoids, slab by slab.
class SlabCut {
 public:
  explicit SlabCut(SlabDirection direction = {}) : direction_(direction) {}

  void add(BoundaryEdge edge);
  const std::vector<BoundaryEdge>& edges() const { return edges_; }
  SlabDirection direction() const { return direction_; }
  /// Calls `use(below, above, low_x, high_x, middle_x, middle_y)` for each; it returns false to
  /// stop.
  template <class Use>
  void cut(const Use& use);

 private:
  template <class Use>
  bool cut_slab(const std::vector<std::size_t>& crossing, const ChartPoint& from,
                const ChartPoint& to, const Use& use);

  SlabDirection direction_;
  std::vector<BoundaryEdge> edges_;
};

void SlabCut::add(BoundaryEdge edge) {
  edge.left = direction_.turn(edge.left);
  edge.right = direction_.turn(edge.right);
  if (compare(edge.left, edge.right) > 0) std::swap(edge.left, edge.right);
  edge.line = line_through(edge.left, edge.right);
  edges_.push_back(std::move(edge));
}

template <class Use>
void SlabCut::cut(const Use& use) {
  std::vector<ChartPoint> stops;  // where slabs begin and end
  for (const BoundaryEdge& edge : edges_) {
    stops.push_back(edge.left);
    stops.push_back(edge.right);
  }
  const auto before_x = [](const ChartPoint& p, const ChartPoint& q) {
    return compare_x(p, q) < 0;
  };
  std::sort(stops.begin(), stops.end(), before_x);
  stops.erase(
      std::unique(stops.begin(), stops.end(),
                  [](const ChartPoint& p, const ChartPoint& q) { return compare_x(p, q) == 0; }),
      stops.end());
  std::sort(edges_.begin(), edges_.end(),
            [&](const BoundaryEdge& p, const BoundaryEdge& q) { return before_x(p.left, q.left); });
  std::vector<std::size_t> active;
  std::size_t next = 0;
  for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
    const ChartPoint& from = stops[s];
    std::erase_if(active, [&](std::size_t e) { return compare_x(edges_[e].right, from) <= 0; });
    while (next < edges_.size() && compare_x(edges_[next].left, from) <= 0) {
      if (compare_x(edges_[next].right, from) > 0) active.push_back(next);
      ++next;
    }
    if (!cut_slab(active, from, stops[s + 1], use)) return;
  }
}

/// Between each two edges that cross the slab.
template <class Use>
bool SlabCut::cut_slab(const std::vector<std::size_t>& crossing, const ChartPoint& from,
                       const ChartPoint& to, const Use& use) {
  const Fraction low_x{from.x, from.w}, high_x{to.x, to.w};
  const Fraction middle_x = middle_of(low_x, high_x);
  std::vector<std::pair<Fraction, std::size_t>> across;
  for (std::size_t e : crossing) across.emplace_back(height_at(edges_[e].line, middle_x), e);
  std::ranges::sort(
      across, std::less<>(), [](const auto& own) -> auto& { return own.first; });
  for (std::size_t i = 0; i + 1 < across.size(); i += 2) {
    const Fraction middle_y = middle_of(across[i].first, across[i + 1].first);
    if (!use(edges_[across[i].second], edges_[across[i + 1].second], low_x, high_x, middle_x,
             middle_y)) {
      return false;
    }
  }
  return true;
}

class RegionMeasure {
 public:
  RegionMeasure(const Overlay& overlay, const ChartMetric& metric,
                const std::vector<std::uint32_t>& boundary, long double step)
      : overlay_(overlay), metric_(metric), unit_(overlay.box_unit() * step) {
    read(boundary);
    slabs_.cut([this](const BoundaryEdge& below, const BoundaryEdge& above, const Fraction& low_x,
                      const Fraction& high_x, const Fraction& middle_x, const Fraction& middle_y) {
      return add_trapezoid(below, above, low_x, high_x, middle_x, middle_y);
    });
  }

  RegionShape shape(double resolution, double most) {
    const double rounding = 0x1p-47 * size_;
    const double fine =
        std::max(4 * rounding, static_cast<double>(unit_ > 0 ? resolution / 2 / unit_ : 0.0L));
    const double lower = lower_bound(fine);
    double upper = queue_.empty() ? lower : std::max(lower, queue_.top().upper);
    if (!complete_) upper = size_;  // no better bound was computed
    const auto scene_units = [&](double radius) { return static_cast<double>(2 * radius * unit_); };
    const Enclosure width{round_down(scene_units(std::max(0.0, lower - rounding))),
                          std::min(round_up(scene_units(upper + rounding)), most)};
    reduce(interior_);
    return {width, std::move(interior_)};
  }

 private:
  /// Coordinates relative to the base, subtracted exactly, in units of the overlay's box.
  Planar planar(const ChartPoint& point) const {
    const mpz_class dx = overlay_.fixed_value(point.x, point.w, kBits) - base_x_;
    const mpz_class dy = overlay_.fixed_value(point.y, point.w, kBits) - base_y_;
    const double u = scaled(dx), v = scaled(dy);
    return Planar{metric_.a * u + metric_.b * v, metric_.c * v};
  }

  void read(const std::vector<std::uint32_t>& boundary);
  /// False once there are too many.
  bool add_trapezoid(const BoundaryEdge& below, const BoundaryEdge& above, const Fraction& low_x,
                     const Fraction& high_x, const Fraction& middle_x, const Fraction& middle_y);
  /// Halves the pieces, widest first, until no disc can be much larger than the one found.
  double lower_bound(double fine);
  /// How far some point of a piece can be from the edge where that is least; the piece's own bound
  /// if that is less.
  double nearest_edge(const Piece& piece) const;
  double distance_to_edges(Planar point) const;

  const Overlay& overlay_;
  const ChartMetric& metric_;
  long double unit_;  // scene units; the grid's own may be beyond all doubles
  mpz_class base_x_, base_y_;
  SlabCut slabs_;
  BoxTree tree_;  // of the slabs' edges
  double size_ = 0;
  std::priority_queue<Piece> queue_;
  std::size_t made_ = 0;
  double widest_ = -1;
  bool complete_ = true;
  ChartPoint interior_;
};

void RegionMeasure::read(const std::vector<std::uint32_t>& boundary) {
  const ChartPoint& base = overlay_.point(overlay_.halfedges()[boundary.front()].origin);
  base_x_ = overlay_.fixed_value(base.x, base.w, kBits);
  base_y_ = overlay_.fixed_value(base.y, base.w, kBits);
  std::vector<Planar> directions;
  std::vector<BoundaryEdge> edges;
  for (std::uint32_t halfedge : boundary) {
    const ChartPoint& p = overlay_.point(overlay_.halfedges()[halfedge].origin);
    const ChartPoint& q = overlay_.point(overlay_.target(halfedge));
    edges.push_back({p, q, {}, planar(p), planar(q)});
    const Planar &a = edges.back().a, &b = edges.back().b;
    const double v = (b.y - a.y) / metric_.c;
    directions.push_back({(b.x - a.x - metric_.b * v) / metric_.a, v});
    size_ = std::max({size_, std::fabs(a.x), std::fabs(a.y), std::fabs(b.x), std::fabs(b.y)});
  }
  slabs_ = SlabCut(best_direction(directions));
  for (BoundaryEdge& edge : edges) slabs_.add(std::move(edge));
}

bool RegionMeasure::add_trapezoid(const BoundaryEdge& below, const BoundaryEdge& above,
                                  const Fraction& low_x, const Fraction& high_x,
                                  const Fraction& middle_x, const Fraction& middle_y) {
  Piece piece;
  const auto corner = [&](const BoundaryEdge& edge, const Fraction& x) {
    return planar(slabs_.direction().turn_back(x, height_at(edge.line, x)));
  };
  piece.corners = {corner(below, low_x), corner(below, high_x), corner(above, high_x),
                   corner(above, low_x)};
  piece.below = static_cast<std::uint32_t>(&below - slabs_.edges().data());
  piece.above = static_cast<std::uint32_t>(&above - slabs_.edges().data());
  const auto apart = [&](int i, int j) {
    return std::hypot(piece.corners[i].x - piece.corners[j].x,
                      piece.corners[i].y - piece.corners[j].y);
  };
  piece.upper =
      std::min({farthest(piece, below), farthest(piece, above), half_between(piece, below, above)});
  const double area_like = std::min(piece.upper, apart(1, 0));
  if (area_like > widest_) {
    widest_ = area_like;
    interior_ = slabs_.direction().turn_back(middle_x, middle_y);
  }
  queue_.push(piece);
  if (++made_ > kMostTrapezoids) complete_ = false;
  return complete_;
}

double RegionMeasure::nearest_edge(const Piece& piece) const {
  return tree_.least(
      piece.upper,
      [&](const PlanarBox& box) {
        double most = 0;
        for (int i = 0; i < piece.count; ++i) {
          most = std::max(most, distance(piece.corners[i], box));
        }
        return most;
      },
      [&](std::uint32_t edge) { return farthest(piece, slabs_.edges()[edge]); });
}

double RegionMeasure::distance_to_edges(Planar point) const {
  return tree_.least(
      std::numeric_limits<double>::infinity(),
      [&](const PlanarBox& box) { return distance(point, box); },
      [&](std::uint32_t edge) {
        return distance(point, slabs_.edges()[edge].a, slabs_.edges()[edge].b);
      });
}

double RegionMeasure::lower_bound(double fine) {
  std::vector<PlanarBox> boxes;
  for (const BoundaryEdge& edge : slabs_.edges()) {
    boxes.push_back(box_of(PlanarPoint{edge.a.x, edge.a.y}, PlanarPoint{edge.b.x, edge.b.y}));
  }
  tree_ = BoxTree(std::move(boxes));
  const std::size_t most_steps = std::min(kMostSteps, 600 + kStepsAnEdge * slabs_.edges().size());
  double lower = 0;
  for (std::size_t step = 0; step < most_steps && !queue_.empty(); ++step) {
    Piece piece = queue_.top();
    if (piece.upper <= std::max(lower * kCloseEnough, fine)) break;
    queue_.pop();
    if (!piece.refined) {
      piece.upper = std::min(piece.upper, half_between(piece, slabs_.edges()[piece.below],
                                                       slabs_.edges()[piece.above]));
      piece.upper = nearest_edge(piece);
      lower = std::max(lower, distance_to_edges(centre_of(piece)));
      piece.refined = true;
      queue_.push(piece);
      continue;
    }
    for (Piece& half : halve(piece)) queue_.push(half);
  }
  return lower;
}

}  // namespace

RegionShape measure_region(const Overlay& overlay, const ChartMetric& metric,
                           const std::vector<std::uint32_t>& boundary,
                           const WidthQuestion& question) {
  return RegionMeasure(overlay, metric, boundary, question.step)
      .shape(question.resolution, question.most);
}

double width_of_area(double share, double whole) {
  constexpr double kTwoOverRootPi = 1.1283791670955126;
  // Four roundings.
  return kTwoOverRootPi * std::sqrt(share) * std::sqrt(whole) * (1 + 0x1p-50);
}

std::vector<std::vector<ChartPoint>> trapezoids_of(const Overlay& overlay,
                                                   const std::vector<std::uint32_t>& boundary) {
  SlabCut slabs;
  for (const std::uint32_t halfedge : boundary) {
    slabs.add({overlay.point(overlay.halfedges()[halfedge].origin),
               overlay.point(overlay.target(halfedge)),
               {},
               {},
               {}});
  }
  std::vector<std::vector<ChartPoint>> trapezoids;
  slabs.cut([&](const BoundaryEdge& below, const BoundaryEdge& above, const Fraction& low_x,
                const Fraction& high_x, const Fraction&, const Fraction&) {
    std::vector<ChartPoint> corners;
    for (const auto& [edge, x] :
         {std::pair{&below, &low_x}, {&below, &high_x}, {&above, &high_x}, {&above, &low_x}}) {
      corners.push_back(slabs.direction().turn_back(*x, height_at(edge->line, *x)));
      reduce(corners.back());
    }
    trapezoids.push_back(std::move(corners));
    return trapezoids.size() < kMostTrapezoids;
  });
  return trapezoids;
}

}  // namespace gnomon::oracle
