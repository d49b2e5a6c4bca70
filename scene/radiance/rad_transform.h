// SPDX-License-Identifier: LGPL-3.0-or-later
// What the options of Radiance's xform do to positions, as decimals.
#ifndef GNOMON_SCENE_RADIANCE_RAD_TRANSFORM_H
#define GNOMON_SCENE_RADIANCE_RAD_TRANSFORM_H

#include <array>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// An affine map of decimals.
class RadTransform {
 public:
  RadTransform();

  /// A position, or a direction, which is not moved. Exactness: exact.
  Position apply(const Position& position) const;
  Position apply_to_direction(const Position& direction) const;
  /// Does it turn left hands into right ones? Then loops are reversed.
  bool mirrors() const { return mirrors_; }
  /// This one first, then `outer`.
  RadTransform then(const RadTransform& outer) const;

  void move(const Position& by);
  void scale(const Number& factor);
  void mirror(std::size_t axis);
  /// Counter-clockwise about an axis, by degrees: exact for quarter turns.
  void turn(std::size_t axis, const Number& degrees);
  /// Of turns that are no quarter turns: the worst error of a direction, degrees, and of a length,
  /// a share of itself, for each of them; 0 if there are none.
  double error() const { return error_; }
  double stretch() const { return stretch_; }

 private:
  std::array<std::array<Number, 4>, 3> rows_;
  bool mirrors_ = false;
  double error_ = 0, stretch_ = 0;
};

/// The command "xform OPTIONS FILE..." as it is written, without its exclamation mark.
struct XformCommand {
  std::vector<RadTransform> placements;  // one for each instance
  std::string prefix;                    // of names: "NAME." of -n
  std::string modifier;                  // of all surfaces, in place of theirs (-m); empty: theirs
  std::vector<std::string> files;
};
/// Is it an xform of files, with nothing that only a shell could carry out?
bool is_xform(const std::vector<std::string>& words);
/// -t -s -rx -ry -rz -mx -my -mz -i -a -n -m; -e and -c change nothing here. Requires: is_xform().
/// Errors, without a place: kFormat (an option that is not carried out here), kNumber, kLimit.
Expected<XformCommand> parse_xform(const std::vector<std::string>& words);

}  // namespace gnomon

#endif  // GNOMON_SCENE_RADIANCE_RAD_TRANSFORM_H
