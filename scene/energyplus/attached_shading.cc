// SPDX-License-Identifier: LGPL-3.0-or-later
// Overhangs and fins: rectangles at a window or a door, by distances from its edges.
#include <utility>

#include "scene/energyplus/energy_scene.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon::energy {

namespace {

/// a * cosine + b * sine.
Position between(const Position& a, const Position& b, const Angle& angle) {
  return sum(scaled(a, angle.cosine), scaled(b, angle.sine));
}

std::vector<Position> spanned(const Position& corner, const Position& first,
                              const Position& second) {
  return {corner, sum(corner, first), sum(sum(corner, first), second), sum(corner, second)};
}

}  // namespace

Expected<const Opening*> EnergyScene::shaded_opening(const EnergyObject& object) const {
  const std::string& name = object.field("window_or_door_name").text;
  const auto found = openings_.find(lower_case(name));
  if (found != openings_.end()) {
    if (found->second.base->frame) return &found->second;
    return model_.error(ErrorCode::kFormat,
                        quoted_text(object.name()) + " is at a window in a horizontal surface",
                        "a wall or a tilted roof", object.offset);
  }
  for (const EnergyObject& other : model_.objects) {
    const EnergyKind kind = other.type->kind;
    if ((kind == EnergyKind::kWindow || kind == EnergyKind::kRectangularWindow) &&
        same_word(other.name(), name)) {
      return nullptr;
    }
  }
  return model_.error(ErrorCode::kIndex, "there is no window or door " + quoted_text(name),
                      "the name of one", object.offset);
}

Expected<void> EnergyScene::add_overhang(const EnergyObject& object) {
  const auto opening = shaded_opening(object);
  if (!opening) return tl::unexpected(opening.error());
  if (*opening == nullptr) {
    ++interior_;
    return {};
  }
  const bool is_share = object.has_field("depth_as_fraction_of_window_door_height");
  Number values[5];
  std::size_t count = 0;
  for (const char* field :
       {"height_above_window_or_door", "tilt_angle_from_window_door",
        "left_extension_from_window_door_width", "right_extension_from_window_door_width",
        is_share ? "depth_as_fraction_of_window_door_height" : "depth"}) {
    auto value = model_.number(object, field, count == 1 ? "90" : "0");
    if (!value) return tl::unexpected(std::move(value.error()));
    values[count++] = *std::move(value);
  }
  const auto& [above, tilt, left, right, given_depth] = values;
  const Opening& window = **opening;
  const WallFrame& frame = *window.base->frame;
  const Number depth = is_share ? decimal_product(given_depth, window.height.value) : given_depth;
  const Number length = decimal_sum(decimal_sum(left, right), window.width.value);
  if (depth.sign() <= 0 || length.sign() <= 0) return {};
  const Angle angle = angle_of(tilt);
  // From the window's own corner at the top, so that nothing is lost on the way.
  const Position corner = sum(sum(window.loop[0], scaled(frame.along, negated_decimal(left))),
                              scaled(frame.up, decimal_sum(window.height.value, above)));
  auto done = add_shade(object, object.name(),
                        spanned(corner, scaled(frame.along, length),
                                scaled(between(frame.up, frame.out, angle), depth)),
                        axes_of(*window.base));
  if (!done) return done;
  if (frame.is_rounded || angle.is_rounded || window.width.is_rounded || window.height.is_rounded) {
    rounded_.push_back(scene_.polygons.back().id);
  }
  return {};
}

Expected<void> EnergyScene::add_fins(const EnergyObject& object) {
  const auto opening = shaded_opening(object);
  if (!opening) return tl::unexpected(opening.error());
  if (*opening == nullptr) {
    ++interior_;
    return {};
  }
  if (auto done = add_fin(object, **opening, true); !done) return done;
  return add_fin(object, **opening, false);
}

Expected<void> EnergyScene::add_fin(const EnergyObject& object, const Opening& opening,
                                    bool is_left) {
  const std::string side = is_left ? "left" : "right";
  const bool is_share = object.has_field(side + "_depth_as_fraction_of_window_door_width");
  const std::string fields[] = {
      side + "_extension_from_window_door", side + "_distance_above_top_of_window",
      side + "_distance_below_bottom_of_window", side + "_tilt_angle_from_window_door",
      side + (is_share ? "_depth_as_fraction_of_window_door_width" : "_depth")};
  Number values[5];
  std::size_t count = 0;
  for (const std::string& field : fields) {
    auto value = model_.number(object, field, count == 3 ? "90" : "0");
    if (!value) return tl::unexpected(std::move(value.error()));
    values[count++] = *std::move(value);
  }
  const auto& [beside, above, below, tilt, given_depth] = values;
  const WallFrame& frame = *opening.base->frame;
  const Number depth = is_share ? decimal_product(given_depth, opening.width.value) : given_depth;
  const Number height = decimal_sum(decimal_sum(above, below), opening.height.value);
  if (depth.sign() <= 0 || height.sign() <= 0) return {};
  const Angle angle = angle_of(tilt);
  const Number right = is_left ? negated_decimal(beside) : decimal_sum(opening.width.value, beside);
  const Position corner = sum(
      opening.loop[0], sum(scaled(frame.along, right), scaled(frame.up, negated_decimal(below))));
  // The wall's horizontal directions, turned about the vertical by the fin's angle; upwards it
  // leans as much as the wall does.
  const Position outwards = between(frame.along, frame.out_in_plan, angle);
  const Position facing =
      difference(scaled(frame.out_in_plan, angle.cosine), scaled(frame.along, angle.sine));
  Position upwards = scaled(facing, negated_decimal(dot(frame.up, frame.out_in_plan)));
  upwards[2] = frame.up[2];
  auto done = add_shade(object, object.name() + (is_left ? " Left" : " Right"),
                        spanned(corner, scaled(outwards, depth), scaled(upwards, height)),
                        axes_of(*opening.base));
  if (!done) return done;
  const bool uses_width = !is_left || is_share;
  if (frame.is_rounded || angle.is_rounded || opening.height.is_rounded ||
      (uses_width && opening.width.is_rounded)) {
    rounded_.push_back(scene_.polygons.back().id);
  }
  return {};
}

}  // namespace gnomon::energy
