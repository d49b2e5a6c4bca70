// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/result/classes.h"

#include <initializer_list>

namespace gnomon {

namespace {

template <class Value>
std::optional<Value> value_named(std::initializer_list<Value> values, std::string_view name) {
  for (const Value value : values) {
    if (name == name_of(value)) return value;
  }
  return std::nullopt;
}

}  // namespace

const char* name_of(LightState state) {
  switch (state) {
    case LightState::kLit:
      return "lit";
    case LightState::kShadow:
      return "shadow";
    case LightState::kPenumbra:
      return "penumbra";
    case LightState::kUmbra:
      return "umbra";
  }
  return "";
}

const char* name_of(Side side) { return side == Side::kBack ? "back" : "front"; }

const char* name_of(ShadowReason reason) {
  switch (reason) {
    case ShadowReason::kNone:
      return "";
    case ShadowReason::kFacesAway:
      return "faces-away";
    case ShadowReason::kLightInPlane:
      return "light-in-plane";
    case ShadowReason::kBehindLight:
      return "behind-light";
    case ShadowReason::kOutsideRegion:
      return "outside-region";
  }
  return "";
}

const char* name_of(Cover cover) { return cover == Cover::kOverlay ? "overlay" : "partition"; }

const char* name_of(Block block) {
  switch (block) {
    case Block::kLights:
      return "lights";
    case Block::kCombined:
      return "combined";
    case Block::kOverlay:
      return "overlay";
  }
  return "";
}

std::optional<LightState> light_state_by_name(std::string_view name) {
  return value_named(
      {LightState::kLit, LightState::kShadow, LightState::kPenumbra, LightState::kUmbra}, name);
}

std::optional<Side> side_by_name(std::string_view name) {
  return value_named({Side::kFront, Side::kBack}, name);
}

std::optional<ShadowReason> shadow_reason_by_name(std::string_view name) {
  return value_named({ShadowReason::kFacesAway, ShadowReason::kLightInPlane,
                      ShadowReason::kBehindLight, ShadowReason::kOutsideRegion},
                     name);
}

std::optional<Cover> cover_by_name(std::string_view name) {
  return value_named({Cover::kPartition, Cover::kOverlay}, name);
}

}  // namespace gnomon
