// SPDX-License-Identifier: LGPL-3.0-or-later
// The policies that a user may choose for a rounded kernel. Exact kernels ignore them: `plane`
// always knows by identity, and no exact kernel has a thickness.
#ifndef GNOMON_KERNEL_KERNEL_OPTIONS_H
#define GNOMON_KERNEL_KERNEL_OPTIONS_H

namespace gnomon {

struct KernelOptions {
  /// A vertex made by a plane, and a vertex the plane was made from, is on it without arithmetic;
  /// cut edges keep the plane that cut them instead of computing a new one from rounded vertices.
  bool identity = false;
  /// Half the thickness of a plane, relative to the diagonal of the scene: |distance| <= thickness
  /// * diagonal counts as "on".
  double thickness = 0;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_KERNEL_OPTIONS_H
