// SPDX-License-Identifier: LGPL-3.0-or-later
// Chooses the storage of the grid's coordinates by their largest one.
#include <algorithm>
#include <cassert>

#include "gnomon/kernel/geometry.h"

namespace gnomon {

static_assert(sizeof(long) == sizeof(std::int64_t), "GMP's get_si() must carry 64 bits");

GridPositions GridPositions::from(std::vector<mpz_class> coordinates) {
  assert(coordinates.size() % 3 == 0);
  GridPositions result;
  for (const mpz_class& coordinate : coordinates) {
    assert(sgn(coordinate) >= 0);
    // mpz_sizeinbase calls 0 one bit long.
    const std::size_t bits = sgn(coordinate) == 0 ? 0 : mpz_sizeinbase(coordinate.get_mpz_t(), 2);
    result.bits_ = std::max(result.bits_, static_cast<unsigned>(bits));
  }
  if (!result.is_narrow()) {
    result.wide_ = std::move(coordinates);
    return result;
  }
  result.narrow_.reserve(coordinates.size());
  for (const mpz_class& coordinate : coordinates) result.narrow_.push_back(coordinate.get_si());
  return result;
}

}  // namespace gnomon
