#include "behaviour/dynamic_window.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"
#include "scenario/obstacle_sensors.h"
#include "sensing/bumpers.h"
#include "sensing/infrared_ring.h"
#include "sensing/laser.h"
#include "sensing/ranging.h"
#include "sensing/sonar_ring.h"

namespace mrose {
namespace {

using std::numbers::pi;

constexpr double bodyRadius = 0.25;  // m

SensorPointer frontLaser() {
    Laser::Options options;
    options.first = -pi / 2;
    options.step = pi / 180;
    options.beams = 181;
    options.errors = {.noise = 0.01, .range = 8};
    return std::make_shared<const Laser>(SensorTraits{"scan", 100'000'000}, options);
}

std::vector<Pose> outward(int count) {
    std::vector<Pose> ring;
    for (int i = 0; i < count; ++i) {
        const double heading = 2 * pi * (i + 0.5) / count;
        const Point at = bodyRadius * towards(heading);
        ring.push_back({at.x, at.y, heading});
    }
    return ring;
}

SensorPointer sonars() {
    SonarRing::Options options;
    options.sonars = outward(24);
    options.cone = pi / 6;
    options.reflection = pi / 2;
    options.errors = {.noise = 0.01, .range = 3};
    return std::make_shared<const SonarRing>(SensorTraits{"sound", 200'000'000}, options);
}

SensorPointer infrared() {
    InfraredRing::Options options{outward(24), pi / 18, 0.8, 0.1, 0.02, 0.005};
    return std::make_shared<const InfraredRing>(SensorTraits{"light", 100'000'000}, options);
}

SensorPointer bumpers() {
    std::vector<Bumpers::Segment> segments;
    for (int i = 0; i < 12; ++i) segments.push_back({pi * i / 6, pi / 6});
    return std::make_shared<const Bumpers>(SensorTraits{"skin", 0}, segments);
}

RobotType robotWith(std::vector<SensorPointer> sensors) {
    RobotType type = discRobot(bodyRadius, 60);
    type.sensors = std::move(sensors);
    return type;
}

std::shared_ptr<const MotionModel> drive() {
    KinematicParameters parameters;
    parameters.v = {.deadTime = 0.1, .lag = 0.1, .limit = 0.8, .acceleration = 0.5};
    parameters.w = {.deadTime = 0.1, .lag = 0.1, .limit = 1, .acceleration = 2};
    return std::make_shared<const KinematicModel>(parameters);
}

std::shared_ptr<const Controller> along(std::vector<Point> waypoints, const RobotType& type, bool loop = false) {
    return std::make_shared<const DynamicWindow>(DynamicWindow::Options{.waypoints = std::move(waypoints),
                                                                        .loop = loop,
                                                                        .tolerance = 0.2,
                                                                        .radius = bodyRadius,
                                                                        .deadTime = 0.1,
                                                                        .sensors = obstacleSensors(type)});
}

/// A hall of 8 x 6 m with so many columns, a metre apart and away from its walls.
Environment hall(std::uint64_t seed, int columns) {
    Environment environment = walledField(8, 6);
    std::vector<Point> places;
    for (std::int64_t i = 0; static_cast<int>(places.size()) < columns; ++i) {
        const Point place{draw(seed, i, 0, 1.7, 6.3), draw(seed, i, 1, 0.9, 5.1)};
        const auto near = [&](const Point& other) { return distance(place, other) < 1.2; };
        if (std::any_of(places.begin(), places.end(), near)) continue;
        places.push_back(place);
        ShapePart column;
        column.centre = place;
        column.radius = 0.15;
        environment.obstacles.push_back({"column", Shape::fromParts("column", {column}), {}});
    }
    return environment;
}

struct Walk {
    bool arrived = false;
    int touching = 0;  ///< ticks
};

Walk walkTo(const Point& goal, const Scenario& scenario, std::uint64_t seed, int seconds) {
    WorldState state = scenario.initialState(seed);
    StepBuffers buffers;
    StepTrace trace;
    Walk walk;
    for (int tick = 0; tick < seconds * ticksPerSecond && !walk.arrived; ++tick) {
        step(scenario, state, buffers, {}, &trace);
        walk.touching += trace.contacts.empty() ? 0 : 1;
        walk.arrived = distance(position(state.robots[0].pose), goal) < 0.25;
    }
    return walk;
}

/// Arrivals and runs with touches of forty halls with six columns.
std::pair<int, int> acrossHalls(const std::vector<SensorPointer>& sensors) {
    const RobotType type = robotWith(sensors);
    int arrived = 0, touched = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Point goal{7.2, draw(seed, 7, 3, 1, 5)};
        const Scenario scenario = SmallWorld(hall(seed, 6))
                                      .robot(type, {0.7, draw(seed, 8, 3, 1, 5), draw(seed, 9, 3, -pi, pi)},
                                             along({goal}, type), withNoise(drive(), {0.03, 0.03, 0.02}))
                                      .scenario();
        const Walk walk = walkTo(goal, scenario, seed, 60);
        arrived += walk.arrived ? 1 : 0;
        touched += walk.touching > 0 ? 1 : 0;
    }
    return {arrived, touched};
}

TEST(DynamicWindow, FindsItsWayAmongColumnsByALaserAlone) {
    const auto [arrived, touched] = acrossHalls({frontLaser()});
    EXPECT_EQ(arrived, 40);
    EXPECT_EQ(touched, 0);
}

TEST(DynamicWindow, FindsItsWayAmongColumnsBySonarsAlone) {
    const auto [arrived, touched] = acrossHalls({sonars()});
    EXPECT_GE(arrived, 36);
    EXPECT_LE(touched, 2);
}

TEST(DynamicWindow, FindsItsWayAmongColumnsByInfraredAlone) {
    const auto [arrived, touched] = acrossHalls({infrared()});
    EXPECT_GE(arrived, 38);
    EXPECT_LE(touched, 8);
}

TEST(DynamicWindow, FindsItsWayAmongColumnsByAllOfThem) {
    const auto [arrived, touched] = acrossHalls({frontLaser(), sonars(), infrared(), bumpers()});
    EXPECT_EQ(arrived, 40);
    EXPECT_EQ(touched, 0);
}

/// Straight for a wall at full speed, with its waypoint behind it.
TEST(DynamicWindow, StopsBeforeAWall) {
    for (const SensorPointer& sensor : {frontLaser(), sonars(), infrared()}) {
        const RobotType type = robotWith({sensor});
        const Scenario scenario = SmallWorld(wallAhead(4)).robot(type, {}, along({{9, 0}}, type), drive()).scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        double farthest = 0;
        for (int tick = 0; tick < 15 * ticksPerSecond; ++tick) {
            step(scenario, state, buffers, {}, &trace);
            EXPECT_TRUE(trace.contacts.empty());
            farthest = std::max(farthest, state.robots[0].pose.x);
        }
        EXPECT_GT(farthest, 2) << sensor->name();
    }
}

/// What its only other sensor does not see it notices by its bumpers: it backs off, and goes round it.
TEST(DynamicWindow, BacksFromWhatItBumpsInto) {
    Laser::Options rear;
    rear.first = pi - 0.5;
    rear.step = 0.1;
    rear.beams = 11;
    rear.errors.range = 4;
    const RobotType type =
        robotWith({std::make_shared<const Laser>(SensorTraits{"rear", 100'000'000}, rear), bumpers()});
    const Scenario scenario =
        SmallWorld(wallAhead(2, 0.5)).robot(type, {0, 0.05, 0}, along({{5, 0}}, type), drive()).scenario();
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Walk walk = walkTo({5, 0}, scenario, seed, 90);
        EXPECT_TRUE(walk.arrived) << seed;
        EXPECT_GT(walk.touching, 0) << seed;
        EXPECT_LT(walk.touching, 5 * ticksPerSecond) << seed;
    }
}

TEST(DynamicWindow, VisitsItsWaypointsInOrderAndStaysAtTheLast) {
    const RobotType type = robotWith({frontLaser()});
    const std::vector<Point> waypoints{{3, 1}, {5, 4}, {2, 3}};
    for (const bool loop : {false, true}) {
        const Scenario scenario =
            SmallWorld(walledField(7, 5)).robot(type, {1, 1, 0}, along(waypoints, type, loop), drive()).scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        std::vector<std::size_t> visited;
        for (int tick = 0; tick < 90 * ticksPerSecond; ++tick) {
            step(scenario, state, buffers);
            for (std::size_t i = 0; i < waypoints.size(); ++i)
                if (distance(position(state.robots[0].pose), waypoints[i]) < 0.2 &&
                    (visited.empty() || visited.back() != i))
                    visited.push_back(i);
        }
        const std::vector<std::size_t> once{0, 1, 2}, again{0, 1, 2, 0, 1, 2};
        ASSERT_GE(visited.size(), loop ? 6u : 3u);
        visited.resize(loop ? 6 : visited.size());
        EXPECT_EQ(visited, loop ? again : once);
        if (!loop) {
            EXPECT_NEAR(state.robots[0].velocity_B.x, 0, 1e-3);
        }
    }
}

/// Somebody walks across its way, at a distance at which standing still alone would do: no touch.
TEST(DynamicWindow, LetsPassWhoCrossesItsWay) {
    for (int i = 0; i < 20; ++i) {
        const RobotType type = robotWith({frontLaser()});
        const Scenario scenario = SmallWorld()
                                      .robot(type, {}, along({{8, 0}}, type), drive())
                                      .robot(discRobot(0.2, 70), {3, -4 + 0.1 * i, pi / 2},
                                             std::make_shared<const Told>(Command{0.8, 0}), ideal())
                                      .scenario();
        const Walk walk = walkTo({8, 0}, scenario, 1, 60);
        EXPECT_TRUE(walk.arrived) << i;
        EXPECT_EQ(walk.touching, 0) << i;
    }
}

TEST(DynamicWindow, ReadsItsOwnMotionAndItsSensorsAlone) {
    const RobotType type = robotWith({bumpers(), sonars(), frontLaser()});
    const Attention attention = along({{1, 1}}, type)->attention();
    for (const char* name : {"self", "odometry", "scan", "sound", "skin"}) EXPECT_TRUE(attention.reads(name)) << name;
    for (const char* name : {"robots", "objects", "messages"}) EXPECT_FALSE(attention.reads(name)) << name;
}

TEST(DynamicWindow, FromEveryTickItGoesOnToTheSameBits) {
    const RobotType type = robotWith({frontLaser(), sonars(), infrared(), bumpers()});
    const Scenario scenario =
        SmallWorld(hall(3, 6))
            .robot(type, {0.7, 3, 0}, along({{7.2, 3}, {0.8, 2}}, type, true), noisyDrive())
            .robot(discRobot(0.2, 70), {4, 0.5, pi / 2}, std::make_shared<const RandomCommands>(0.2, 0.8, 1.5), ideal())
            .scenario();
    expectSameFromEveryTick(scenario, 1500);
}

TEST(DynamicWindow, MarksItsGoalAndTheArcThatItTakes) {
    const RobotType type = robotWith({frontLaser()});
    const Scenario scenario =
        SmallWorld(walledField(8, 6)).robot(type, {1, 3, 0}, along({{7, 3}}, type), drive()).scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    int marked = 0;
    for (int tick = 0; tick < 5 * ticksPerSecond; ++tick) {
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].decided) continue;
        const Decision& decision = trace.robots[0].decision;
        for (const Annotation& note : decision.annotations) {
            if (note.label == "goal") {
                EXPECT_EQ(note.points.at(0), (Point{7, 3}));
            }
            if (note.label != "arc") continue;
            ++marked;
            double length = 0;
            for (std::size_t i = 1; i < note.points.size(); ++i) length += distance(note.points[i - 1], note.points[i]);
            EXPECT_NEAR(length, std::min(2 * decision.command->v, 2.5), 0.02);
        }
    }
    EXPECT_GT(marked, 40);
    const auto entries = explained(scenario.controller(0), scenario.memoryOf(std::as_const(state), 0));
    EXPECT_EQ(entries.at(0).text, "driving");
}

}  // namespace
}  // namespace mrose
