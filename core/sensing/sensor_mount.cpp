#include "sensing/sensor_mount.h"

#include <algorithm>
#include <numbers>

#include "io/format.h"
#include "world/toml_values.h"

namespace mrose {
namespace {

constexpr NumberRange turned{-360, 360};
constexpr double mountReach = 20;     // m, as far as shapes reach
constexpr double mountSlack = 0.005;  // m: screwed onto the outline

bool isWithin(const Shape& shape, const Point& place) {
    const ConvexPiece spot = ConvexPiece::circle(place, mountSlack);
    return std::ranges::any_of(shape.pieces, [&](const ConvexPiece& piece) { return distance(piece, spot) <= 0; });
}

std::string outsideText(const Point& place) {
    return "is at " + fixed(place.x, 3) + ", " + fixed(place.y, 3) + ", outside of the robot's shape";
}

}  // namespace

Pose readMount(TomlTable& table, const SensorSources& sources) {
    const Point place = pointOr(table, "position_m", {}, mountReach);
    const double heading = angleOr(table, "heading_deg", 0, turned);
    if (sources.shape && !isWithin(*sources.shape, place)) table.reject("position_m", outsideText(place));
    return {place.x, place.y, heading};
}

std::vector<Pose> readElements(TomlTable& table, const SensorSources& sources, std::size_t most) {
    std::vector<Pose> elements;
    table.expectOneOf("ring", "elements", "`ring` or `elements`");
    if (table.has("ring")) {
        TomlTable ring = table.table("ring");
        const std::int64_t count = ring.integer("count", 1, static_cast<std::int64_t>(most));
        const double radius = ring.number("radius_m", {0, mountReach});
        const double first = angleOr(ring, "first_deg", 0, turned);
        ring.rejectUnknown();
        for (std::int64_t i = 0; i < count && !table.failed(); ++i) {
            const double heading = first + 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
            const Point place = radius * towards(heading);
            elements.push_back({place.x, place.y, heading});
            if (sources.shape && !isWithin(*sources.shape, place))
                table.reject("ring", "has an element that " + outsideText(place));
        }
        return elements;
    }
    std::vector<TomlTable> tables = table.tablesOrNone("elements");
    if (tables.empty() || tables.size() > most)
        table.reject("elements", "has " + std::to_string(tables.size()) + "; expected 1 to " + std::to_string(most));
    for (TomlTable& one : tables) {
        elements.push_back(pose(one));
        if (sources.shape && !isWithin(*sources.shape, position(elements.back())))
            one.reject("x_m", outsideText(position(elements.back())));
    }
    return elements;
}

}  // namespace mrose
