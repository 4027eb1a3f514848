#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sensing/line_camera.h"
#include "sensing/ranging.h"

namespace mrose {

inline LineCamera::Options rowOf(std::size_t width, double view, double range = 12,
                                 BeamFan::Spacing spacing = BeamFan::Spacing::tangents) {
    LineCamera::Options options;
    options.width = width;
    options.view = view;
    options.range = range;
    options.spacing = spacing;
    for (std::size_t i = 1; i < colourClassWords.size(); ++i)
        options.blobClasses.push_back(static_cast<ColourClass>(i));
    return options;
}

inline std::shared_ptr<const LineCamera> lineCamera(const LineCamera::Options& options, Nanoseconds period = 0) {
    return std::make_shared<const LineCamera>(SensorTraits{"row", period}, options);
}

struct ColourRow {
    std::vector<ColourPixel> pixels;
    std::vector<ColourBlob> blobs;

    /// The only blob of a class.
    ColourBlob blob(ColourClass of) const {
        ColourBlob found;
        for (const ColourBlob& blob : blobs) {
            if (blob.colourClass != of) continue;
            EXPECT_EQ(found.pixels, 0u) << "two of class " << static_cast<int>(of);
            found = blob;
        }
        return found;
    }
    std::size_t count(ColourClass of) const {
        return static_cast<std::size_t>(
            std::ranges::count_if(pixels, [&](const ColourPixel& pixel) { return pixel.colourClass == of; }));
    }
};

inline ColourRow rowSeen(const Scenario& scenario, std::size_t robot = 0) {
    WorldState state = scenario.initialState();
    return {recordsNow<ColourPixel>(scenario, state, "row", robot),
            recordsNow<ColourBlob>(scenario, state, "row.blobs", robot)};
}

inline ColourRow rowSeen(const LineCamera::Options& options, Environment environment = {}) {
    return rowSeen(sensing(lineCamera(options), std::move(environment)).scenario());
}

/// In a pinhole's image plane at distance 1, or rad: where a pixel's middle is.
inline double middleOf(const LineCamera::Options& options, std::size_t pixel) {
    const double half = options.spacing == BeamFan::Spacing::tangents ? std::tan(options.view / 2) : options.view / 2;
    return half * ((2 * static_cast<double>(pixel) + 1) / static_cast<double>(options.width) - 1);
}

inline double angleOf(const LineCamera::Options& options, std::size_t pixel) {
    const double middle = middleOf(options, pixel);
    return options.spacing == BeamFan::Spacing::tangents ? std::atan(middle) : middle;
}

/// The distance to a line by turning the line onto the axis.
inline bool onMarking(const Environment& environment, const Point& point) {
    for (const Marking& marking : environment.markings) {
        if (marking.radius > 0) {
            const double away = std::hypot(point.x - marking.centre.x, point.y - marking.centre.y);
            if (std::abs(away - marking.radius) <= marking.width / 2) return true;
            continue;
        }
        const std::size_t n = marking.points.size();
        for (std::size_t i = 0; i + (marking.closed ? 0 : 1) < n; ++i) {
            const Point a = marking.points[i], b = marking.points[(i + 1) % n];
            const double turned = std::atan2(b.y - a.y, b.x - a.x), length = std::hypot(b.x - a.x, b.y - a.y);
            const double along = (point.x - a.x) * std::cos(turned) + (point.y - a.y) * std::sin(turned);
            const double aside = (point.y - a.y) * std::cos(turned) - (point.x - a.x) * std::sin(turned);
            const double beyond = along < 0 ? -along : along > length ? along - length : 0;
            if (std::hypot(beyond, aside) <= marking.width / 2) return true;
        }
    }
    return false;
}

inline ColourClass solvedClass(const Scenario& scenario, const WorldState& state, const LineCamera::Options& options,
                               std::size_t pixel) {
    const Scene& scene = scenario.scene();
    const Pose eye = state.robots[0].pose * options.mount;
    const double angle = angleOf(options, pixel);
    const Point along{std::cos(eye.heading + angle), std::sin(eye.heading + angle)};
    const RayHit hit = solvedRay(scenario, state, 0, position(eye), along);
    double floor = std::numeric_limits<double>::infinity();
    if (options.floor > 0)
        floor = options.spacing == BeamFan::Spacing::angles ? options.floor : options.floor / std::cos(angle);
    if (std::min(floor, hit.range) > options.range) return ColourClass::nothing;
    if (floor < hit.range)
        return onMarking(scene.environment, position(eye) + floor * along) ? ColourClass::marking : ColourClass::floor;
    if (hit.obstacle) return scene.environment.obstacles[*hit.obstacle].colourClass;
    if (*hit.body >= scene.robots.size())
        return scene.objectTypes[scene.objects[*hit.body - scene.robots.size()].type].rolls ? ColourClass::ball
                                                                                            : ColourClass::box;
    const SceneRobot& robot = scene.robots[*hit.body];
    if (scene.robotTypes[robot.type].person) return ColourClass::person;
    if (robot.team.empty() || scene.robots[0].team.empty()) return ColourClass::robot;
    return robot.team == scene.robots[0].team ? ColourClass::teamMate : ColourClass::opponent;
}

/// A random scene with all that there may be: markings, goals, teams, persons.
inline Scenario colouredScene(const SensorPointer& sensor, std::uint32_t seed) {
    ScenarioParts parts = randomScene(sensor, seed, seed % 3 == 0 ? 60 : 12, seed % 3 == 0 ? 12 : 7).parts();
    Scene& scene = parts.scene;
    std::vector<Obstacle>& walls = scene.environment.obstacles;
    walls[0].colourClass = walls[1].colourClass = ColourClass::wall;
    walls[2].colourClass = ColourClass::yellowGoal;
    walls[3].colourClass = ColourClass::blueGoal;
    const auto uniform = [&](std::uint32_t draw) { return 7 * uniformNoise({seed, 2, 0, draw}); };
    for (std::uint32_t i = 0; i < 4; ++i) {
        Marking line, ring;
        for (std::uint32_t k = 0; k < 3; ++k)
            line.points.push_back({uniform(100 * i + 2 * k), uniform(100 * i + 2 * k + 1)});
        line.closed = i % 2 == 0;
        line.width = 0.3;
        ring.centre = {uniform(100 * i + 50), uniform(100 * i + 51)};
        ring.radius = 0.2 + 0.2 * uniform(100 * i + 52);
        ring.width = 0.2;
        scene.environment.markings.push_back(line);
        scene.environment.markings.push_back(ring);
    }
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
        const char* const teams[] = {"red", "blue", ""};
        scene.robots[i].team = teams[(i + i / 3) % 3];
        scene.robotTypes[scene.robots[i].type].person = i % 7 == 6;
    }
    if (seed % 5 == 0) scene.robots[0].team.clear();
    return Scenario(std::move(parts));
}

}  // namespace mrose
