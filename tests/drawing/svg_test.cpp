#include "drawing/svg.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(Svg, AttributesAreEscapedAndNumbersArePixels) {
    EXPECT_EQ(svgCircle({1, 2.345}, 3, {{"class", "a<\"b\""}}),
              "<circle cx=\"1.00\" cy=\"2.35\" r=\"3.00\" class=\"a&lt;&quot;b&quot;\"/>\n");
    EXPECT_EQ(svgText({0, 0}, "5 < 6", {}), "<text x=\"0.00\" y=\"0.00\">5 &lt; 6</text>\n");
}

TEST(Svg, PathsRunThroughTheirPoints) {
    const Point corners[] = {{0, 0}, {1, 0}, {1, 2}};
    EXPECT_EQ(SvgPath(corners, true).text(), "M0.00 0.00L1.00 0.00L1.00 2.00Z");
    EXPECT_EQ(SvgPath().moveTo({1, 2}).lineTo({3, 4}).moveTo({5, 6}).text(), "M1.00 2.00L3.00 4.00M5.00 6.00");
    EXPECT_EQ(svgBar({0, 10}, {4, 10}, 3, 1).text(),
              "M0.00 10.00L4.00 10.00M0.00 7.00L0.00 11.00M4.00 7.00L4.00 11.00");
}

TEST(Svg, ArrowsEndAtTheirTips) {
    const SvgArrow up({5, 20}, {5, 4}, 6, 4);
    EXPECT_EQ(up.shaft.text(), "M5.00 20.00L5.00 10.00");
    EXPECT_EQ(up.head.text(), "M5.00 4.00L7.00 10.00L3.00 10.00Z");
}

/// Some viewers do not know paint-order, or draw letters' strokes too thin: no stroke is needed.
TEST(Svg, HalosAreCopiesBeneathTheirLetters) {
    const std::string svg = svgHaloText({1, 2}, "a&b", {{"font-size", 14.0}}, "#222222", "#ffffff", 2);
    EXPECT_TRUE(svg.starts_with("<g font-size=\"14.00\" fill=\"#ffffff\" aria-hidden=\"true\">")) << "read out once";
    for (const char* at : {"x=\"3.00\" y=\"2.00\"", "x=\"1.00\" y=\"4.00\"", "x=\"-1.00\" y=\"2.00\"",
                           "x=\"1.00\" y=\"0.00\"", "x=\"2.41\" y=\"3.41\""})
        EXPECT_LT(svg.find(at), svg.find("</g>")) << at;
    EXPECT_EQ(svg.substr(svg.find("</g>") + 5),
              "<text x=\"1.00\" y=\"2.00\" font-size=\"14.00\" fill=\"#222222\">a&amp;b</text>\n");
    EXPECT_EQ(svg.find("stroke"), std::string::npos);
}

TEST(Svg, WhatIsClippedKeepsItsPlace) {
    EXPECT_EQ(svgClip({10, 20}, 30, 40, "<g/>"),
              "<svg x=\"10.00\" y=\"20.00\" width=\"30.00\" height=\"40.00\" viewBox=\"10.00 20.00 30.00 40.00\"><g/>"
              "</svg>\n");
}

}  // namespace
}  // namespace mrose
