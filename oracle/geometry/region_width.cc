// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/region_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "oracle/geometry/box_tree.h"
#include "oracle/geometry/slab_cut.h"

namespace gnomon::oracle {

namespace {

constexpr std::size_t kMostTrapezoids = 100'000;
constexpr std::size_t kStepsAnEdge = 400;  // a break between two edges takes some 160 to isolate
constexpr std::size_t kMostSteps = 40'000;
constexpr double kCloseEnough = 1.05;  // ratio of the bounds
constexpr int kBits = Overlay::kFixedBits;

struct Planar {
  double x = 0, y = 0;
};

struct PlanarEdge {
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

double farthest(const Piece& piece, const PlanarEdge& edge) {
  double result = 0;
  for (int i = 0; i < piece.count; ++i) {
    result = std::max(result, distance(piece.corners[i], edge.a, edge.b));
  }
  return result;
}

/// No disc has a radius above the mean of its centre's distances from two edges, which is convex.
double half_between(const Piece& piece, const PlanarEdge& below, const PlanarEdge& above) {
  double result = 0;
  for (int i = 0; i < piece.count; ++i) {
    result = std::max(result, distance(piece.corners[i], below.a, below.b) +
                                  distance(piece.corners[i], above.a, above.b));
  }
  return result / 2;
}

double upper_bound(const Piece& piece, const PlanarEdge& below, const PlanarEdge& above) {
  return std::min(
      {farthest(piece, below), farthest(piece, above), half_between(piece, below, above)});
}

/// The length of a trapezoid's side along the edge below.
double bottom_of(const Piece& piece) {
  return std::hypot(piece.corners[1].x - piece.corners[0].x,
                    piece.corners[1].y - piece.corners[0].y);
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

class RegionMeasure {
 public:
  RegionMeasure(const Overlay& overlay, const ChartMetric& metric,
                const std::vector<std::uint32_t>& boundary, long double step)
      : overlay_(overlay), metric_(metric), unit_(overlay.box_unit() * step), slabs_(overlay) {
    read(boundary);
    slabs_.cut([this](std::size_t below, std::size_t above, Stop stop) {
      guesses_.push_back(guess(below, above, stop));
      complete_ = guesses_.size() <= kMostTrapezoids;
      return complete_;
    });
    add_trapezoids();
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
    const auto [below, above, stop] = widest_between_;
    ChartPoint interior = slabs_.middle(below, above, stop);
    reduce(interior);
    return {width, std::move(interior)};
  }

 private:
  /// Coordinates relative to the base, subtracted exactly, in units of the overlay's box.
  Planar planar(const mpz_class& x, const mpz_class& y) const {
    const double u = scaled(x - base_.x), v = scaled(y - base_.y);
    return Planar{metric_.a * u + metric_.b * v, metric_.c * v};
  }
  Planar planar(const Overlay::FixedPoint& point) const { return planar(point.x, point.y); }
  Planar corner(std::size_t edge, Stop stop);

  /// What doubles say of a trapezoid, whose corners cost most.
  struct Guess {
    std::size_t below = 0, above = 0;
    Stop stop = 0;
    Planar centre;
    double upper = 0;  // of the radius
    double wide = 0;   // of what the interior's trapezoid has most of
    double error = 0;  // both may be more or less by this
  };
  Guess guess(std::size_t below, std::size_t above, Stop stop) const;
  /// Along the slabs.
  double place_of(Planar point) const;
  /// A corner, and what it may be off by.
  std::pair<Planar, double> guessed_corner(std::size_t edge, Stop stop) const;
  /// The radius of a disc in the region, not the largest.
  double some_radius() const;
  void read(const std::vector<std::uint32_t>& boundary);
  void add_trapezoids();
  void add_trapezoid(std::size_t below, std::size_t above, Stop stop);
  /// Halves the pieces, widest first, until no disc can be much larger than the one found.
  double lower_bound(double fine);
  /// How far some point of a piece can be from the edge where that is least; the piece's own bound
  /// if that is less.
  double nearest_edge(const Piece& piece) const;
  double distance_to_edges(Planar point) const;

  const Overlay& overlay_;
  const ChartMetric& metric_;
  long double unit_;  // scene units; the grid's own may be beyond all doubles
  Overlay::FixedPoint base_;
  SlabCut slabs_;
  std::vector<PlanarEdge> edges_;       // as those of the slabs
  std::vector<std::uint32_t> origins_;  // of these: the vertex at a
  std::vector<KnownCorner<Planar>> corners_;
  std::vector<Guess> guesses_;
  BoxTree tree_;  // of the slabs' edges
  double size_ = 0;
  std::priority_queue<Piece> queue_;
  double widest_ = -1;
  bool complete_ = true;
  struct Between {
    std::size_t below = 0, above = 0;
    Stop stop = 0;
  } widest_between_;
};

void RegionMeasure::read(const std::vector<std::uint32_t>& boundary) {
  base_ = overlay_.fixed(overlay_.halfedges()[boundary.front()].origin);
  std::vector<Planar> directions;
  for (const std::uint32_t halfedge : boundary) {
    const std::uint32_t origin = overlay_.halfedges()[halfedge].origin;
    origins_.push_back(origin);
    const auto& [a, b] = edges_.emplace_back(PlanarEdge{
        planar(overlay_.fixed(origin)), planar(overlay_.fixed(overlay_.target(halfedge)))});
    const double v = (b.y - a.y) / metric_.c;
    directions.push_back({(b.x - a.x - metric_.b * v) / metric_.a, v});
    size_ = std::max({size_, std::fabs(a.x), std::fabs(a.y), std::fabs(b.x), std::fabs(b.y)});
  }
  slabs_ = SlabCut(overlay_, best_direction(directions));
  for (const std::uint32_t halfedge : boundary) {
    slabs_.add(overlay_.halfedges()[halfedge].origin, overlay_.target(halfedge));
  }
  corners_.resize(edges_.size());
  std::vector<PlanarBox> boxes;
  for (const PlanarEdge& edge : edges_) {
    boxes.push_back(box_of(PlanarPoint{edge.a.x, edge.a.y}, PlanarPoint{edge.b.x, edge.b.y}));
  }
  tree_ = BoxTree(std::move(boxes));
}

Planar RegionMeasure::corner(std::size_t edge, Stop stop) {
  const SlabEdge& own = slabs_.edges()[edge];
  if (stop == own.first || stop == own.last) {
    const std::uint32_t vertex = stop == own.first ? own.left : own.right;
    return vertex == origins_[edge] ? edges_[edge].a : edges_[edge].b;
  }
  KnownCorner<Planar>& known = corners_[edge];
  if (known.stop != stop) {
    const ChartPoint point = slabs_.corner(edge, stop);
    known = {stop, planar(overlay_.fixed(point))};
  }
  return known.corner;
}

double RegionMeasure::place_of(Planar point) const {
  const SlabDirection direction = slabs_.direction();
  const double v = point.y / metric_.c, u = (point.x - metric_.b * v) / metric_.a;
  return direction.q * u - direction.p * v;
}

std::pair<Planar, double> RegionMeasure::guessed_corner(std::size_t edge, Stop stop) const {
  // Of coordinates and of places, which are sums of some of them with factors up to 7.
  const double rounding = 0x1p-45 * size_;
  const SlabEdge& own = slabs_.edges()[edge];
  const bool forwards = own.left == origins_[edge];
  const Planar& left = forwards ? edges_[edge].a : edges_[edge].b;
  const Planar& right = forwards ? edges_[edge].b : edges_[edge].a;
  if (stop == own.first) return {left, rounding};
  if (stop == own.last) return {right, rounding};
  const Planar along{right.x - left.x, right.y - left.y};
  const double length = std::hypot(along.x, along.y);
  const double from = place_of(left), long_way = place_of(right) - from;
  if (!(long_way > 0)) return {left, length};
  const double at = place_of(planar(overlay_.fixed(slabs_.vertex_at(stop))));
  const double part = std::clamp((at - from) / long_way, 0.0, 1.0);
  return {{left.x + part * along.x, left.y + part * along.y},
          std::min(length, rounding * (1 + length / long_way))};
}

RegionMeasure::Guess RegionMeasure::guess(std::size_t below, std::size_t above, Stop stop) const {
  Guess result;
  result.below = below;
  result.above = above;
  result.stop = stop;
  Piece piece;
  for (const auto& [i, edge, at] :
       {std::tuple{0, below, stop}, {1, below, stop + 1}, {2, above, stop + 1}, {3, above, stop}}) {
    const auto [corner, error] = guessed_corner(edge, at);
    piece.corners[i] = corner;
    result.error = std::max(result.error, error);
  }
  result.centre = centre_of(piece);
  result.upper = upper_bound(piece, edges_[below], edges_[above]);
  result.wide = std::min(result.upper, bottom_of(piece));
  return result;
}

double RegionMeasure::some_radius() const {
  constexpr std::ptrdiff_t kTries = 8;
  std::vector<const Guess*> widest;
  for (const Guess& guess : guesses_) widest.push_back(&guess);
  const auto end = widest.begin() + std::min(kTries, std::ssize(widest));
  std::partial_sort(widest.begin(), end, widest.end(),
                    [](const Guess* a, const Guess* b) { return a->upper > b->upper; });
  double radius = 0;
  for (auto one = widest.begin(); one != end; ++one) {
    // Where the centre is off, and outside the region, it is near its edges.
    radius = std::max(radius, distance_to_edges((*one)->centre) - (*one)->error);
  }
  return radius * (1 - 0x1p-30);
}

/// A trapezoid whose bound is less than the radius of some disc never is the one with the greatest
/// bound: the one that holds that disc's centre is before it, or a half of that. So it need not be
/// looked at, unless the interior is told from it.
void RegionMeasure::add_trapezoids() {
  const double radius = some_radius();
  double wide = 0;
  for (const Guess& guess : guesses_) wide = std::max(wide, guess.wide - 2 * guess.error);
  for (const Guess& guess : guesses_) {
    if (guess.upper + guess.error < radius && guess.wide + 2 * guess.error < wide) continue;
    add_trapezoid(guess.below, guess.above, guess.stop);
  }
}

void RegionMeasure::add_trapezoid(std::size_t below, std::size_t above, Stop stop) {
  Piece piece;
  piece.corners = {corner(below, stop), corner(below, stop + 1), Planar{}, corner(above, stop)};
  piece.corners[2] = corner(above, stop + 1);
  piece.below = static_cast<std::uint32_t>(below);
  piece.above = static_cast<std::uint32_t>(above);
  piece.upper = upper_bound(piece, edges_[below], edges_[above]);
  const double area_like = std::min(piece.upper, bottom_of(piece));
  if (queue_.empty() || area_like > widest_) {
    widest_ = area_like;
    widest_between_ = {below, above, stop};
  }
  queue_.push(piece);
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
      [&](std::uint32_t edge) { return farthest(piece, edges_[edge]); });
}

double RegionMeasure::distance_to_edges(Planar point) const {
  return tree_.least(
      std::numeric_limits<double>::infinity(),
      [&](const PlanarBox& box) { return distance(point, box); },
      [&](std::uint32_t edge) { return distance(point, edges_[edge].a, edges_[edge].b); });
}

double RegionMeasure::lower_bound(double fine) {
  const std::size_t most_steps = std::min(kMostSteps, 600 + kStepsAnEdge * edges_.size());
  double lower = 0;
  for (std::size_t step = 0; step < most_steps && !queue_.empty(); ++step) {
    Piece piece = queue_.top();
    if (piece.upper <= std::max(lower * kCloseEnough, fine)) break;
    queue_.pop();
    if (!piece.refined) {
      piece.upper =
          std::min(piece.upper, half_between(piece, edges_[piece.below], edges_[piece.above]));
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
  SlabCut slabs(overlay);
  for (const std::uint32_t halfedge : boundary) {
    slabs.add(overlay.halfedges()[halfedge].origin, overlay.target(halfedge));
  }
  std::vector<KnownCorner<ChartPoint>> known(boundary.size());
  const auto corner = [&](std::size_t edge, Stop stop) -> const ChartPoint& {
    const SlabEdge& own = slabs.edges()[edge];
    if (stop == own.first) return overlay.point(own.left);
    if (stop == own.last) return overlay.point(own.right);
    if (known[edge].stop != stop) {
      known[edge] = {stop, slabs.corner(edge, stop)};
      reduce(known[edge].corner);
    }
    return known[edge].corner;
  };
  std::vector<std::vector<ChartPoint>> trapezoids;
  slabs.cut([&](std::size_t below, std::size_t above, Stop stop) {
    std::vector<ChartPoint>& corners = trapezoids.emplace_back();
    for (const auto& [edge, at] :
         {std::pair{below, stop}, {below, stop + 1}, {above, stop + 1}, {above, stop}}) {
      corners.push_back(corner(edge, at));
    }
    return trapezoids.size() < kMostTrapezoids;
  });
  return trapezoids;
}

}  // namespace gnomon::oracle
