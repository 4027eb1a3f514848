#include "reality/expected_numbers.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "debug/plotted_value.h"

namespace mrose::gui {
namespace {

using Interval = PoseRegion::Interval;
using IntervalOf = std::function<Interval(const PoseRegion& region, const PoseRegion::Extent& extent)>;

constexpr double degree = std::numbers::pi / 180;

QVector<ExpectedRange> rangesOf(const MotionBands& bands, std::size_t robot, const IntervalOf& intervalOf) {
    QVector<ExpectedRange> ranges;
    std::int64_t tick = bands.tick;
    for (const PoseRegion& region : bands.regions[robot]) {
        const Interval half = intervalOf(region, region.of(RegionShare::half));
        const Interval most = intervalOf(region, region.of(RegionShare::most));
        ranges.append({static_cast<double>(tick), half.low, half.high, most.low, most.high});
        tick += bands.every;
    }
    return ranges;
}

/// About the heading as it is plotted, from -180 to 180 degrees: where that jumps, so do they.
Interval headingDegrees(const PoseRegion& region, const PoseRegion::Extent& extent) {
    const double turns = wrapAngle(region.heading) - region.heading;
    return {(extent.heading.low + turns) / degree, (extent.heading.high + turns) / degree};
}

void breakAtJumps(QVector<ExpectedRange>& ranges) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (int i = ranges.size() - 1; i > 0; --i)
        if (std::abs(ranges[i].halfLow - ranges[i - 1].halfLow) > 180)
            ranges.insert(i, {(ranges[i].tick + ranges[i - 1].tick) / 2, unknown, unknown, unknown, unknown});
}

}  // namespace

std::map<ValueKey, QVector<ExpectedRange>> expectedOf(const MotionBands& bands, const Scene& scene) {
    std::map<ValueKey, QVector<ExpectedRange>> expected;
    for (std::size_t robot = 0; robot < bands.regions.size() && robot < scene.robots.size(); ++robot) {
        if (bands.regions[robot].empty()) continue;
        const auto add = [&](const char* quantity, const IntervalOf& intervalOf) -> QVector<ExpectedRange>& {
            return expected[{quantity, scene.robots[robot].name}] = rangesOf(bands, robot, intervalOf);
        };
        add("x", [](const PoseRegion&, const PoseRegion::Extent& extent) { return extent.x; });
        add("y", [](const PoseRegion&, const PoseRegion::Extent& extent) { return extent.y; });
        breakAtJumps(add("heading", headingDegrees));
        add(positionErrorQuantity, [](const PoseRegion&, const PoseRegion::Extent& extent) {
            return Interval{0, 100 * extent.error};
        });
        add(headingErrorQuantity, [](const PoseRegion&, const PoseRegion::Extent& extent) {
            return Interval{0, extent.headingError / degree};
        });
    }
    return expected;
}

}  // namespace mrose::gui
