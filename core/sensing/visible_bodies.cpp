#include "sensing/visible_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "geometry/elementary.h"
#include "sensing/line_of_sight.h"
#include "sensing/sector_box.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr double fullTurn = 2 * std::numbers::pi;

/// The part of the plane that a camera covers.
struct CoveredPlane {
    Placement frame;
    double range, farthest;  ///< m, m2; 0 without end
    bool allRound;
    double edge;  ///< cosine of half the field of view

    CoveredPlane(const Placement& eye, const BodySight& sight)
        : frame(eye),
          range(sight.range),
          farthest(range * range),
          allRound(sight.fieldOfView >= fullTurn),
          edge(allRound ? -1 : cosTurns(sight.fieldOfView / (2 * fullTurn))) {}

    /// The point as it is seen, in the camera's own frame, or nothing.
    std::optional<Point> at(const Point& point) const {
        const Point offset = point - frame.origin;
        if (range > 0 && dot(offset, offset) > farthest) return std::nullopt;
        const Point position = frame.rotateBack(offset);
        if (!allRound && position.x < edge * length(position)) return std::nullopt;
        return position;
    }

    /// Direction of its left edge, in its own frame.
    Point edge_B() const { return {edge, std::sqrt(std::max(0.0, 1 - edge * edge))}; }
    SightField whole() const {
        return {frame.origin, frame.rotate({edge, -edge_B().y}), frame.rotate(edge_B()), allRound,
                range > 0 ? range : std::numeric_limits<double>::infinity()};
    }

    /// Two corners of a box that holds a view whose range has an end.
    std::pair<Point, Point> box() const { return boxOfSector(frame, edge, edge_B().y, range, 0); }
};

// So few are looked at one by one; with more of them in reach it pays to keep track of what is hidden.
constexpr std::size_t fewBodies = 64;

}  // namespace

void visibleBodies(const SensorView& view, const BodySight& sight, const BodyRange& kind, std::vector<SeenBody>& seen) {
    const BodyMap& map = view.bodiesBefore(view.lagOf(sight.latency));
    Pose eye = view.past.poseBefore(view.state, view.robot, map.lag);
    eye.heading += sight.direction;
    const CoveredPlane field(Placement(eye), sight);
    const Placement direction({0, 0, sight.direction});  // in the robot's frame
    const Nanoseconds measured = view.scene.timeOf(view.state.tick - map.lag);
    const double widest = sight.occlusion ? view.scene.widestReach() : 0;
    const auto look = [&](const PointGrid::Entry& entry, auto hitsBody) {
        const std::size_t index = entry.number - kind.first;
        if (index >= kind.count || entry.number == view.robot) return;
        const std::optional<Point> position = field.at(entry.point);
        if (!position) return;
        if (sight.occlusion) {
            const SightLine line(view, map, entry.number, widest);
            if (hitsBody(line) || line.hitsObstacle()) return;
        }
        const Point position_B = sight.direction == 0 ? *position : direction.rotate(*position);
        seen.push_back({static_cast<std::uint32_t>(index), position_B, measured});
    };
    const auto lookAt = [&](const PointGrid::Entry& entry) {
        look(entry, [&](const SightLine& line) { return line.hitsBody(); });
    };
    const bool limited = field.range > 0, ends = sight.occlusion || !field.allRound;
    if (kind.count <= fewBodies || !(limited || ends)) {
        for (std::size_t body = kind.first; body < kind.first + kind.count; ++body)
            lookAt({map.positions[body], static_cast<std::uint32_t>(body)});
        return;
    }
    const auto [least, most] = field.box();
    std::size_t near = 0;
    map.grid.visitBox(least, most, [&](std::span<const PointGrid::Entry> entries) { near += entries.size(); });
    if (ends && (!limited || near > fewBodies)) {
        Outlook& outlook = view.buffers.outlook;
        outlook.look(view, map, field.whole(), sight.occlusion);
        for (const Outlook::Body& body : outlook.found())
            look(body.entry, [&](const SightLine& line) {
                return outlook.anyBefore(body, [&](std::uint32_t other) { return line.hits(other); });
            });
    } else {
        map.grid.visitBox(least, most, [&](std::span<const PointGrid::Entry> entries) {
            for (const PointGrid::Entry& entry : entries) lookAt(entry);
        });
    }
    std::sort(seen.begin(), seen.end(), [](const SeenBody& a, const SeenBody& b) { return a.index < b.index; });
}

}  // namespace mrose
