// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernels whose vertices are coordinates: rounded in floating point, exact in GMP rationals.
#ifndef GNOMON_KERNEL_COORDINATE_COORDINATE_KERNELS_H
#define GNOMON_KERNEL_COORDINATE_COORDINATE_KERNELS_H

#include <gmpxx.h>

#include "kernel/coordinate/coordinate_image_space.h"
#include "kernel/coordinate/coordinate_space.h"
#include "kernel/coordinate/coordinate_volume_space.h"

namespace gnomon {

template <class T>
struct CoordinateKernel {
  using LightSpace = CoordinateLightSpace<T>;
  using VolumeSpace = CoordinateVolumeSpace<T>;
  using ImageSpace = CoordinateImageSpace<T>;
};

struct FloatKernel : CoordinateKernel<float> {};
struct DoubleKernel : CoordinateKernel<double> {};
struct LongDoubleKernel : CoordinateKernel<long double> {};
struct RationalKernel : CoordinateKernel<mpq_class> {};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_COORDINATE_COORDINATE_KERNELS_H
