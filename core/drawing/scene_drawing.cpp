#include "drawing/scene_drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawing/svg_drawing.h"
#include "evaluation/format.h"

namespace mrose {
namespace {

using Style = SvgDrawing::Style;

constexpr Colour black{20, 20, 20}, white{255, 255, 255}, blue{30, 90, 200}, amber{240, 150, 20};
/// Names of more bodies than these would hide the picture.
constexpr std::size_t mostLabels = 60;

double brightness(const Colour& c) { return 0.299 * c.red + 0.587 * c.green + 0.114 * c.blue; }
Colour contrast(const Colour& c) { return brightness(c) > 140 ? black : white; }

Colour darker(const Colour& c) {
    const auto shade = [](std::uint8_t channel) { return static_cast<std::uint8_t>(channel * 3 / 5); };
    return {shade(c.red), shade(c.green), shade(c.blue)};
}

Polygon placedAt(const Polygon& polygon, const Placement& placement) {
    Polygon moved;
    for (const Point& corner : polygon) moved.push_back(placement.place(corner));
    return moved;
}

void addShape(SvgDrawing& drawing, const Shape& shape, const Placement& at, const DrawingOptions& options) {
    for (const ShapePart& part : shape.parts) {
        const Style style{.fill = part.colour, .stroke = darker(part.colour)};
        if (part.polygon.empty())
            drawing.circle(at.place(part.centre), part.radius, style);
        else
            drawing.polygon(placedAt(part.polygon, at), style);
    }
    if (!options.pieces) return;
    for (std::size_t i = 0; i < shape.pieces.size(); ++i) {
        const ConvexPiece& piece = shape.pieces[i];
        const Style thin{.stroke = contrast(shape.parts[shape.partOfPiece[i]].colour), .strokeWidth = 0.8};
        if (piece.isCircle()) continue;
        drawing.polygon(placedAt({piece.corners.begin(), piece.corners.begin() + static_cast<long>(piece.count)}, at),
                        thin);
    }
}

/// How far the shape reaches ahead of its reference point.
double front(const Shape& shape) {
    double most = 0;
    for (const ConvexPiece& piece : shape.pieces)
        for (std::size_t i = 0; i < piece.count; ++i) most = std::max(most, piece.corners[i].x + piece.radius);
    return most;
}

std::string sizeText(const Shape& shape) {
    Point least{1e9, 1e9}, most{-1e9, -1e9};
    for (const ConvexPiece& piece : shape.pieces)
        for (std::size_t i = 0; i < piece.count; ++i) {
            const Point reach{piece.radius, piece.radius};
            const Point low = piece.corners[i] - reach, high = piece.corners[i] + reach;
            least = {std::min(least.x, low.x), std::min(least.y, low.y)};
            most = {std::max(most.x, high.x), std::max(most.y, high.y)};
        }
    return fixed(most.x - least.x, 3) + " × " + fixed(most.y - least.y, 3) + " m";
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

void addReference(SvgDrawing& drawing, const Shape& shape) {
    drawing.arrow({}, {1.25 * std::max(front(shape), 0.2 * shape.reach), 0}, blue);
    drawing.dot({}, 4.5, {.fill = white, .stroke = blue, .strokeWidth = 2});
    drawing.label({}, 22, "reference point");
}

void addManipulator(SvgDrawing& drawing, const Manipulator& manipulator) {
    const Placement face(Pose{manipulator.position.x, manipulator.position.y, manipulator.direction});
    const double half = manipulator.width / 2;
    const Polygon reached{face.place({0, -half}), face.place({manipulator.reach, -half}),
                          face.place({manipulator.reach, half}), face.place({0, half})};
    drawing.polygon(reached, {.fill = amber, .stroke = amber, .opacity = 0.45});
    drawing.line(Polygon{reached[0], reached[3]}, {.stroke = amber, .strokeWidth = 3});
    drawing.label(face.place({manipulator.reach, -half}), 16, manipulator.name);
}

/// The edges of what it sees of balls and other objects, as far as the picture reaches.
void addView(SvgDrawing& drawing, const RobotType& robot) {
    const double angle = robot.perception.objects.fieldOfView;
    if (!robot.perception.objects.present || angle > 2 * std::numbers::pi - 1e-6) return;
    const double far = 2.2 * robot.shape->reach;
    Polygon fan;
    for (int i = 0; i <= 32; ++i) {
        const double direction = angle * (i / 32.0 - 0.5);
        fan.push_back({far * std::cos(direction), far * std::sin(direction)});
    }
    fan.push_back({});
    drawing.polygon(fan, {.fill = blue, .opacity = 0.08});
}

void addEnvironment(SvgDrawing& drawing, const Environment& environment, const DrawingOptions& options) {
    if (!environment.floor.area.empty()) drawing.polygon(environment.floor.area, {.fill = environment.floor.colour});
    for (const Goal& goal : environment.goals) {
        drawing.polygon(goal.area, {.fill = white, .opacity = 0.25});
        drawing.polygon(goal.area, {.stroke = white, .dashed = true});
    }
    for (const Marking& marking : environment.markings) {
        const Style style{.stroke = marking.colour, .strokeWidth = marking.width, .strokeInMetres = true};
        if (marking.radius > 0)
            drawing.circle(marking.centre, marking.radius, style);
        else if (marking.closed)
            drawing.polygon(marking.points, style);
        else
            drawing.line(marking.points, style);
    }
    for (const Obstacle& obstacle : environment.obstacles) addShape(drawing, obstacle.shape, {}, options);
}

void addBody(SvgDrawing& drawing, const Shape& shape, const Pose& pose, bool heading, const DrawingOptions& options) {
    const Placement at(pose);
    addShape(drawing, shape, at, options);
    if (!heading) return;
    drawing.arrow(at.place({}), at.place({std::max(front(shape), shape.reach), 0}), black);
    drawing.dot(at.place({}), 3, {.fill = black, .stroke = white});
}

bool isFinite(const Pose& pose) { return std::isfinite(pose.x) && std::isfinite(pose.y); }

void addPath(SvgDrawing& drawing, const DrawnPath& path) {
    constexpr double arrow = 0.25;  // m
    const auto end = path.poses.end();
    for (auto from = std::find_if(path.poses.begin(), end, isFinite); from != end;) {
        const auto to = std::find_if_not(from, end, isFinite);
        Polygon points;
        std::transform(from, to, std::back_inserter(points), [](const Pose& pose) { return Point{pose.x, pose.y}; });
        drawing.line(points, {.stroke = path.colour, .strokeWidth = 2, .dashed = path.dashed});
        const auto next = std::find_if(to, end, isFinite);
        if (from == std::find_if(path.poses.begin(), end, isFinite))
            drawing.dot(points.front(), 4, {.fill = white, .stroke = path.colour, .strokeWidth = 2});
        if (next == end) drawing.arrow(points.back(), Placement(*(to - 1)).place({arrow, 0}), path.colour);
        from = next;
    }
}

}  // namespace

std::string drawShape(const Shape& shape, const DrawingOptions& options) {
    SvgDrawing drawing;
    addShape(drawing, shape, {}, options);
    addReference(drawing, shape);
    return drawing.text({.title = shape.name,
                         .subtitle = sizeText(shape) + ", " + counted(shape.parts.size(), "part", "parts") + ", " +
                                     counted(shape.pieces.size(), "convex piece", "convex pieces"),
                         .longestSide = 560,
                         .grid = true});
}

std::string drawRobot(const RobotType& robot, const DrawingOptions& options) {
    SvgDrawing drawing;
    addView(drawing, robot);
    addShape(drawing, *robot.shape, {}, options);
    for (const Manipulator& manipulator : robot.manipulators) addManipulator(drawing, manipulator);
    addReference(drawing, *robot.shape);
    return drawing.text({.title = robot.name,
                         .subtitle = sizeText(*robot.shape) + ", " + fixed(robot.mass, 1) + " kg" +
                                     (robot.manipulators.empty() ? "" : ", amber: what its manipulator reaches") +
                                     (robot.perception.objects.fieldOfView < 6.28 ? ", blue: where it sees" : ""),
                         .longestSide = 560,
                         .grid = true});
}

std::string drawEnvironment(const Environment& environment, const DrawingOptions& options) {
    SvgDrawing drawing;
    addEnvironment(drawing, environment, options);
    for (const Goal& goal : environment.goals) drawing.label(areaMoments(goal.area).centroid, 4, goal.name);
    return drawing.text({.title = environment.name,
                         .subtitle = counted(environment.obstacles.size(), "obstacle", "obstacles") + ", " +
                                     counted(environment.goals.size(), "goal", "goals")});
}

std::string drawPaths(const Environment& environment, const std::string& title, const std::string& subtitle,
                      std::span<const DrawnPath> paths) {
    SvgDrawing drawing;
    addEnvironment(drawing, environment, {});
    for (const DrawnPath& path : paths) addPath(drawing, path);
    for (const DrawnPath& path : paths) {
        const auto first = std::find_if(path.poses.begin(), path.poses.end(), isFinite);
        if (first != path.poses.end() && !path.name.empty()) drawing.label({first->x, first->y}, 20, path.name);
    }
    return drawing.text({.title = title, .subtitle = subtitle});
}

std::string drawScene(const Scene& scene, const std::string& title, const DrawingOptions& options) {
    SvgDrawing drawing;
    addEnvironment(drawing, scene.environment, options);
    for (const SceneObject& object : scene.objects) {
        const ObjectType& type = scene.objectTypes[object.type];
        addBody(drawing, *type.shape, object.start, false, options);
    }
    for (const SceneRobot& robot : scene.robots)
        addBody(drawing, *scene.robotTypes[robot.type].shape, robot.start, true, options);
    const double below = 14;
    if (scene.bodyCount() <= mostLabels) {
        for (const SceneRobot& robot : scene.robots) {
            const double reach = scene.robotTypes[robot.type].shape->reach;
            drawing.label({robot.start.x, robot.start.y - reach}, below, robot.name);
        }
        for (const SceneObject& object : scene.objects)
            drawing.label({object.start.x, object.start.y - scene.objectTypes[object.type].shape->reach}, below,
                          object.name);
    }
    return drawing.text({.title = title,
                         .subtitle = scene.environment.name + ", " + counted(scene.robots.size(), "robot", "robots") +
                                     ", " + counted(scene.objects.size(), "object", "objects")});
}

}  // namespace mrose
