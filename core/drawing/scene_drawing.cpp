#include "drawing/scene_drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawing/content_text.h"
#include "drawing/scene_marks.h"
#include "drawing/svg_drawing.h"
#include "io/format.h"

namespace mrose {
namespace {

using Style = SvgDrawing::Style;

constexpr Colour blue{30, 90, 200}, amber{240, 150, 20};
/// Names of more bodies than these would hide the picture.
constexpr std::size_t mostLabels = 60;

/// How far the shape reaches ahead of its reference point.
double front(const Shape& shape) {
    double most = 0;
    for (const ConvexPiece& piece : shape.pieces)
        for (std::size_t i = 0; i < piece.count; ++i) most = std::max(most, piece.corners[i].x + piece.radius);
    return most;
}

std::string sizeText(const Shape& shape) {
    Area area{{1, 1}, {-1, -1}};
    for (const ConvexPiece& piece : shape.pieces)
        for (std::size_t i = 0; i < piece.count; ++i) area.include(piece.corners[i], piece.radius);
    const Point size = area.most - area.least;
    return fixed(size.x, 3) + " m long, " + fixed(size.y, 3) + " m wide";
}

void addReference(SvgDrawing& drawing, const Shape& shape) {
    drawing.arrow({}, {1.25 * std::max(front(shape), 0.2 * shape.reach), 0}, blue);
    drawing.dot({}, 4.5, {.fill = white, .stroke = blue, .strokeWidth = 2});
    drawing.label({}, 24, "reference point");
}

void addManipulator(SvgDrawing& drawing, const Manipulator& manipulator) {
    const Placement face(Pose{manipulator.position.x, manipulator.position.y, manipulator.direction});
    const double half = manipulator.width / 2;
    const Polygon reached{face.place({0, -half}), face.place({manipulator.reach, -half}),
                          face.place({manipulator.reach, half}), face.place({0, half})};
    drawing.polygon(reached, {.fill = amber, .stroke = amber, .opacity = 0.45});
    drawing.line(Polygon{reached[0], reached[3]}, {.stroke = amber, .strokeWidth = 3});
    drawing.label(face.place({manipulator.reach, -half}), 18, manipulator.name);
}

bool seesAllRound(const BodySight& sight) { return sight.fieldOfView > 2 * std::numbers::pi - 1e-6; }

/// "sees objects 90° wide, to 5 m".
std::string sightText(const BodySight& sight) {
    return "sees objects " + fixed(degrees * sight.fieldOfView, 0) + "° wide, " +
           (sight.range > 0 ? "to " + numberText(sight.range) + " m" : "however far");
}

/// How wide it sees balls and other objects. It fades, since what it sees does not end with the picture.
void addView(SvgDrawing& drawing, const RobotType& robot) {
    constexpr int rings = 30;
    const BodySight& sight = robot.perception.objects;
    if (!sight.present || seesAllRound(sight)) return;
    const double far = 2.4 * robot.shape->reach;
    for (int ring = rings; ring > 0; --ring) {
        Polygon fan{{}};
        for (int i = 0; i <= 32; ++i) {
            const Placement direction({0, 0, sight.direction + sight.fieldOfView * (i / 32.0 - 0.5)});
            fan.push_back(direction.rotate({far * ring / rings, 0}));
        }
        drawing.polygon(fan, {.fill = blue, .opacity = 0.01});
    }
}

std::vector<SvgDrawing::LegendEntry> robotLegend(const RobotType& robot) {
    using Symbol = SvgDrawing::LegendEntry::Symbol;
    std::vector<SvgDrawing::LegendEntry> entries;
    if (const BodySight& sight = robot.perception.objects; sight.present && !seesAllRound(sight))
        entries.push_back({Symbol::line, {.stroke = blue, .strokeWidth = 12, .opacity = 0.25}, sightText(sight)});
    for (const Manipulator& manipulator : robot.manipulators)
        entries.push_back({Symbol::line,
                           {.stroke = amber, .strokeWidth = 12, .opacity = 0.6},
                           manipulator.name + ": reaches " + fixed(100 * manipulator.reach, 0) + " cm, " +
                               fixed(manipulator.speed, 1) + " m/s"});
    return entries;
}

void addBody(SvgDrawing& drawing, const Shape& shape, const Pose& pose, bool heading, const DrawingOptions& options) {
    const Placement at(pose);
    addShape(drawing, shape, at, options);
    if (!heading) return;
    drawing.arrow(at.place({}), at.place({std::max(front(shape), shape.reach), 0}), black);
    drawing.dot(at.place({}), 3, {.fill = black, .stroke = white});
}

}  // namespace

std::string drawShape(const Shape& shape, const DrawingOptions& options) {
    SvgDrawing drawing;
    addShape(drawing, shape, {}, options);
    addReference(drawing, shape);
    return drawing.text({.title = shape.name,
                         .subtitle = sizeText(shape) + ", " + contentText(shape),
                         .longestSide = 620,
                         .grid = true});
}

std::string drawRobot(const RobotType& robot, const DrawingOptions& options) {
    SvgDrawing drawing;
    addView(drawing, robot);
    addShape(drawing, *robot.shape, {}, options);
    for (const Manipulator& manipulator : robot.manipulators) addManipulator(drawing, manipulator);
    addReference(drawing, *robot.shape);
    return drawing.text({.title = robot.name,
                         .subtitle = sizeText(*robot.shape) + ", " + fixed(robot.mass, 1) + " kg",
                         .legend = robotLegend(robot),
                         .longestSide = 620,
                         .grid = true});
}

std::string drawEnvironment(const Environment& environment, const DrawingOptions& options) {
    SvgDrawing drawing;
    addEnvironment(drawing, environment, options);
    for (const Goal& goal : environment.goals) drawing.label(areaMoments(goal.area).centroid, 4, goal.name);
    return drawing.text({.title = environment.name, .subtitle = contentText(environment)});
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
    const double below = 16;
    if (scene.bodyCount() <= mostLabels) {
        for (const SceneRobot& robot : scene.robots) {
            const double reach = scene.robotTypes[robot.type].shape->reach;
            drawing.label({robot.start.x, robot.start.y - reach}, below, robot.name);
        }
        for (const SceneObject& object : scene.objects)
            drawing.label({object.start.x, object.start.y - scene.objectTypes[object.type].shape->reach}, below,
                          object.name);
    }
    return drawing.text({.title = title, .subtitle = scene.environment.name + ", " + contentText(scene)});
}

}  // namespace mrose
