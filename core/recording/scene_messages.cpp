#include "recording/scene_messages.h"

#include <numbers>

#include "geometry/point.h"
#include "recording/json_text.h"

namespace mrose {
namespace {

// Heights for the eye, m.
constexpr double robotHeight = 0.35, personHeight = 1.7, boxHeight = 0.3, wallHeight = 0.4, paintHeight = 0.002;
constexpr double floorDepth = -0.002;

void appendPosition(std::string& json, const char* key, const Point& p, double z) {
    json += key;
    json += "{\"x\":";
    appendFixed(json, p.x, 4);
    json += ",\"y\":";
    appendFixed(json, p.y, 4);
    json += ",\"z\":";
    appendFixed(json, z, 4);
    json += '}';
}

void appendPose(std::string& json, const Point& p = {}, double z = 0) {
    appendPosition(json, "\"pose\":{\"position\":", p, z);
    json += R"(,"orientation":{"x":0,"y":0,"z":0,"w":1}})";
}

void appendColour(std::string& json, const Colour& colour, double opacity = 1) {
    json += ",\"color\":{\"r\":";
    appendFixed(json, colour.red / 255.0, 3);
    json += ",\"g\":";
    appendFixed(json, colour.green / 255.0, 3);
    json += ",\"b\":";
    appendFixed(json, colour.blue / 255.0, 3);
    json += ",\"a\":";
    appendFixed(json, opacity, 3);
    json += '}';
}

/// What an entity is drawn by, each kind a list of JSON objects.
class Entity {
public:
    Entity(std::string frame, std::string id) : frame_(std::move(frame)), id_(std::move(id)) {}

    void addPiece(const ConvexPiece& piece, const Colour& colour, double height) {
        if (piece.isCircle())
            addCylinder(piece.corners[0], piece.radius, height, colour);
        else
            addPrism(std::span(piece.corners).first(piece.count), 0, height, colour);
    }
    void addShape(const Shape& shape, double height) {
        for (std::size_t i = 0; i < shape.pieces.size(); ++i)
            addPiece(shape.pieces[i], shape.parts[shape.partOfPiece[i]].colour, height);
    }
    void addSphere(double radius, const Colour& colour) {
        begin(spheres_);
        appendPose(spheres_, {}, radius);
        appendPosition(spheres_, ",\"size\":", {2 * radius, 2 * radius}, 2 * radius);
        appendColour(spheres_, colour);
        spheres_ += '}';
    }
    /// Ahead from the middle, so that one sees which way a round robot looks.
    void addHeading(double length, double z) {
        begin(arrows_);
        appendPose(arrows_, {}, z);
        arrows_ += ",\"shaft_length\":";
        appendFixed(arrows_, 0.7 * length, 4);
        arrows_ += ",\"shaft_diameter\":0.02,\"head_length\":";
        appendFixed(arrows_, 0.3 * length, 4);
        arrows_ += ",\"head_diameter\":0.05";
        appendColour(arrows_, {20, 20, 20});
        arrows_ += '}';
    }
    void addName(const std::string& name, double z) {
        begin(texts_);
        appendPose(texts_, {}, z);
        texts_ += R"(,"billboard":true,"font_size":0.12,"scale_invariant":false)";
        appendColour(texts_, {255, 255, 255});
        texts_ += ",\"text\":";
        appendQuoted(texts_, name);
        texts_ += '}';
    }
    void addLine(std::span<const Point> points, bool closed, double width, const Colour& colour) {
        begin(lines_);
        lines_ += closed ? "\"type\":1," : "\"type\":0,";
        appendPose(lines_, {}, paintHeight);
        lines_ += ",\"thickness\":";
        appendFixed(lines_, width, 4);
        lines_ += ",\"scale_invariant\":false,\"points\":[";
        for (std::size_t i = 0; i < points.size(); ++i) appendPosition(lines_, i > 0 ? "," : "", points[i], 0);
        lines_ += ']';
        appendColour(lines_, colour);
        lines_ += ",\"colors\":[],\"indices\":[]}";
    }
    void addPlate(std::span<const Point> corners, const Colour& colour) { addPrism(corners, floorDepth, 0, colour); }

    std::string text(Nanoseconds time) const {
        std::string json = "{\"timestamp\":";
        appendTime(json, time);
        json += ",\"frame_id\":";
        appendQuoted(json, frame_);
        json += ",\"id\":";
        appendQuoted(json, id_);
        return json + R"(,"lifetime":{"sec":0,"nsec":0},"frame_locked":true,"metadata":[],"arrows":[)" + arrows_ +
               "],\"cubes\":[],\"spheres\":[" + spheres_ + "],\"cylinders\":[" + cylinders_ + "],\"lines\":[" + lines_ +
               "],\"triangles\":[" + triangles_ + "],\"texts\":[" + texts_ + "],\"models\":[]}";
    }

private:
    static void begin(std::string& list) { list += list.empty() ? "{" : ",{"; }

    void addCylinder(const Point& centre, double radius, double height, const Colour& colour) {
        begin(cylinders_);
        appendPose(cylinders_, centre, height / 2);
        appendPosition(cylinders_, ",\"size\":", {2 * radius, 2 * radius}, height);
        cylinders_ += ",\"bottom_scale\":1,\"top_scale\":1";
        appendColour(cylinders_, colour);
        cylinders_ += '}';
    }

    /// A convex polygon's top and sides as triangles.
    void addPrism(std::span<const Point> corners, double bottom, double top, const Colour& colour) {
        begin(triangles_);
        appendPose(triangles_);
        triangles_ += ",\"points\":[";
        const std::size_t n = corners.size();
        for (std::size_t i = 0; i < n; ++i) appendPosition(triangles_, i > 0 ? "," : "", corners[i], top);
        for (const Point& corner : corners) appendPosition(triangles_, ",", corner, bottom);
        triangles_ += ']';
        appendColour(triangles_, colour);
        triangles_ += ",\"colors\":[],\"indices\":[";
        std::string indices;
        const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
            for (const std::size_t index : {a, b, c}) indices += (indices.empty() ? "" : ",") + std::to_string(index);
        };
        for (std::size_t i = 2; i < n; ++i) triangle(0, i - 1, i);
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t next = (i + 1) % n;
            triangle(i, n + i, n + next);
            triangle(i, n + next, next);
        }
        triangles_ += indices + "]}";
    }

    std::string frame_, id_;
    std::string arrows_, spheres_, cylinders_, lines_, triangles_, texts_;
};

Polygon circleOf(const Point& centre, double radius) {
    constexpr int corners = 48;
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        polygon.push_back(centre + radius * towards(angle));
    }
    return polygon;
}

/// The floor's area; a rectangle round the obstacles where none is given.
Polygon floorOf(const Environment& environment) {
    if (!environment.floor.area.empty()) return environment.floor.area;
    Point least{1e9, 1e9}, most{-1e9, -1e9};
    for (const Obstacle& obstacle : environment.obstacles)
        for (const ConvexPiece& piece : obstacle.shape.pieces) {
            least = {std::min(least.x, piece.centre.x - piece.reach), std::min(least.y, piece.centre.y - piece.reach)};
            most = {std::max(most.x, piece.centre.x + piece.reach), std::max(most.y, piece.centre.y + piece.reach)};
        }
    if (least.x > most.x) return {};
    return {least, {most.x, least.y}, most, {least.x, most.y}};
}

Entity placeEntity(const Environment& environment) {
    Entity place("world", "place");
    if (const Polygon floor = floorOf(environment); !floor.empty())
        for (const Polygon& piece : convexPieces(floor)) place.addPlate(piece, environment.floor.colour);
    for (const Obstacle& obstacle : environment.obstacles) place.addShape(obstacle.shape, wallHeight);
    for (const Marking& marking : environment.markings) {
        if (marking.radius > 0)
            place.addLine(circleOf(marking.centre, marking.radius), true, marking.width, marking.colour);
        else
            place.addLine(marking.points, marking.closed, marking.width, marking.colour);
    }
    for (const Goal& goal : environment.goals) place.addLine(goal.area, true, 0.03, {240, 200, 40});
    return place;
}

Entity robotEntity(const Scene& scene, std::size_t robot, const std::string& frame) {
    const RobotType& type = scene.typeOf(robot);
    const double height = type.person ? personHeight : robotHeight;
    Entity entity(frame, frame);
    entity.addShape(*type.shape, height);
    entity.addHeading(0.8 * type.shape->reach, height + 0.02);
    entity.addName(scene.robots[robot].name.empty() ? frame : scene.robots[robot].name, height + 0.2);
    return entity;
}

Entity objectEntity(const Scene& scene, std::size_t object, const std::string& frame) {
    const ObjectType& type = scene.typeOfObject(object);
    Entity entity(frame, frame);
    if (type.rolls)
        entity.addSphere(type.shape->reach, type.shape->parts.front().colour);
    else
        entity.addShape(*type.shape, boxHeight);
    return entity;
}

}  // namespace

std::string sceneMessage(const Scenario& scenario, std::span<const std::string> frames, Nanoseconds time) {
    const Scene& scene = scenario.scene();
    std::string json = "{\"deletions\":[],\"entities\":[" + placeEntity(scene.environment).text(time);
    for (std::size_t i = 0; i < scene.robots.size(); ++i) json += ',' + robotEntity(scene, i, frames[i]).text(time);
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        json += ',' + objectEntity(scene, i, frames[scene.robots.size() + i]).text(time);
    return json + "]}";
}

}  // namespace mrose
