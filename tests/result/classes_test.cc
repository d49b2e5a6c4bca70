// SPDX-License-Identifier: GPL-3.0-or-later
// The names of classes, sides and reasons read back to what they name.
#include "gnomon/result/classes.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Classes, EveryNameReadsBack) {
  for (const LightState state :
       {LightState::kLit, LightState::kShadow, LightState::kPenumbra, LightState::kUmbra}) {
    EXPECT_EQ(light_state_by_name(name_of(state)), state);
  }
  for (const Side side : {Side::kFront, Side::kBack}) EXPECT_EQ(side_by_name(name_of(side)), side);
  for (const ShadowReason reason :
       {ShadowReason::kFacesAway, ShadowReason::kLightInPlane, ShadowReason::kBehindLight}) {
    EXPECT_EQ(shadow_reason_by_name(name_of(reason)), reason);
  }
  for (const Cover cover : {Cover::kPartition, Cover::kOverlay}) {
    EXPECT_EQ(cover_by_name(name_of(cover)), cover);
  }
}

TEST(Classes, OtherTextNamesNothing) {
  for (const char* text : {"", "Lit", "dark", "on", "faces away"}) {
    EXPECT_FALSE(light_state_by_name(text)) << text;
    EXPECT_FALSE(side_by_name(text)) << text;
    EXPECT_FALSE(shadow_reason_by_name(text)) << text;
    EXPECT_FALSE(cover_by_name(text)) << text;
  }
}

}  // namespace
}  // namespace gnomon
