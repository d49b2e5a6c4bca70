// SPDX-License-Identifier: GPL-3.0-or-later
// Unions of convex outlines on a square, with all ties that a small lattice has: edges on one line
// that look the same way or away from each other, outlines that are given twice, corners on edges.
// The area is held against inclusion and exclusion of exact clipped polygons.
#include "algorithms/area_contour/outline_union.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::area_contour {
namespace {

constexpr int kSide = 8;  // of the receiver, a square in the lattice

/// a x + b y + c >= 0 in integers.
struct HalfPlane {
  long a, b, c;
  friend bool operator==(const HalfPlane&, const HalfPlane&) = default;
  bool has_line_of(const HalfPlane& other) const {
    return a * other.b == b * other.a && a * other.c == c * other.a && b * other.c == c * other.b;
  }
};
using Convex = std::vector<HalfPlane>;
using Point = std::array<mpq_class, 2>;

mpq_class value(const HalfPlane& line, const Point& p) {
  return line.a * p[0] + line.b * p[1] + line.c;
}

std::vector<Point> square() { return {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}}; }

std::vector<Point> clip(const std::vector<Point>& loop, const HalfPlane& line) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point &p = loop[i], &q = loop[(i + 1) % loop.size()];
    const mpq_class at_p = value(line, p), at_q = value(line, q);
    if (at_p >= 0) kept.push_back(p);
    if (sgn(at_p) * sgn(at_q) < 0) {
      const mpq_class t = at_p / (at_p - at_q);
      kept.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
    }
  }
  return kept;
}

mpq_class area(const std::vector<Point>& loop) {
  mpq_class twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point &p = loop[i], &q = loop[(i + 1) % loop.size()];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice / 2;
}

mpq_class covered(const std::vector<Convex>& outlines,
                  const std::vector<Point>& receiver = square()) {
  mpq_class sum = 0;
  for (unsigned set = 1; set < 1u << outlines.size(); ++set) {
    std::vector<Point> loop = receiver;
    int count = 0;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      if ((set >> i & 1) == 0) continue;
      ++count;
      for (const HalfPlane& line : outlines[i]) loop = clip(loop, line);
    }
    sum += count % 2 == 1 ? area(loop) : mpq_class(-area(loop));
  }
  return sum / area(receiver);
}

/// Lines are numbered by their planes here.
class Lattice final : public ExactLines {
 public:
  /// `knows_lines`: that they are one, however they are given; else only of those given alike.
  Lattice(std::vector<Point> receiver, const ReceiverChart& chart, bool knows_lines = false)
      : ExactLines(chart), receiver_(std::move(receiver)), knows_lines_(knows_lines) {}
  OutlineLine add(const HalfPlane& half) {
    OutlineLine line;
    const double length = std::hypot(static_cast<double>(half.a), static_cast<double>(half.b));
    line.a = static_cast<double>(half.a) / length;
    line.b = static_cast<double>(half.b) / length;
    line.c = static_cast<double>(half.c) / length;
    line.error = 0x1p-45;
    line.plane = PlaneRef(static_cast<std::uint32_t>(lines_.size()));
    lines_.push_back(half);
    for (std::uint32_t k = 0; k < receiver_.size(); ++k) {
      const int sign = sgn(value(half, receiver_[k]));
      line.before |= static_cast<CornerMask>(sign > 0) << k;
      line.behind |= static_cast<CornerMask>(sign < 0) << k;
    }
    return line;
  }
  /// How often integers were asked for what pairs of doubles leave open.
  int asked() const { return asked_; }
  Point meet_of(const OutlineLine& a, const OutlineLine& b) const { return meet(of(a), of(b)); }
  Side side_of_point(const OutlineLine& line, const Point& p) const { return side(of(line), p); }

  bool is_known_same(const OutlineLine& a, const OutlineLine& b) override {
    return knows_lines_ ? of(a).has_line_of(of(b)) : of(a) == of(b);
  }
  double distance_of(const OutlineLine& line, std::uint32_t corner) override {
    return std::fabs(value(of(line), receiver_[corner]).get_d());
  }
  Side side_of_meet(const OutlineLine& line, const OutlineLine& a, const OutlineLine& b) override {
    return side(of(line), meet(of(a), of(b)));
  }

 protected:
  DoubleDouble value_at(const OutlineLine& line, std::uint32_t corner) override {
    return double_double(value(of(line), receiver_[corner]));
  }
  Side exact_side_at_border(const OutlineLine& line, const OutlineLine& a,
                            std::uint32_t corner) override {
    ++asked_;
    const Point &p = receiver_[corner], &q = receiver_[(corner + 1) % receiver_.size()];
    const long px = p[0].get_num().get_si(), py = p[1].get_num().get_si();
    const long dx = q[0].get_num().get_si() - px, dy = q[1].get_num().get_si() - py;
    return side(of(line), meet(of(a), {-dy, dx, dy * px - dx * py}));
  }
  Ball exact_place_on(const OutlineLine& line, const OutlineLine& by) override {
    ++asked_;
    const Point p = meet(of(line), of(by));
    const double x = p[0].get_d(), y = p[1].get_d();
    return {line.b * x - line.a * y, 0x1p-50 * (kSide + std::fabs(x) + std::fabs(y))};
  }

 private:
  const HalfPlane& of(const OutlineLine& line) const { return lines_[line.plane.index()]; }
  static Point meet(const HalfPlane& p, const HalfPlane& q) {
    const auto product = [](long x, long y) { return mpq_class(mpz_class(x) * y); };
    const mpq_class det = product(p.a, q.b) - product(p.b, q.a);
    return {(product(p.b, q.c) - product(p.c, q.b)) / det,
            (product(p.c, q.a) - product(p.a, q.c)) / det};
  }
  static Side side(const HalfPlane& line, const Point& p) {
    const int sign = sgn(value(line, p));
    return sign > 0 ? Side::kFront : sign < 0 ? Side::kBack : Side::kOn;
  }

  std::vector<Point> receiver_;  // of integers
  bool knows_lines_;
  std::vector<HalfPlane> lines_;
  int asked_ = 0;
};

ReceiverChart chart(const std::vector<Point>& receiver) {
  ReceiverChart result;
  for (const Point& p : receiver) result.corners.push_back({p[0].get_d(), p[1].get_d()});
  result.reach = kSide * 1.5;
  return result;
}

/// What a union says, or nothing where some outline holds all of the receiver. False if all of it
/// is covered, and the union does not say so: then that is for exact cuts to tell.
bool check(const std::vector<Convex>& outlines, const mpq_class& truth, const std::string& what,
           double most_error, const std::vector<Point>& corners, bool may_be_open,
           bool knows_lines) {
  const ReceiverChart receiver = chart(corners);
  Lattice exact(corners, receiver, knows_lines);
  OutlineUnion outline_union;
  outline_union.begin(receiver, exact);
  for (const Convex& outline : outlines) {
    std::vector<OutlineLine> lines;
    bool is_outside = false;
    for (const HalfPlane& half : outline) {
      const OutlineLine line = exact.add(half);
      is_outside = is_outside || line.before == 0;
      if (line.before != 0 && line.behind != 0) lines.push_back(line);
    }
    if (is_outside) continue;
    if (lines.empty()) return true;
    outline_union.add(lines);
  }
  if (outline_union.size() == 0) {
    EXPECT_EQ(truth, 0) << what;
    return true;
  }
  const UnionShare share = outline_union.share();
  EXPECT_LT(share.error, most_error) << what;
  EXPECT_LE(std::fabs(share.covered - truth.get_d()), share.error) << what;
  EXPECT_TRUE(truth == 1 || !share.hidden) << what;
  EXPECT_TRUE(truth != 1 || share.hidden || may_be_open) << what;
  return truth != 1 || share.hidden;
}

bool check(const std::vector<Convex>& outlines, const mpq_class& truth, const std::string& what,
           double most_error = 1e-9, const std::vector<Point>& corners = square(),
           bool may_be_open = false) {
  const bool is_told = check(outlines, truth, what, most_error, corners, may_be_open, false);
  return check(outlines, truth, what + ", lines known", most_error, corners, may_be_open, true) &&
         is_told;
}

void check(const std::vector<Convex>& outlines, const std::string& what) {
  check(outlines, covered(outlines), what);
}

Convex box(int left, int low, int right, int high) {
  return {{1, 0, -left}, {-1, 0, right}, {0, 1, -low}, {0, -1, high}};
}

TEST(OutlineUnion, EdgesOfNeighboursCancel) {
  check({box(1, 1, 3, 3), box(3, 1, 5, 3)}, "side by side");
  check({box(1, 1, 3, 4), box(3, 2, 5, 6)}, "half side by side");
  check({box(0, 0, 4, 8), box(4, 0, 8, 8)}, "all of it in two halves");
  check({box(0, 0, 4, 8), box(4, 0, 8, 4), box(4, 4, 8, 8)}, "with a T-junction");
}

TEST(OutlineUnion, OneEdgeOfSeveralActs) {
  check({box(1, 1, 5, 5), box(1, 1, 5, 5)}, "twice");
  check({box(1, 1, 5, 5), box(1, 2, 4, 7), box(1, 3, 6, 4)}, "on one line");
  check({box(1, 1, 5, 5), box(1, 1, 5, 5), box(5, 1, 7, 5)}, "twice beside one");
}

/// Of 4 * `count` tangents of a circle around (x, y), by Pythagorean triples.
Convex disc(long x, long y, long radius, long count) {
  Convex result;
  for (long i = 1; i <= count; ++i) {
    const long a = count * count - i * i, b = 2 * count * i, c = count * count + i * i;
    for (const auto& [p, q] : {std::array{a, b}, {-b, a}, {-a, -b}, {b, -a}}) {
      result.push_back({-p, -q, radius * c + p * x + q * y});
    }
  }
  return result;
}

/// More lines than have numbers of eight bits, and more corners than bits for both of a line's
/// sides.
TEST(OutlineUnion, ManyLinesAndManyCorners) {
  const std::vector<Point> twelve = {{3, 0}, {5, 0}, {7, 1}, {8, 3}, {8, 5}, {7, 7},
                                     {5, 8}, {3, 8}, {1, 7}, {0, 5}, {0, 3}, {1, 1}};
  for (const std::vector<Point>& receiver : {square(), twelve}) {
    for (const long count : {3, 40, 70}) {
      for (const std::vector<Convex>& outlines :
           {std::vector<Convex>{disc(4, 4, 3, count)},
            {disc(4, 4, 3, count), disc(4, 4, 3, count), disc(6, 3, 4, count)},
            {disc(0, 0, 6, count), box(5, 1, 8, 7), disc(8, 8, 3, 5)},
            {box(3, -1, 5, 9), disc(3, 4, 2, count), disc(5, 4, 2, count), box(2, 3, 6, 5)}}) {
        check(outlines, covered(outlines, receiver), std::to_string(count), 1e-9, receiver);
      }
    }
  }
}

constexpr int kFine = 1 << 20;

/// Has an edge that falls by as little as 2^-26 for 1, from x = 4 to x = 7. Where it ends is known
/// to some 10 / kFine.
Convex flat() {
  constexpr int kFlat = 1 << 26;
  return {{-1, -kFlat, 5 * kFlat + 4}, {0, -1, 5}, {0, 1, -2}, {1, 0, -1}, {-1, 0, 7}};
}

/// From x = 2 to x = 4 + more / kFine.
Convex wide(int more, int low, int high) {
  return {{-kFine, 0, 4 * kFine + more}, {1, 0, -2}, {0, -1, high}, {0, 1, -low}};
}

/// Another outline holds only so little of the edge, before its end, that bounds leave open whether
/// it does: then the edge's end, be it found as sharply as may be, is not that of what is seen.
TEST(OutlineUnion, CoverWithinTheBoundsOfAnEnd) {
  for (int more = -12; more <= 12; ++more) {
    for (const bool is_first : {false, true}) {
      std::vector<Convex> outlines{flat(), wide(more, 1, 5)};
      if (is_first) std::swap(outlines[0], outlines[1]);
      check(outlines, covered(outlines), std::to_string(more), 1e-6);
    }
  }
}

/// Two lines of one outline, both nearly along the edge, end what it holds within each other's
/// bounds: the end is the inner one of the two, which integers tell.
TEST(OutlineUnion, EndOfTwoLinesThatAreNearlyAlongTheEdge) {
  constexpr long kFlat = 1 << 26, kSteep = kFlat / 2 * kFine;
  for (int more = -12; more <= 12; ++more) {
    for (const bool is_mirrored : {false, true}) {
      const long turn = is_mirrored ? -1 : 1, shift = is_mirrored ? kSide : 0;
      // x, or the side's length less x, is at most 4 and 4 + more / kFine where y is 5.
      Convex held = {{-turn, -kFlat, 5 * kFlat + 4 + turn * shift},
                     {-turn * kFine, -kSteep, 5 * kSteep + 4 * kFine + more + turn * shift * kFine},
                     {0, 1, -2},
                     {turn, 0, -2 - turn * shift}};
      for (const bool is_first : {false, true}) {
        std::vector<Convex> outlines{box(1, 1, 7, 5), held};
        if (is_first) std::swap(outlines[0], outlines[1]);
        check(outlines, covered(outlines), std::to_string(more), 1e-9);
      }
    }
  }
}

/// Cells meet there, and what ends in one of them is not seen from the other.
TEST(OutlineUnion, CellsMeetWithinTheBoundsOfAnEnd) {
  for (int more = -12; more <= 12; ++more) {
    for (int held = 0; held <= 8; held += 2) {
      std::vector<Convex> outlines{flat(), wide(held, 1, 6)};
      for (int i = 0; i < 210; ++i) outlines.push_back(wide(more + i % 6, 6, 7));
      check(outlines, covered({flat(), wide(held, 1, 6), wide(more + 5, 6, 7)}),
            std::to_string(more) + ", " + std::to_string(held), 2e-6);
    }
  }
}

/// Of few lines of a small lattice, so that nearly every edge has others on its line.
class Lots {
 public:
  explicit Lots(unsigned seed) : random_(seed) {}
  int upto(long n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  Convex outline() {
    const int left = upto(6), low = upto(6);
    Convex result = box(left, low, left + 1 + upto(4), low + 1 + upto(4));
    for (int cuts = upto(3); cuts > 0; --cuts) {
      const int a = upto(2) == 0 ? 1 : -1, b = upto(2) == 0 ? 1 : -1;
      result.push_back({a, b, -(a * (left + upto(3)) + b * (low + upto(3)))});
    }
    return result;
  }
  /// Through a point of the lattice.
  HalfPlane line() {
    const int a = upto(7) - 3, b = a == 0 ? 1 : upto(7) - 3;
    return {a, b, -(a * upto(kSide + 1) + b * upto(kSide + 1))};
  }

 private:
  std::mt19937 random_;
};

/// Lines of an outline that are given again, perhaps in other numbers and perhaps as seen from
/// behind, so that it has no area.
TEST(OutlineUnion, LinesGivenTwice) {
  Lots lots(11);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Convex> outlines(1 + static_cast<std::size_t>(lots.upto(4)));
    for (Convex& outline : outlines) {
      outline = lots.outline();
      for (int more = lots.upto(4); more > 0; --more) {
        const HalfPlane line = outline[static_cast<std::size_t>(lots.upto(std::ssize(outline)))];
        const long times = lots.upto(8) == 0 ? -1 : 1 + lots.upto(3);
        outline.insert(outline.begin() + lots.upto(std::ssize(outline) + 1),
                       {times * line.a, times * line.b, times * line.c});
      }
    }
    check(outlines, "round " + std::to_string(round));
    if (HasFailure()) return;
  }
}

TEST(OutlineUnion, LatticeOfOutlines) {
  Lots lots(7);
  for (int round = 0; round < 4000; ++round) {
    std::vector<Convex> outlines(2 + static_cast<std::size_t>(lots.upto(5)));
    for (Convex& outline : outlines) outline = lots.outline();
    check(outlines, "round " + std::to_string(round));
    if (HasFailure()) return;
  }
}

/// Every line is turned and moved by so little that bounds do not tell it from those that were one
/// with it, nor from the receiver's edges.
/// Of two lines that differ by a few units of 2^-50, and of any two: sides where one enters and
/// leaves the receiver are exact, places are enclosed closely, and pairs of doubles mostly tell.
TEST(ExactLines, SidesAndPlacesOfLinesThatAreAllButOne) {
  constexpr long kAllBut = 1L << 50;
  Lots lots(5);
  int crossings = 0, asked = 0, on = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::vector<Point> corners =
        round % 2 == 0 ? square() : std::vector<Point>{{0, 0}, {kSide, 1}, {kSide, 3}, {2, kSide}};
    const ReceiverChart receiver = chart(corners);
    Lattice exact(corners, receiver);
    HalfPlane first = lots.line();
    first = {first.a * kAllBut, first.b * kAllBut, first.c * kAllBut};
    HalfPlane second = round % 5 == 0 ? lots.line() : first;
    if (round % 5 != 0) {
      second.a += lots.upto(5) - 2;
      second.b += lots.upto(5) - 2;
      second.c += lots.upto(9) - 4;
    }
    if (second.a * first.b == first.a * second.b) continue;
    const OutlineLine line = exact.add(first), by = exact.add(second);
    if (line.before == 0 || line.behind == 0 || by.before == 0 || by.behind == 0) continue;
    const auto [low, high] = exact.sides_at_ends(by, line);
    const Point meet = exact.meet_of(line, by);
    std::array<mpq_class, 2> ends;
    std::array<Side, 2> truth{Side::kOn, Side::kOn};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Point &p = corners[k], &q = corners[(k + 1) % corners.size()];
      const mpq_class at_p = value(first, p), at_q = value(first, q);
      if (at_p == 0) {
        const bool enters = value(first, corners[(k + corners.size() - 1) % corners.size()]) > 0;
        truth[enters ? 0 : 1] = exact.side_of_point(by, p);
      } else if (sgn(at_p) * sgn(at_q) < 0) {
        const mpq_class t = at_p / (at_p - at_q);
        truth[at_p > 0 ? 0 : 1] =
            exact.side_of_point(by, {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
      }
    }
    ASSERT_EQ(low, truth[0]) << round;
    ASSERT_EQ(high, truth[1]) << round;
    on += low == Side::kOn || high == Side::kOn ? 1 : 0;
    const int before = exact.asked();
    const Ball place = exact.place_on(line, by);
    const mpq_class x = mpq_class(line.b) * meet[0] - mpq_class(line.a) * meet[1];
    ASSERT_LE(abs(x - mpq_class(place.middle)), mpq_class(place.radius)) << round;
    if (low == high || low == Side::kOn || high == Side::kOn) continue;  // the meet is outside
    ++crossings;
    asked += exact.asked() - before;
    ASSERT_LT(place.radius, 0x1p-46 * receiver.reach) << round;
  }
  EXPECT_GT(crossings, 500);
  EXPECT_GT(on, 20);
  EXPECT_LT(asked * 50, crossings);
}

/// Where lines meet the lower edge of the square at places -c / a that are one, or 1 / (a a')
/// apart: their products differ by so little that pairs of doubles do not tell.
TEST(ExactLines, PlacesOnTheBorderThatNoPairOfDoublesTells) {
  std::mt19937_64 random(3);
  const std::vector<Point> corners = square();
  const ReceiverChart receiver = chart(corners);
  int on = 0, off = 0;
  for (int round = 0; round < 2000; ++round) {
    // Neighbours in a sequence of Farey: c a' - a c' = 1.
    std::array<long, 2> above = {1, 0}, below = {0, 1};  // c, a of both
    const long most = 1L << (40 + round % 15);
    while (above[1] + below[1] < most && above[0] + below[0] < most) {
      const long times = 1 + static_cast<long>(random() % 3);
      std::array<long, 2>& moved = random() % 2 == 0 ? above : below;
      const std::array<long, 2>& by = &moved == &above ? below : above;
      moved = {moved[0] + times * by[0], moved[1] + times * by[1]};
    }
    if (!(above[0] < 7 * above[1]) || !(below[0] > 0)) continue;
    const bool same = round % 2 == 0;
    if (same) below = above;
    const auto line = [&](const std::array<long, 2>& at, long b) {
      return HalfPlane{at[1], b, -at[0]};
    };
    Lattice exact(corners, receiver);
    const OutlineLine along = exact.add(line(above, static_cast<long>(random() % 1000)));
    const OutlineLine other = exact.add(line(below, -static_cast<long>(random() % 1000)));
    // The place of the first is farther right, where the second one is positive.
    const Side side = exact.side_at_border(other, along, 0);
    ASSERT_EQ(side, same ? Side::kOn : Side::kFront) << round;
    ASSERT_EQ(exact.side_at_border(along, other, 0), same ? Side::kOn : Side::kBack) << round;
    (same ? on : off) += 1;
  }
  EXPECT_GT(on, 200);
  EXPECT_GT(off, 200);
}

TEST(OutlineUnion, LinesThatAreAllButOne) {
  constexpr long kAllBut = 1L << 50;
  Lots lots(11);
  std::size_t hidden = 0, open = 0;
  for (int round = 0; round < 700; ++round) {
    std::vector<Convex> outlines(2 + static_cast<std::size_t>(lots.upto(5)));
    for (Convex& outline : outlines) {
      outline = lots.outline();
      for (HalfPlane& line : outline) {
        line.a = line.a * kAllBut + lots.upto(5) - 2;
        line.b = line.b * kAllBut + lots.upto(5) - 2;
        line.c = line.c * kAllBut + lots.upto(9) - 4;
      }
    }
    if (round % 3 == 0) {  // four quarters of the square, with slits and overlaps
      const long middle = 4 * kAllBut;
      const auto bit = [&] { return static_cast<long>(lots.upto(5)) - 2; };
      for (const auto [x, y] : {std::array{1L, 1L}, {1L, -1L}, {-1L, 1L}, {-1L, -1L}}) {
        outlines.push_back({{x * kAllBut + bit(), bit(), -x * middle + lots.upto(12) - 2},
                            {bit(), y * kAllBut + bit(), -y * middle + lots.upto(12) - 2}});
      }
    }
    const mpq_class truth = covered(outlines);
    hidden += truth == 1 ? 1 : 0;
    open += check(outlines, truth, "round " + std::to_string(round), 1e-9, square(), true) ? 0 : 1;
    if (HasFailure()) return;
  }
  EXPECT_GT(hidden, 20u);
  EXPECT_LT(open * 2, hidden);
}

/// Each outline in two halves, many times: so many that the square is halved into cells. They cover
/// what the outlines do, and no half holds a whole one.
TEST(OutlineUnion, ManyHalves) {
  Lots lots(9);
  for (int round = 0; round < 200; ++round) {
    std::vector<Convex> outlines(2 + static_cast<std::size_t>(lots.upto(3)));
    std::vector<Convex> halves;
    for (Convex& outline : outlines) {
      outline = lots.outline();
      for (int i = 20 + lots.upto(100); i > 0; --i) {
        const HalfPlane line = lots.line();
        for (const long sign : {1L, -1L}) {
          halves.push_back(outline);
          halves.back().push_back({sign * line.a, sign * line.b, sign * line.c});
        }
      }
    }
    check(halves, covered(outlines), "round " + std::to_string(round));
    if (HasFailure()) return;
  }
}

/// So many that in some rounds the square is halved into cells.
TEST(OutlineUnion, ManyBoxes) {
  std::mt19937 random(8);
  const auto upto = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 300; ++round) {
    std::vector<Convex> outlines;
    std::array<std::array<bool, kSide>, kSide> squares{};
    for (int i = 25 + upto(40) * (1 + round % 6); i > 0; --i) {
      const int left = upto(kSide), low = upto(kSide);
      const int right = std::min(kSide, left + 1 + upto(2)),
                high = std::min(kSide, low + 1 + upto(2));
      outlines.push_back(box(left, low, right, high));
      for (int x = left; x < right; ++x) {
        for (int y = low; y < high; ++y) {
          squares[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)] = true;
        }
      }
    }
    int count = 0;
    for (const auto& column : squares) count += static_cast<int>(std::ranges::count(column, true));
    mpq_class truth(count, kSide * kSide);
    truth.canonicalize();
    check(outlines, truth, "round " + std::to_string(round));
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace gnomon::area_contour
