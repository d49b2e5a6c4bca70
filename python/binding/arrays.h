// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays between NumPy and C++: what comes in is looked at where it lies, and what goes out is
// handed over with its memory.
#ifndef GNOMON_PYTHON_BINDING_ARRAYS_H
#define GNOMON_PYTHON_BINDING_ARRAYS_H

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace gnomon::python {

namespace nb = nanobind;

/// (n, 3) doubles, row by row.
using Points = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Integers = nb::ndarray<const std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Flags = nb::ndarray<const bool, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// An array that owns the values, without a copy. Requires: as many of them as the shape has.
template <class T>
nb::object to_numpy(std::vector<T>&& values, std::initializer_list<std::size_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(
      kept, [](void* vector) noexcept { delete static_cast<std::vector<T>*>(vector); });
  return nb::cast(nb::ndarray<nb::numpy, T>(kept->data(), shape.size(), shape.begin(), owner));
}

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_ARRAYS_H
