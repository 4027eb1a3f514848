// Quality of contact, in figures: how deep bodies overlap, what drifts, what energy and momentum err by, and what a
// tick costs. Overlaps are of true shapes, in millimetres; times are processor time.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/contact_scenes.h"
#include "bench/plain_box2d.h"
#include "bench/timing.h"
#include "simulation/step.h"
#include "support/contact_measures.h"
#include "support/scenes.h"

namespace mrose::bench {
namespace {

constexpr int ticksPerSecond = 50;

/// Depths of pairs that touch, in mm: worst, and mean over ticks and pairs.
struct Overlaps {
    double worst = 0, sum = 0;
    long count = 0;

    void add(double gap) {
        const double depth = 1000 * std::max(0.0, -gap);
        worst = std::max(worst, depth);
        sum += depth;
        ++count;
    }
    double mean() const { return count == 0 ? 0 : sum / static_cast<double>(count); }
};

/// By kind of pair.
struct SceneOverlaps {
    Overlaps bodies, walls;
    double contacts = 0;  ///< in a tick, in the mean
};

void addTick(const Scenario& scenario, const WorldState& state, const StepTrace& trace, SceneOverlaps& overlaps) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> reported;
    for (const ContactReport& c : trace.contacts)
        reported[{std::min(c.bodyA, c.bodyB), std::max(c.bodyA, c.bodyB)}] = true;
    const auto bodies = static_cast<std::uint32_t>(scenario.scene().bodyCount());
    for (std::uint32_t a = 0; a < bodies; ++a) {
        const double wall = gapToObstacles(scenario, state, a);
        if (wall < 0 || reported.contains({a, noBody})) overlaps.walls.add(wall);
        for (std::uint32_t b = a + 1; b < bodies; ++b) {
            const double gap = gapBetween(scenario, state, a, b);
            if (gap < 0 || reported.contains({a, b})) overlaps.bodies.add(gap);
        }
    }
}

SceneOverlaps overlapsOf(const Scenario& scenario, int seconds, std::uint64_t starts = 1) {
    SceneOverlaps overlaps;
    StepBuffers buffers;
    StepTrace trace;
    long ticks = 0;
    for (std::uint64_t seed = 1; seed <= starts; ++seed) {
        WorldState state = scenario.initialState(seed);
        for (int k = 0; k < seconds * ticksPerSecond; ++k, ++ticks) {
            step(scenario, state, buffers, {}, &trace);
            overlaps.contacts += static_cast<double>(trace.contacts.size());
            addTick(scenario, state, trace, overlaps);
        }
    }
    overlaps.contacts /= static_cast<double>(ticks);
    return overlaps;
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Of each tick from each of the starts, us: the median of rounds.
double costOfTick(const Scenario& scenario, int seconds, std::uint64_t starts = 1) {
    std::vector<double> rounds;
    StepBuffers buffers;
    for (int round = 0; round < 5; ++round) {
        const double before = processorSeconds();
        for (std::uint64_t seed = 1; seed <= starts; ++seed) {
            WorldState state = scenario.initialState(seed);
            for (int k = 0; k < seconds * ticksPerSecond; ++k) step(scenario, state, buffers);
        }
        const double ticks = static_cast<double>(seconds * ticksPerSecond) * static_cast<double>(starts);
        rounds.push_back(1e6 * (processorSeconds() - before) / ticks);
    }
    return median(rounds);
}

/// Of a simulated second of plain Box2D in the scene of S1 heavy, us.
double costOfPeer(int seconds, std::uint64_t starts) {
    std::vector<double> rounds;
    for (int round = 0; round < 5; ++round) {
        std::vector<PlainBox2d> worlds;
        for (std::uint64_t seed = 1; seed <= starts; ++seed) worlds.emplace_back(8, true, seed);
        const double before = processorSeconds();
        for (PlainBox2d& world : worlds)
            for (int i = 0; i < 10 * seconds; ++i) world.run();
        rounds.push_back(1e6 * (processorSeconds() - before) / (static_cast<double>(starts) * seconds));
    }
    return median(rounds);
}

void line(const char* scene, const char* figure, double value, const char* unit) {
    std::printf("%-38s %-38s %12.4g %s\n", scene, figure, value, unit);
}

void printOverlaps(const char* scene, const SceneOverlaps& overlaps) {
    line(scene, "contacts a tick", overlaps.contacts, "");
    line(scene, "worst overlap of bodies", overlaps.bodies.worst, "mm");
    line(scene, "mean overlap of bodies", overlaps.bodies.mean(), "mm");
    line(scene, "worst overlap with walls", overlaps.walls.worst, "mm");
    line(scene, "mean overlap with walls", overlaps.walls.mean(), "mm");
}

void heavy() {
    const char* scene = "S1 heavy, 5 starts, 60 s each";
    const Scenario scenario = fieldScenario({});
    printOverlaps(scene, overlapsOf(scenario, 60, 5));
    const double ours = costOfTick(scenario, 20, 5), peer = costOfPeer(20, 5);
    line(scene, "time a tick", ours, "us");
    line(scene, "speed, of plain Box2D's", peer / (ours * ticksPerSecond), "");
}

void crowd(const char* scene, const Scenario& scenario, int seconds) {
    printOverlaps(scene, overlapsOf(scenario, seconds));
    line(scene, "time a tick", costOfTick(scenario, seconds), "us");
}

/// What becomes of the ball: still between the robots, gone sideways, or through one of them.
const char* endOf(const Scenario& scenario, const WorldState& state, bool through) {
    if (through) return "through a robot";
    const Point ball = position(state.objects[0].pose);
    const double side = scenario.scene().shapeOf(0).reach;
    const bool between = state.robots[0].pose.x < ball.x && ball.x < state.robots[1].pose.x;
    return between && std::abs(ball.y - state.robots[0].pose.y) < side ? "stays between" : "slips out aside";
}

void pressed(double speed) {
    const Scenario scenario = pressedBall(speed);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    double deepest = 0;
    bool through = false;
    for (int k = 0; k < 10 * ticksPerSecond; ++k) {
        step(scenario, state, buffers);
        deepest = std::max(deepest, -leastGap(scenario, state, 2));
        for (const RobotState& robot : state.robots) {
            const Point seen = Placement(robot.pose).placeBack(position(state.objects[0].pose));
            through = through || depthOfPoint(scenario.scene().shapeOf(0), seen) > 0;
        }
    }
    char scene[60];
    std::snprintf(scene, sizeof scene, "ball between robots at %g m/s, 10 s", speed);
    line(scene, "deepest overlap of the ball", 1000 * deepest, "mm");
    std::printf("%-38s the ball %s\n", scene, endOf(scenario, state, through));
    line(scene, "time a tick", costOfTick(scenario, 10), "us");
}

void elastic() {
    const char* scene = "elastic ball between walls, 10^6 ticks";
    const Scenario scenario = elasticBall();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    const double before = movedBy(scenario, state).energy;
    double worst = 0;
    for (int k = 0; k < 1'000'000; ++k) {
        step(scenario, state, buffers);
        worst = std::max(worst, std::abs(movedBy(scenario, state).energy / before - 1));
    }
    line(scene, "energy error at the end, relative", movedBy(scenario, state).energy / before - 1, "");
    line(scene, "energy error, worst", worst, "");
    line(scene, "time a tick", costOfTick(scenario, 100), "us");
}

/// How far a box moves and turns in an hour after ten seconds.
void drift(const char* scene, bool isPressed) {
    const Scenario scenario = boxAtWall(isPressed);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int k = 0; k < 10 * ticksPerSecond; ++k) step(scenario, state, buffers);
    const Pose start = state.objects[0].pose;
    double way = 0, turn = 0, deepest = 0;
    for (int k = 0; k < 3600 * ticksPerSecond; ++k) {
        step(scenario, state, buffers);
        const Pose& pose = state.objects[0].pose;
        way = std::max(way, distance(position(start), position(pose)));
        turn = std::max(turn, std::abs(pose.heading - start.heading));
        if (k % 50 == 0) deepest = std::max(deepest, -leastGap(scenario, state));
    }
    line(scene, "farthest from where it was after 10 s", 1000 * way, "mm");
    line(scene, "turned farthest", 1000 * turn, "mrad");
    line(scene, "deepest overlap", 1000 * deepest, "mm");
    line(scene, "time a tick", costOfTick(scenario, 60), "us");
}

void momentum(const char* scene, double restitution) {
    double linear = 0, angular = 0, gain = -1, loss = 0;
    for (std::int64_t number = 0; number < 200; ++number) {
        const Scenario scenario = openCollision(number, restitution);
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        const Moved before = movedBy(scenario, state);
        for (int k = 0; k < 60; ++k) step(scenario, state, buffers);
        const Moved after = movedBy(scenario, state);
        const double scale = std::sqrt(2 * before.energy * scenario.contactType(0).mass);
        linear = std::max(linear, length(after.momentum - before.momentum) / scale);
        angular = std::max(angular, std::abs(after.angular - before.angular) / scale);
        gain = std::max(gain, after.energy / before.energy - 1);
        loss = std::max(loss, 1 - after.energy / before.energy);
    }
    line(scene, "momentum error, worst, relative", linear, "");
    line(scene, "angular momentum error, worst", angular, "per m");
    line(scene, "energy gained at most, relative", gain, "");
    line(scene, "energy lost at most, relative", loss, "");
}

void floorForms() {
    StepBuffers buffers;
    const Scenario rolling = lonelyBall(2, 0.3, 0.4), slipping = lonelyBall(3, 0.2, 0);
    WorldState state = rolling.initialState();
    for (int k = 0; k < 6 * ticksPerSecond; ++k) step(rolling, state, buffers);
    line("roll-out from 2 m/s", "error of the way against v2 / 2a", 1000 * (state.objects[0].pose.x - 2 * 2 / 0.8),
         "mm");
    state = slipping.initialState();
    state.objects[0].roll_W = {};
    for (int k = 0; k < 3 * ticksPerSecond; ++k) step(slipping, state, buffers);
    const double rolls = 3 / (1 + slipping.scene().typeOfObject(0).inertia);
    line("slip to roll from 3 m/s", "error of the speed, relative", state.objects[0].velocity_W.x / rolls - 1, "");
}

/// Speed and place after a bounce, against the event in closed form.
void bounce(const Twist& thrown, double friction) {
    constexpr double restitution = 0.6, way = 4 - 0.11 - 3;
    const Scenario scenario = thrownBall(thrown, friction, restitution);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    const int ticks = static_cast<int>(way / thrown.x * ticksPerSecond) + 5;
    for (int k = 0; k < ticks; ++k) step(scenario, state, buffers);
    const double hit = way / thrown.x, left = static_cast<double>(ticks) / ticksPerSecond - hit;
    const Point after{-restitution * thrown.x, thrown.y - friction * (1 + restitution) * thrown.x};
    const Point place{4 - 0.11 + left * after.x, 20 + hit * thrown.y + left * after.y};
    const Twist& v = state.objects[0].velocity_W;
    char scene[60];
    std::snprintf(scene, sizeof scene, "bounce at %g, %g m/s", thrown.x, thrown.y);
    line(scene, "error of the velocity, relative", length(Point{v.x, v.y} - after) / length(after), "");
    line(scene, "error of the place", 1000 * distance(position(state.objects[0].pose), place), "mm");
}

}  // namespace
}  // namespace mrose::bench

int main(int argc, char** argv) {
    using namespace mrose::bench;
    const std::string only = argc > 1 ? argv[1] : "";
    const auto wanted = [&](const char* name) { return only.empty() || only == name; };
    if (wanted("heavy")) heavy();
    if (wanted("corner")) crowd("12 robots into a corner, 10 s", corneredRobots(), 10);
    if (wanted("pile")) crowd("20 boxes and 6 robots, corner, 20 s", boxPile(), 20);
    if (wanted("pressed"))
        for (const double speed : {0.3, 1.0, 2.0}) pressed(speed);
    if (wanted("elastic")) elastic();
    if (wanted("drift")) {
        drift("box pressed at a wall, an hour", true);
        drift("box left at a wall, an hour", false);
    }
    if (wanted("momentum")) {
        momentum("open collisions, elastic and smooth", 1);
        momentum("open collisions, inelastic and rough", 0);
    }
    if (wanted("forms")) {
        floorForms();
        bounce({2, 0, 0}, 0);
        bounce({12, 0, 0}, 0);
        bounce({3, 5, 0}, 0.2);
        bounce({9, 15, 0}, 0.2);
    }
    return 0;
}
