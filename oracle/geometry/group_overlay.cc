// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/group_overlay.h"

#include <algorithm>
#include <cmath>

namespace gnomon::oracle {

std::vector<Integers3> grid_loop(const PreparedScene& scene, std::uint32_t part) {
  std::vector<Integers3> loop;
  for (VertexId vertex : scene.loop(scene.parts[part])) {
    loop.push_back({scene.geometry.grid.at(vertex, 0), scene.geometry.grid.at(vertex, 1),
                    scene.geometry.grid.at(vertex, 2)});
  }
  return loop;
}

ExactPlane support_of(const PreparedScene& scene, std::uint32_t part) {
  return plane_of(grid_loop(scene, part));
}

namespace {

/// Area vectors of coplanar parts are parallel: their sum is the area vector of all.
Integers3 sum_of_area_vectors(const PreparedScene& scene, std::span<const std::uint32_t> parts) {
  Integers3 sum;
  for (std::uint32_t part : parts) {
    const Integers3 own = area_vector(grid_loop(scene, part));
    for (int k = 0; k < 3; ++k) sum[k] += own[k];
  }
  return sum;
}

}  // namespace

std::vector<Enclosure> areas_in_ratio(const PreparedScene& scene,
                                      std::span<const std::vector<std::uint32_t>> groups) {
  std::vector<mpz_class> squares;
  for (const std::vector<std::uint32_t>& parts : groups) {
    const Integers3 sum = sum_of_area_vectors(scene, parts);
    squares.emplace_back(dot(sum, sum));
  }
  const mpz_class largest = *std::ranges::max_element(squares);
  std::vector<Enclosure> areas;
  for (const mpz_class& square : squares) {
    mpq_class ratio(square, largest);
    ratio.canonicalize();
    areas.push_back(enclose_square_root(ratio));
  }
  return areas;
}

Enclosure group_area(const PreparedScene& scene, std::span<const std::uint32_t> parts) {
  const Integers3 sum = sum_of_area_vectors(scene, parts);
  const mpq_class square = scene.geometry.step * scene.geometry.step;
  mpq_class value = mpq_class(dot(sum, sum)) / 4;
  value *= square * square;
  return enclose_square_root(value);
}

Enclosure group_area_on_grid(const PreparedScene& scene, std::span<const std::uint32_t> parts) {
  const Integers3 sum = sum_of_area_vectors(scene, parts);
  return enclose_square_root(mpq_class(dot(sum, sum)) / 4);
}

Enclosure enclose_ratio(const mpz_class& a, const mpz_class& b) {
  if (a == 0) return {};
  long exponent_a = 0, exponent_b = 0;
  const double x = std::fabs(mpz_get_d_2exp(&exponent_a, a.get_mpz_t()));
  const double y = std::fabs(mpz_get_d_2exp(&exponent_b, b.get_mpz_t()));
  // Two truncations and one division, each off by less than one unit in the last place.
  const double ratio = x / y;
  const long power = std::clamp(exponent_a - exponent_b, -3000L, 3000L);
  return {round_down(std::ldexp(ratio * (1 - 0x1p-50), static_cast<int>(power))),
          round_up(std::ldexp(ratio * (1 + 0x1p-50), static_cast<int>(power)))};
}

GroupOverlay::GroupOverlay(const PreparedScene& scene, std::span<const std::uint32_t> parts,
                           const Truth& add_truth)
    : chart_(support_of(scene, parts.front())), whole_area_(group_area(scene, parts)) {
  for (std::uint32_t part : parts) {
    std::vector<ChartPoint> loop;
    for (const Integers3& point : grid_loop(scene, part)) loop.push_back(chart_.at(point));
    if (loop.size() >= 3 && orientation(loop[0], loop[1], loop[2]) < 0) {
      std::reverse(loop.begin(), loop.end());
    }
    overlay_.add_loop(loop, kReceiver);
    add_truth(overlay_, part, loop);
  }
}

void GroupOverlay::build() {
  overlay_.build();
  receiver_faces_ = choose([](const Winding& w) { return w[kReceiver] != 0; });
  whole_fixed_ = overlay_.area(receiver_faces_);
}

std::vector<bool> GroupOverlay::choose(const Choice& choice) const {
  std::vector<bool> chosen(overlay_.faces().size());
  for (std::size_t f = 1; f < chosen.size(); ++f) chosen[f] = choice(overlay_.faces()[f].winding);
  return chosen;
}

AreaShare GroupOverlay::share(const Choice& choice, std::size_t exact_limit) const {
  return share(choose(choice), exact_limit);
}

AreaShare GroupOverlay::share(const std::vector<bool>& faces, std::size_t exact_limit) const {
  AreaShare result;
  if (std::find(faces.begin(), faces.end(), true) == faces.end()) {
    result.exact = 0;
    return result;
  }
  result.zero = false;
  if (faces == receiver_faces_) {
    result.fraction = {1, 1};
    result.area = whole_area_;
    result.exact = 1;
    return result;
  }
  const Overlay::FixedArea own = overlay_.area(faces);
  if (whole_fixed_.value > whole_fixed_.error) {
    mpz_class low = own.value - own.error;
    if (low < 0) low = 0;
    mpq_class lower(low, whole_fixed_.value + whole_fixed_.error);
    mpq_class upper(own.value + own.error, whole_fixed_.value - whole_fixed_.error);
    lower.canonicalize();
    upper.canonicalize();
    result.fraction = {enclose(lower).lower, enclose(upper).upper};
  } else {
    result.fraction = {0, 1};  // of so many magnitudes that fixed point tells nothing
  }
  result.area = not_negative(result.fraction * whole_area_);
  if (exact_limit > 0 && overlay_.boundary_size(faces) <= exact_limit) {
    mpq_class exact = overlay_.exact_area(faces) / overlay_.exact_area(receiver_faces_);
    result.fraction = enclose(exact);
    result.exact = std::move(exact);
  }
  return result;
}

void ShareSum::add(const AreaShare& share, Enclosure weight) {
  if (count_++ == 0) only_ = share;
  area_ = area_ + share.area;
  weighted_ = weighted_ + share.fraction * weight;
  whole_ = whole_ + weight;
  zero_ = zero_ && share.zero;
  full_ = full_ && share.exact && *share.exact == 1;
}

AreaShare ShareSum::result() const {
  if (count_ == 1) return only_;
  AreaShare sum;
  sum.zero = zero_;
  if (zero_) {
    sum.exact = 0;
    return sum;
  }
  sum.area = area_;
  if (full_) {
    sum.exact = 1;
    sum.fraction = {1, 1};
    return sum;
  }
  sum.fraction = not_negative(weighted_ / whole_);
  return sum;
}

}  // namespace gnomon::oracle
