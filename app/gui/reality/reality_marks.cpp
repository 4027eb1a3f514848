#include "reality/reality_marks.h"

#include <algorithm>
#include <limits>

namespace mrose::gui {
namespace {

using Stretches = std::vector<Reality::Robot::Stretch>;
constexpr Nanoseconds forGood = std::numeric_limits<Nanoseconds>::max();

Stretches unknownOf(const Reality::Robot& robot) {
    const std::vector<StampedPose>& poses = robot.trajectory->poses;
    const Nanoseconds end = poses.empty() ? 0 : std::max<Nanoseconds>(0, poses.back().time - robot.origin);
    Stretches unknown = robot.unknownBetween(0, end);
    unknown.push_back({end, forGood});
    return unknown;
}

/// What lies in stretches of both.
Stretches common(const Stretches& a, const Stretches& b) {
    Stretches both;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size(); a[i].to < b[j].to ? ++i : ++j) {
        const Nanoseconds from = std::max(a[i].from, b[j].from), to = std::min(a[i].to, b[j].to);
        if (from < to) both.push_back({from, to});
    }
    return both;
}

}  // namespace

std::vector<Reality::Robot::Stretch> unknownTruth(const Reality& reality, const Reality::Robot* robot) {
    if (robot != nullptr) return unknownOf(*robot);
    Stretches unknown{{0, forGood}};
    for (const Reality::Robot& one : reality.robots) unknown = common(unknown, unknownOf(one));
    return unknown;
}

void RealityMarks::addTo(TimelineBar::Content& content, const Shown& shown, std::optional<std::size_t> selected) {
    content.noted = noted_;
    const std::shared_ptr<const Reality>& reality = shown.frame->reality;
    if (!reality) return;
    const Scene& scene = shown.frame->scene();
    const bool robot = selected && *selected < scene.robots.size();
    const Reality::Robot* const of = robot ? reality->robotNamed(scene.robots[*selected].name) : nullptr;
    if (reality_ != reality || robot_ != of) {
        unknown_ = unknownTruth(*reality, of);
        reality_ = reality;
        robot_ = of;
    }
    for (const Reality::Robot::Stretch& stretch : unknown_) {
        const Nanoseconds from = stretch.from / scene.tickLength;
        if (from >= content.end) break;
        const Nanoseconds to = std::min(stretch.to / scene.tickLength, content.end);
        content.unknown.emplace_back(from, stretch.to % scene.tickLength > 0 ? to + 1 : to);
    }
}

}  // namespace mrose::gui
