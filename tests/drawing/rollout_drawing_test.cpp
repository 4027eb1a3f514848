#include "drawing/rollout_drawing.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <regex>

#include <gtest/gtest.h>

#include "support/markup.h"

namespace mrose {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Two robots: one drives east for 4 m and turns left at the end, with a gap on the way; its simulation drifts to the
/// north. The other has no simulation.
std::vector<DrawnRollout> twoRollouts() {
    DrawnRollout first{"one", {}, {}, "40.0 cm"}, second{"two <2>", {}, {}, "never said"};
    for (int i = 0; i <= 40; ++i) {
        const bool gap = i > 20 && i < 25;
        first.real.push_back(gap ? Pose{unknown, unknown, unknown}
                                 : Pose{0.1 * i, 0, i == 40 ? std::numbers::pi / 2 : 0});
        first.simulated.push_back({0.1 * i, 0.01 * i, 0});
        second.real.push_back({0.1 * i, 2, 0});
    }
    return {first, second};
}

std::string drawn(const std::vector<DrawnRollout>& rollouts) {
    return drawRollouts({.name = "e"}, {"t", "s", 10, "every second"}, rollouts);
}

/// The d of every path with this stroke, the legend's samples left out.
std::vector<std::string> pathsOf(const std::string& svg, const std::string& stroke) {
    std::vector<std::string> found;
    const std::regex path("<path d=\"(M[^\"]*)\" fill=\"none\" stroke=\"" + stroke + "\"");
    for (std::sregex_iterator it(svg.begin() + static_cast<long>(svg.find("<svg x=")), svg.end(), path), end; it != end;
         ++it)
        found.push_back((*it)[1]);
    return found;
}

TEST(RolloutDrawing, RealAndSimulatedPathsAreBothSeenAndInterruptedByGaps) {
    const std::string svg = drawn(twoRollouts());
    const auto real = pathsOf(svg, "#f0a828"), simulated = pathsOf(svg, "#005b9c");
    ASSERT_EQ(real.size(), 2u);
    ASSERT_EQ(simulated.size(), 1u);
    EXPECT_LT(svg.find(real[1]), svg.find(simulated[0])) << "the narrow one above the broad one";
    EXPECT_EQ(countOf(real[0], "M"), 2u) << "two pieces";
    EXPECT_EQ(countOf(real[0], "L"), 20u + 15u);
    EXPECT_EQ(countOf(real[1], "M"), 1u);
    EXPECT_EQ(countOf(simulated[0], "L"), 40u);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(RolloutDrawing, RegionsAreOneAreaEachBelowThePaths) {
    std::vector<DrawnRollout> rollouts = twoRollouts();
    const std::string without = drawn(rollouts);
    for (int i = 0; i <= 4; ++i) {
        const std::vector<Pose> samples{{1.0 * i, 0, 0}, {1.0 * i, 0.1 * i, 0}, {1.0 * i, -0.1 * i, 0}};
        rollouts[0].regions.push_back(regionOf(samples, samples[0]));
    }
    const std::string svg = drawn(rollouts);
    const std::string fill = "fill=\"#005b9c\"";
    std::vector<std::string> areas;
    const std::regex path("<path d=\"(M[^\"]*)\" " + fill + "[^>]*opacity=\"0.20\"");
    for (std::sregex_iterator it(svg.begin(), svg.end(), path), end; it != end; ++it) areas.push_back((*it)[1]);
    ASSERT_EQ(areas.size(), 2u) << "90 % and half, of the rollout that has them";
    for (const std::string& area : areas) EXPECT_EQ(countOf(area, "M"), 4u) << "one from instant to instant";
    EXPECT_LT(svg.find(areas[1]), svg.find(pathsOf(svg, "#f0a828")[0]));
    EXPECT_NE(svg.find("90 % of runs"), std::string::npos);
    EXPECT_EQ(without.find("90 % of runs"), std::string::npos);
}

TEST(RolloutDrawing, NamesStandBesideStartsAndErrorsBesideEnds) {
    const std::string svg = drawn(twoRollouts());
    for (const char* label : {"one", "two &lt;2&gt;", "40.0 cm"})
        EXPECT_EQ(countOf(svg, std::string("fill=\"#222222\">") + label + "</text>"), 1u) << label;
    EXPECT_EQ(svg.find("never said"), std::string::npos) << "there is no simulation whose error it were";
    for (const char* word : {"real path", "simulated path", "start", "heading, every second", "error at the end"})
        EXPECT_EQ(countOf(svg, std::string(">") + word + "</text>"), 1u) << word;
    EXPECT_NE(svg.find("m</text>"), std::string::npos) << "the scale bar";
}

TEST(RolloutDrawing, ArrowsPointWhereTheRobotsHead) {
    // Each is a path "M tip L corner L notch L corner Z": the way from the notch to the tip is its heading.
    const std::string svg = drawn(twoRollouts());
    const std::string number = "([0-9.]+)";
    const std::regex arrow("<path d=\"M" + number + " " + number + "L[0-9.]+ [0-9.]+L" + number + " " + number +
                           "L[0-9.]+ [0-9.]+Z\" fill=\"#9e5c00\"");
    std::vector<double> headings;
    for (std::sregex_iterator it(svg.begin(), svg.end(), arrow), end; it != end; ++it) {
        const auto value = [&](int i) { return std::stod((*it)[i]); };
        headings.push_back(std::atan2(value(4) - value(2), value(1) - value(3)));
    }
    // Of the first robot after 10, 20, 30 and 40 steps, where it looks north; of the second likewise, always east.
    ASSERT_EQ(headings.size(), 8u);
    for (std::size_t i = 0; i < headings.size(); ++i) EXPECT_NEAR(headings[i], i == 3 ? std::numbers::pi / 2 : 0, 0.01);
}

TEST(RolloutDrawing, NothingKnownIsAPictureAllTheSame) {
    const std::vector<DrawnRollout> rollouts{{"one", {{unknown, unknown, 0}}, {}, ""}};
    for (const auto& shown : {rollouts, {}}) {
        const std::string svg = drawn(shown);
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
        EXPECT_NE(svg.find("</svg>"), std::string::npos);
    }
}

}  // namespace
}  // namespace mrose
