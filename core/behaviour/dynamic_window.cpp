#include "behaviour/dynamic_window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "behaviour/back_off.h"
#include "behaviour/dice.h"
#include "behaviour/disc_way.h"
#include "behaviour/memory_entries.h"
#include "behaviour/own_belief.h"
#include "behaviour/steering.h"
#include "control/sensor_records.h"
#include "geometry/pose.h"

namespace mrose {
namespace {

struct Driving {
    enum State : std::int64_t { driving, arrived, bumped, backingOff, detouring };
    static constexpr std::array names{"driving", "arrived", "backing from a bump", "backing off", "making a detour"};
};

constexpr double windowAhead = 0.25;  // s, in which velocities are reached, as in the paper
constexpr int speeds = 5, rotations = 11;
constexpr double foreseen = 1;        // s: where a velocity leads in this time is judged
constexpr double leastMargin = 0.05;  // m, beside it however slow it is
constexpr int lanes = 27;             // to either side ...
constexpr double laneStep = std::numbers::pi / 36;
constexpr double ghostStep = 0.4;  // s: things that move may be where they are in so long, and in twice as long ...
constexpr int ghosts = 5;
constexpr double backingShare = 0.4;  // of its speed
constexpr Nanoseconds backingFor = nanosecondsPerSecond;
constexpr double bumpsAhead = 1.9;                          // rad: from bumps farther aside it drives away anyhow
constexpr double nearerBy = 0.2;                            // m, to a waypoint, is progress ...
constexpr Nanoseconds waitsFor = 8 * nanosecondsPerSecond;  // ... for which it waits so long
constexpr Nanoseconds detourLasts = 4 * nanosecondsPerSecond;
constexpr double leastDetour = 0.8;  // rad, away from the waypoint
constexpr double turnAside = 0.6;    // rad, after backing off
constexpr double markedFor = 2;      // s, of the arc that it takes
constexpr int arcPieces = 8;         // of its mark

double reached(double from, double wanted, double most) { return from + std::clamp(wanted - from, -most, most); }

}  // namespace

struct DynamicWindow::Memory {
    MotionMemory motion;
    OwnBelief self;
    BackOff backOff;
    ObstacleMemory obstacles;
    std::int64_t waypoint, state;
    Nanoseconds backingEnd;
    double nearest;         ///< m, that it has been to the waypoint ...
    Nanoseconds nearestAt;  ///< ... when; 0: it has not begun
    double detour;          ///< rad, in the world's frame
    Nanoseconds detourEnd;
};

/// What a command of now has to reckon with, in the robot's frame where it takes effect.
struct DynamicWindow::Surroundings {
    Pose pose;  ///< of that frame in the world's
    Velocity velocity;
    std::array<Point, 3 * ObstacleMemory::capacity> places;
    std::size_t count = 0;

    std::span<const Point> points() const { return std::span(places).first(count); }
};

struct DynamicWindow::Choice {
    Command command;
    double value = -std::numeric_limits<double>::infinity();
    double way = 0;  ///< m, until it would touch something
};

std::size_t DynamicWindow::memorySize() const {
    static_assert(
        sizeof(Memory) == sizeof(MotionMemory) + sizeof(OwnBelief) + sizeof(BackOff) + sizeof(ObstacleMemory) + 7 * 8,
        "no padding");
    return sizeof(Memory);
}

Attention DynamicWindow::attention() const {
    Attention attention = Attention::ofItself();
    for (const ObstacleSensor& sensor : options_.sensors) attention.names.push_back(sensor.name);
    return attention;
}

const Point& DynamicWindow::waypoint(const Memory& memory) const {
    return options_.waypoints[static_cast<std::size_t>(memory.waypoint) % options_.waypoints.size()];
}

DynamicWindow::Surroundings DynamicWindow::surroundings(const Memory& memory) const {
    Surroundings around;
    const Pose moved = memory.motion.motionDuring(options_.deadTime);
    around.pose = memory.self.pose * moved;
    const Command commanded = memory.motion.instants[0].command;
    const Velocity now = memory.motion.instants[0].velocity;
    around.velocity = {reached(now.v, commanded.v, options_.acceleration * options_.deadTime),
                       reached(now.w, commanded.w, options_.turningAcceleration * options_.deadTime)};
    const Placement frame(memory.obstacles.odometry * moved);
    const Nanoseconds then = memory.motion.now() + fromSeconds(options_.deadTime);
    for (const ObstacleMemory::Found& found : memory.obstacles.found()) {
        const Point place{found.x, found.y}, velocity{found.vx, found.vy};
        const double age = toSeconds(then - found.measured);
        const int copies = velocity == Point{} ? 1 : 1 + ghosts;
        for (int i = 0; i < copies && around.count < around.places.size(); ++i)
            around.places[around.count++] = frame.placeBack(place + (age + i * ghostStep) * velocity);
    }
    // The nearest end most ways: with them first, the others need no closer look.
    std::sort(around.places.begin(), around.places.begin() + static_cast<std::ptrdiff_t>(around.count),
              [](const Point& a, const Point& b) { return dot(a, a) < dot(b, b); });
    return around;
}

/// Where a velocity leads in a while if it is kept, and how it is to be valued; infinitely bad where it cannot stop in
/// time. The margin grows with speed, so that narrow ways are open to who is slow.
DynamicWindow::Choice DynamicWindow::valued(const Surroundings& around, const Point& towards, double look,
                                            const Command& command) const {
    Choice choice{command};
    const double margin = leastMargin + command.v / options_.speed * std::max(0.0, options_.margin - leastMargin);
    const double radius = options_.radius + margin;
    choice.way = command.v == 0 ? straightWay(around.points(), mrose::towards(command.w * foreseen), radius, look)
                                : arcWay(around.points(), {command.v, command.w}, radius, look);
    const double braking = command.v * windowAhead + command.v * command.v / (2 * options_.acceleration);
    if (braking > choice.way) return choice;
    const double time = command.v == 0 ? foreseen : std::min(foreseen, choice.way / command.v);
    const Pose there = exp({command.v * time, 0, command.w * foreseen});
    const Point left = towards - position(there);
    const double off = std::abs(wrapAngle(direction(left) - there.heading));
    const double progress = (length(towards) - length(left)) / (options_.speed * foreseen);
    choice.value = options_.headingWeight * (1 - off / std::numbers::pi) +
                   options_.clearanceWeight * choice.way / look + options_.progressWeight * progress;
    return choice;
}

/// The end of the straight lane, `look` long, that is free the farthest, less the farther off it is from where it
/// wants to go (after the Lane-Curvature Method of Ko and Simmons 1998): velocities alone would wait before what is in
/// the way.
Point DynamicWindow::lane(const Surroundings& around, double wanted, double look) const {
    Point best;
    double most = -1;
    for (int i = 0; i <= lanes; ++i)
        for (const int side : {-1, 1}) {
            const Point along = towards(wanted + side * i * laneStep);
            const double free = straightWay(around.points(), along, options_.radius + options_.margin, look);
            const double value = free * (1 + cosine(i * laneStep));
            if (value <= most) continue;
            most = value;
            best = look * along;
        }
    return best;
}

/// Of a grid of the velocities that the robot reaches in a while. Where none of them lets it stop in time it brakes.
DynamicWindow::Choice DynamicWindow::best(const Surroundings& around, const Point& goal) const {
    const double look = std::clamp(length(goal), 0.1, options_.lookAhead);
    const Point target = lane(around, direction(goal), look);
    const double faster = options_.acceleration * windowAhead, turning = options_.turningAcceleration * windowAhead;
    const double least = std::clamp(around.velocity.v - faster, 0.0, options_.speed),
                 most = std::clamp(around.velocity.v + faster, 0.0, options_.speed);
    const double right = std::clamp(around.velocity.w - turning, -options_.rotation, options_.rotation),
                 left = std::clamp(around.velocity.w + turning, -options_.rotation, options_.rotation);
    Choice best;
    for (int i = 0; i < speeds; ++i)
        for (int k = 0; k < rotations; ++k) {
            const Command command{least + (most - least) * i / (speeds - 1),
                                  right + (left - right) * k / (rotations - 1)};
            const Choice choice = valued(around, target, look, command);
            if (choice.value > best.value) best = choice;
        }
    return best;
}

/// No faster than it can stop.
Command DynamicWindow::clearOf(const Surroundings& around, const Command& command) const {
    const double way =
        arcWay(around.points(), {command.v, command.w}, options_.radius + leastMargin, options_.lookAhead);
    const double most = std::sqrt(2 * options_.acceleration * way);
    return {std::clamp(command.v, -most, most), command.w};
}

bool DynamicWindow::noteBump(const Observation& observation, Memory& memory) const {
    for (const ObstacleSensor& sensor : options_.sensors) {
        if (sensor.kind != ObstacleSensor::Kind::bumpers) continue;
        for (const BumperContact& contact : observation.records<BumperContact>(observation.newest(sensor.name)))
            if (contact.pressed != 0 && std::abs(wrapAngle(contact.bearing)) < bumpsAhead)
                memory.backingEnd = observation.time + backingFor;
    }
    return observation.time < memory.backingEnd;
}

/// Who waits too long for a way to open tries another one.
void DynamicWindow::noteProgress(const Observation& observation, const Surroundings& around, Memory& memory) const {
    const double far = distance(position(around.pose), waypoint(memory));
    if (memory.nearestAt == 0 || far < memory.nearest - nearerBy) {
        memory.nearest = far;
        memory.nearestAt = observation.time;
    }
    if (observation.time - memory.nearestAt < waitsFor) return;
    memory.nearest = far;
    memory.nearestAt = observation.time + detourLasts;
    memory.detourEnd = observation.time + detourLasts;
    const double wanted = direction(waypoint(memory) - position(around.pose)) - around.pose.heading;
    Dice dice(observation.noise);
    const double first = dice.between(-std::numbers::pi, std::numbers::pi);
    double farthest = -1;
    for (int i = 0; i < 24; ++i) {
        const double heading = first + i * std::numbers::pi / 12;
        if (std::abs(wrapAngle(heading - wanted)) < leastDetour) continue;
        const double way =
            straightWay(around.points(), towards(heading), options_.radius + leastMargin, options_.lookAhead);
        if (way <= farthest) continue;
        farthest = way;
        memory.detour = wrapAngle(around.pose.heading + heading);
    }
}

/// In the robot's frame; where it makes a detour, not the waypoint.
Point DynamicWindow::destination(const Observation& observation, const Surroundings& around, Memory& memory) const {
    noteProgress(observation, around, memory);
    if (observation.time < memory.detourEnd) return options_.lookAhead * towards(memory.detour - around.pose.heading);
    return Placement(around.pose).placeBack(waypoint(memory));
}

Command DynamicWindow::drive(const Observation& observation, Memory& memory, Decision& decision) const {
    const Surroundings around = surroundings(memory);
    const auto count = static_cast<std::int64_t>(options_.waypoints.size());
    if (distance(position(around.pose), waypoint(memory)) < options_.tolerance &&
        (options_.loop || memory.waypoint + 1 < count)) {
        memory.waypoint = (memory.waypoint + 1) % count;
        memory.nearestAt = 0;
        memory.detourEnd = 0;
    }
    if (decision.wantsAnnotations)
        decision.annotations.push_back(
            {.kind = Annotation::Kind::point, .label = "goal", .points = {waypoint(memory)}});
    const bool bumped = noteBump(observation, memory);
    const BackOff::Options limits{options_.speed, options_.rotation, options_.deadTime, turnAside};
    const std::optional<Command> back = memory.backOff.update(observation, memory.motion, limits);
    memory.state = bumped ? Driving::bumped : back ? Driving::backingOff : Driving::driving;
    if (bumped) return clearOf(around, {-backingShare * options_.speed, 0});
    if (back) return clearOf(around, *back);
    if (distance(position(around.pose), waypoint(memory)) < options_.tolerance) {
        memory.state = Driving::arrived;
        return {};
    }
    const Point goal = destination(observation, around, memory);
    if (observation.time < memory.detourEnd) memory.state = Driving::detouring;
    const Choice choice = best(around, goal);
    markArc(around, choice, decision);
    return choice.command;
}

void DynamicWindow::markArc(const Surroundings& around, const Choice& choice, Decision& decision) const {
    if (!decision.wantsAnnotations) return;
    const auto [v, w] = choice.command;
    const double time = v > 0 ? std::min(choice.way / v, markedFor) : 0;
    Annotation arc{.kind = Annotation::Kind::line, .label = "arc"};
    for (int i = 0; i <= arcPieces; ++i) {
        const double until = time * i / arcPieces;
        arc.points.push_back(position(around.pose * exp({v * until, 0, w * until})));
    }
    decision.annotations.push_back(std::move(arc));
    decision.annotations.push_back({.label = "clear way (m)", .value = choice.way});
}

void DynamicWindow::explain(std::span<const std::byte> bytes, MemoryEntries& entries) const {
    const Memory& memory = as<Memory>(bytes);
    const Nanoseconds now = memory.motion.now();
    entries.add("state", Driving::names[static_cast<std::size_t>(memory.state) % Driving::names.size()]);
    entries.add("waypoint number", static_cast<double>(memory.waypoint + 1));
    if (!options_.waypoints.empty()) {
        entries.add("waypoint x", waypoint(memory).x, "m");
        entries.add("waypoint y", waypoint(memory).y, "m");
    }
    entries.add("obstacle points", static_cast<double>(memory.obstacles.count));
    entries.add("detour heading", memory.detour, "rad");
    entries.add("detour lasts for", toSeconds(std::max<Nanoseconds>(0, memory.detourEnd - now)), "s");
    explainSelf(memory.self, now, entries);
    explainBackOff(memory.backOff, now, entries);
}

void DynamicWindow::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    memory.motion.observe(observation);
    memory.self.update(observation, memory.motion);
    memory.obstacles.update(observation, memory.motion, options_.sensors,
                            {options_.radius + options_.margin + options_.lookAhead, options_.memory});
    decision.command = Command{};
    if (memory.self.known != 0 && !options_.waypoints.empty()) decision.command = drive(observation, memory, decision);
    memory.motion.issue(*decision.command);
}

}  // namespace mrose
