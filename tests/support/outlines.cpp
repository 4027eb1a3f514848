#include "support/outlines.h"

#include <utility>

#include "support/scenes.h"

namespace mrose {
namespace {

std::vector<std::shared_ptr<const Shape>> makeTrickyOutlines() {
    const Polygon dart{{-0.2, -0.12}, {0.3, 0}, {-0.2, 0.12}, {-0.05, 0}};
    const Polygon corner{{-0.15, -0.15}, {0.25, -0.15}, {0.25, -0.05}, {-0.05, -0.05}, {-0.05, 0.25}, {-0.15, 0.25}};
    const Polygon star{{0.3, 0},  {0.08, 0.08},   {0, 0.3},  {-0.08, 0.08},
                       {-0.3, 0}, {-0.08, -0.08}, {0, -0.3}, {0.08, -0.08}};
    return {hornedOutline(),
            outlineOf("dart", {dart}),
            outlineOf("corner", {corner}),
            outlineOf("star", {star}),
            outlineOf("splinter", {needle(0.3, 0.05)}),
            outlineOf("square", {{{-0.15, -0.15}, {0.15, -0.15}, {0.15, 0.15}, {-0.15, 0.15}}}),
            discOutline(0.15)};
}

}  // namespace

std::shared_ptr<const Shape> discOutline(double radius) {
    ShapePart part;
    part.radius = radius;
    return std::make_shared<const Shape>(Shape::fromParts("disc", {part}));
}

std::shared_ptr<const Shape> outlineOf(const std::string& name, std::vector<Polygon> parts) {
    std::vector<ShapePart> list(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) list[i].polygon = std::move(parts[i]);
    return std::make_shared<const Shape>(Shape::fromParts(name, std::move(list)));
}

Polygon needle(double length, double width) { return {{0, 0}, {-length, width / 2}, {-length, -width / 2}}; }

std::shared_ptr<const Shape> hornedOutline() {
    return outlineOf("horned", {{{-0.2, -0.15}, {0.1, -0.15}, {0.1, 0.15}, {-0.2, 0.15}},
                                {{0.1, 0.08}, {0.25, 0.1}, {0.1, 0.12}},
                                {{0.1, -0.12}, {0.25, -0.1}, {0.1, -0.08}}});
}

const std::vector<std::shared_ptr<const Shape>>& trickyOutlines() {
    static const auto outlines = makeTrickyOutlines();
    return outlines;
}

ObjectType slidingBody(std::shared_ptr<const Shape> shape, double mass, const Surface& surface) {
    ObjectType type;
    type.name = shape->name;
    type.shape = std::move(shape);
    type.mass = mass;
    type.surface = surface;
    type.rolls = false;
    return type;
}

ObjectType rollingBody(double radius, double mass, const Surface& surface) {
    ObjectType type = slidingBody(discOutline(radius), mass, surface);
    type.rolls = true;
    return type;
}

RobotType robotOf(std::shared_ptr<const Shape> shape, double mass, const Surface& surface) {
    RobotType type = squareRobot(1, mass);
    type.name = shape->name;
    type.shape = std::move(shape);
    type.surface = surface;
    return type;
}

Environment onIce(Environment environment) {
    environment.floor.slidingFriction = environment.floor.rollingDeceleration = 0;
    return environment;
}

void addObstacle(Environment& environment, const std::string& name, Polygon corners, const Surface& surface) {
    ShapePart part;
    part.polygon = std::move(corners);
    environment.obstacles.push_back({name, Shape::fromParts(name, {std::move(part)}), surface});
}

}  // namespace mrose
