#include "scenario/environment_file.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "io/toml_text.h"
#include "scenario/description_reader.h"

namespace mrose {
namespace {

constexpr Colour stone{150, 150, 150};
constexpr Colour white{255, 255, 255};

/// The line that a wall's surface follows: how far to the left of the wall's own line, m.
Polygon offset(const Polygon& line, bool closed, double left) {
    const std::size_t n = line.size();
    const auto normal = [&](std::size_t from, std::size_t to) {
        const Point along = line[to] - line[from];
        return (1 / length(along)) * Point{-along.y, along.x};
    };
    Polygon moved;
    for (std::size_t i = 0; i < n; ++i) {
        const bool first = !closed && i == 0, last = !closed && i + 1 == n;
        const Point before = first ? normal(0, 1) : normal((i + n - 1) % n, i);
        const Point after = last ? before : normal(i, (i + 1) % n);
        // The mitre lies along the sum of both normals and is as far from both segments.
        moved.push_back(line[i] + (left / (1 + dot(before, after))) * (before + after));
    }
    return moved;
}

/// A wall bends too sharply where its mitre would reach farther than twice its thickness.
bool bendsSharply(const Point& a, const Point& b, const Point& c) {
    const Point in = b - a, out = c - b;
    return dot(in, out) < -0.5 * length(in) * length(out);
}

void checkBends(TomlTable& table, const Polygon& line, bool closed) {
    const std::size_t n = line.size();
    for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < n; ++i)
        if (bendsSharply(line[(i + n - 1) % n], line[i], line[(i + 1) % n]))
            table.rejectElement("points_m", i, "turns by more than 120 degrees; expected two walls");
}

std::vector<ShapePart> segments(TomlTable& table, const Polygon& line, bool closed, double left, double right,
                                const Colour& colour) {
    const Polygon leftSide = offset(line, closed, left), rightSide = offset(line, closed, -right);
    std::vector<ShapePart> parts;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
        const std::size_t j = (i + 1) % line.size();
        ShapePart part;
        part.polygon = {rightSide[i], rightSide[j], leftSide[j], leftSide[i]};
        part.colour = colour;
        const Point along = line[j] - line[i];
        const double least = leastLength * length(along);
        if (dot(along, rightSide[j] - rightSide[i]) < least || dot(along, leftSide[j] - leftSide[i]) < least)
            table.rejectElement("points_m", i, "begins a segment that is too short for the wall's thickness");
        else if (const std::string problem = contactProblem(part.polygon); !problem.empty())
            table.rejectElement("points_m", i, "begins a segment that " + problem);
        parts.push_back(std::move(part));
    }
    return parts;
}

/// All but nothing, and what depends on who looks.
ColourClass colourClassOr(TomlTable& table, ColourClass fallback) {
    constexpr std::span words = std::span(colourClassWords).subspan(1, 10);
    static_assert(words.back() == "robot");
    if (!table.has("colour_class")) return fallback;
    return static_cast<ColourClass>(1 + table.choice("colour_class", words));
}

Obstacle readWall(TomlTable& table, const Surface& surface) {
    Obstacle wall;
    wall.wall = true;
    wall.name = nameOr(table, "name", "wall");
    const bool closed = table.booleanOr("closed", false);
    const Polygon line = points(table, "points_m", closed ? 3 : 2, metresFar, closed);
    const double thickness = table.number("thickness_m", {leastLength, 10});
    const std::size_t side = table.has("side") ? table.choice("side", {"both", "left", "right"}) : 0;
    const Colour colour = colourOr(table, "colour", stone);
    wall.colourClass = colourClassOr(table, ColourClass::wall);
    wall.surface = surfaceOr(table, "surface", surface);
    table.rejectUnknown();
    if (table.failed()) return wall;
    checkBends(table, line, closed);
    if (table.failed()) return wall;
    const double left = side == 0 ? thickness / 2 : side == 1 ? thickness : 0;
    auto parts = segments(table, line, closed, left, thickness - left, colour);
    if (!table.failed()) wall.shape = Shape::fromParts(wall.name, std::move(parts));
    return wall;
}

Obstacle readObstacle(TomlTable& table, const Surface& surface) {
    Obstacle obstacle;
    std::vector<ShapePart> parts{part(table, stone, metresFar)};
    obstacle.name = parts[0].name.empty() ? "obstacle" : parts[0].name;
    obstacle.surface = surfaceOr(table, "surface", surface);
    obstacle.landmark = nameOr(table, "landmark", "");
    obstacle.colourClass = colourClassOr(table, obstacle.colourClass);
    table.rejectUnknown();
    if (!table.failed()) obstacle.shape = Shape::fromParts(obstacle.name, std::move(parts));
    return obstacle;
}

Goal readGoal(TomlTable& table) {
    Goal goal{name(table, "name"), polygon(table, "area_m", metresFar)};
    table.rejectUnknown();
    return goal;
}

Marking readMarking(TomlTable& table) {
    Marking marking;
    table.expectOneOf("circle", "points_m", "points_m = [[x, y], ...] or circle = { centre_m, radius_m }");
    if (table.has("circle")) {
        TomlTable circle = table.table("circle");
        marking.centre = pointOr(circle, "centre_m", {}, metresFar);
        marking.radius = circle.number("radius_m", {leastLength, metresFar});
        circle.rejectUnknown();
    } else {
        marking.closed = table.booleanOr("closed", false);
        marking.points = points(table, "points_m", 2, metresFar, marking.closed);
    }
    marking.width = table.numberOr("width_m", marking.width, {leastLength, 10});
    marking.colour = colourOr(table, "colour", white);
    table.rejectUnknown();
    return marking;
}

FloorSurface readFloor(TomlTable table) {
    FloorSurface floor;
    floor.slidingFriction = table.numberOr("sliding_friction", floor.slidingFriction, {0, 10});
    floor.traction = table.numberOr("traction", floor.traction, {0, 10});
    floor.rollingDeceleration = table.numberOr("rolling_deceleration_mps2", floor.rollingDeceleration, {0, 100});
    floor.colour = colourOr(table, "colour", floor.colour);
    if (table.has("area_m")) floor.area = polygon(table, "area_m", metresFar);
    table.rejectUnknown();
    return floor;
}

void readObstacles(TomlTable& root, const Surface& surface, Environment& environment) {
    for (TomlTable& table : root.tablesOrNone("obstacle")) {
        Obstacle obstacle = readObstacle(table, surface);
        const auto same = [&](const Obstacle& other) {
            return !other.landmark.empty() && other.landmark == obstacle.landmark;
        };
        if (std::any_of(environment.obstacles.begin(), environment.obstacles.end(), same))
            table.reject("landmark", '"' + obstacle.landmark + "\" is another obstacle's too");
        environment.obstacles.push_back(std::move(obstacle));
    }
}

void readGoals(TomlTable& root, Environment& environment) {
    for (TomlTable& table : root.tablesOrNone("goal")) {
        Goal goal = readGoal(table);
        const auto same = [&](const Goal& other) { return other.name == goal.name; };
        if (std::any_of(environment.goals.begin(), environment.goals.end(), same))
            table.reject("name", "\"" + goal.name + "\" is the name of another goal too");
        environment.goals.push_back(std::move(goal));
    }
}

}  // namespace

Expected<Environment> readEnvironment(const Value& content, const std::string& file) {
    TomlTable root = openDescription(content, file, DescriptionKind::environment);
    Environment environment;
    environment.name = name(root, "name");
    const Surface surface = surfaceOr(root, "surface", {});
    environment.floor = readFloor(root.tableOrEmpty("floor"));
    for (TomlTable& table : root.tablesOrNone("wall")) environment.obstacles.push_back(readWall(table, surface));
    readObstacles(root, surface, environment);
    for (TomlTable& table : root.tablesOrNone("marking")) environment.markings.push_back(readMarking(table));
    readGoals(root, environment);
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    return environment;
}

Expected<Environment> parseEnvironment(std::string_view text, const std::string& file) {
    const auto content = parseToml(text, file);
    return content ? readEnvironment(*content, file) : tl::unexpected(content.error());
}

}  // namespace mrose
