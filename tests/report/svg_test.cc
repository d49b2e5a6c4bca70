// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pictures/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Svg, ShapesAndText) {
  SvgPicture picture(100, 50, "a < b & \"c\"");
  const std::array<PixelPoint, 3> loop{{{0, 0}, {10.126, 0}, {std::nan(""), 1e300}}};
  picture.polygon(loop, {"#ff0000"});
  picture.text({1, 2}, "x < y", 12, {0, 0, 0});
  StringSink sink;
  picture.write(sink);
  EXPECT_THAT(sink.text(), HasSubstr("<title>a &lt; b &amp; &quot;c&quot;</title>"));
  EXPECT_THAT(sink.text(), HasSubstr("M0 0L10.13 0L0 1"));
  EXPECT_THAT(sink.text(), HasSubstr("x &lt; y"));
  EXPECT_THAT(sink.text(), Not(HasSubstr("nan")));
}

TEST(Svg, ColoursMix) {
  EXPECT_EQ(colour_text({255, 0, 16}), "#ff0010");
  EXPECT_EQ(mix({0, 0, 0}, {200, 100, 50}, 0.5), (Colour{100, 50, 25}));
  EXPECT_EQ(mix({0, 0, 0}, {200, 100, 50}, 7), (Colour{200, 100, 50}));
}

}  // namespace
}  // namespace gnomon::report
