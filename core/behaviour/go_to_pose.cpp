#include "behaviour/go_to_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "behaviour/arrival.h"
#include "behaviour/back_off.h"
#include "behaviour/memory_entries.h"
#include "behaviour/own_belief.h"
#include "behaviour/pushing_way.h"
#include "behaviour/steering.h"
#include "geometry/point.h"

namespace mrose {
namespace {

constexpr double turnAwayFromGoal = 0.6;  // rad, after backing off
constexpr double spareWay = 0.06;         // m, to walls and bodies
constexpr double leastSpare = 0.01;       // m, likewise: as little as it may become
constexpr double lookFor = 1;             // s, ahead for walls and bodies, at full speed ...
constexpr double lookMore = 0.3;          // m, ... and so much farther
constexpr double detourFor = 0.8;         // s, after it has turned

}  // namespace

struct GoToPose::Memory {
    MotionMemory motion;
    OwnBelief self;
    BackOff backOff;
    std::int64_t target;
    Arrival arrival;
    double detour;  ///< rad, in the world's frame
    Nanoseconds detourEnd;
};

std::size_t GoToPose::memorySize() const {
    static_assert(
        sizeof(Memory) == sizeof(MotionMemory) + sizeof(OwnBelief) + sizeof(BackOff) + sizeof(Arrival) + 3 * 8,
        "no padding");
    return sizeof(Memory);
}

const Pose& GoToPose::target(const Memory& memory) const {
    return options_.targets[static_cast<std::size_t>(memory.target)];
}

/// Who and what is seen, as circles as large as the robot itself.
FloorPlan GoToPose::bodiesSeen(const Observation& observation, const Memory& memory) const {
    std::vector<ConvexPiece> pieces;
    for (const bool objects : {false, true})
        for (const SeenBody& seen : objects ? observation.objects() : observation.robots()) {
            if (objects && options_.ball && seen.index == 0) continue;
            const Placement then(memory.self.at(seen.measured, memory.motion));
            pieces.push_back(ConvexPiece::circle(then.place(seen.position_B), options_.radius));
        }
    return FloorPlan(std::move(pieces));
}

/// Where the way ahead is not free, or that to the target, towards what is, the slower the shorter the way ahead; away
/// from walls that are too near.
Command GoToPose::approach(const Observation& observation, const Pose& ahead, Memory& memory) const {
    const DriveLimits limits{options_.speed, options_.rotation};
    const Point place = position(ahead), line = position(target(memory)) - place;
    const FloorPlan bodies = bodiesSeen(observation, memory);
    const double look = std::min(lookMore + lookFor * options_.speed, length(line)), room = options_.radius + spareWay;
    const auto freeWay = [&](double heading, double radius) {
        const Point way = Placement({0, 0, heading}).rotate({1, 0});
        return std::min(options_.walls->freeWay(place, way, radius, look), bodies.freeWay(place, way, radius, look));
    };
    const bool tailFirst = memory.arrival.tailFirst != 0;
    const double facing = ahead.heading + (tailFirst ? std::numbers::pi : 0),
                 wanted = observation.time < memory.detourEnd ? memory.detour : direction(line);
    const double heading = clearHeading(wanted, look, [&](double way) { return freeWay(way, room); });
    // What it turns away from it may see no more: it keeps to its way round for a while.
    if (heading != wanted) {
        memory.detour = heading;
        const double lasts = detourFor + std::abs(wrapAngle(heading - facing)) / std::max(0.05, options_.rotation);
        if (observation.time >= memory.detourEnd) memory.detourEnd = observation.time + fromSeconds(lasts);
    }
    const bool direct = heading == wanted && observation.time >= memory.detourEnd;
    const double onwards = freeWay(facing, options_.radius + leastSpare);
    const Point off = clearOf(options_.walls->wallsNear(place, room), place, room) - place;
    if (direct && onwards >= look && off == Point{}) return driveToPose(ahead, target(memory), limits, tailFirst);
    const Point towards = Placement({0, 0, heading}).rotate({1, 0}) + (1 / spareWay) * off;
    const Command round = driveTowards(Placement({0, 0, facing}).rotateBack(towards), limits);
    const double v = round.v * std::min(1.0, onwards / look);
    return {tailFirst ? -v : v, round.w};
}

Command GoToPose::drive(const Observation& observation, Memory& memory) const {
    if (const std::optional<Command> back = memory.backOff.update(
            observation, memory.motion, {options_.speed, options_.rotation, options_.deadTime, turnAwayFromGoal})) {
        memory.arrival.phase = Arrival::backingOff;
        return *back;
    }
    const Pose ahead = memory.self.pose * memory.motion.motionDuring(options_.deadTime);
    memory.arrival.update(ahead, target(memory), memory.self,
                          {options_.tolerance, options_.headingTolerance, options_.backwards});
    if (memory.arrival.phase == Arrival::resting) {
        const auto count = static_cast<std::int64_t>(options_.targets.size());
        if (standsStill(observation.velocity()) && (options_.loop || memory.target + 1 < count)) {
            memory.target = (memory.target + 1) % count;
            memory.arrival.phase = Arrival::approaching;
        }
        return {};
    }
    if (memory.arrival.phase == Arrival::aligning) return turnTo(target(memory).heading, ahead, options_.rotation);
    return approach(observation, ahead, memory);
}

void GoToPose::annotate(const Memory& memory, Decision& decision) const {
    if (!decision.wantsAnnotations) return;
    const Point goal = position(target(memory));
    decision.annotations.push_back({.kind = Annotation::Kind::point, .label = "goal", .points = {goal}});
    decision.annotations.push_back({.label = "distance (m)", .value = distance(position(memory.self.pose), goal)});
    decision.annotations.push_back({.kind = Annotation::Kind::text,
                                    .label = "state",
                                    .text = Arrival::names[static_cast<std::size_t>(memory.arrival.phase)]});
}

void GoToPose::explain(std::span<const std::byte> bytes, MemoryEntries& entries) const {
    const Memory& memory = as<Memory>(bytes);
    const Nanoseconds now = memory.motion.now();
    entries.add("state", Arrival::names[static_cast<std::size_t>(memory.arrival.phase)]);
    entries.add("target number", static_cast<double>(memory.target + 1));
    if (!options_.targets.empty()) {
        entries.add("target x", target(memory).x, "m");
        entries.add("target y", target(memory).y, "m");
        entries.add("target heading", target(memory).heading, "rad");
    }
    entries.add("drives", memory.arrival.tailFirst != 0 ? "tail first" : "forwards");
    entries.add("detour heading", memory.detour, "rad");
    entries.add("detour lasts for", toSeconds(std::max<Nanoseconds>(0, memory.detourEnd - now)), "s");
    explainSelf(memory.self, now, entries);
    explainBackOff(memory.backOff, now, entries);
}

void GoToPose::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    memory.motion.observe(observation);
    memory.self.update(observation, memory.motion);
    decision.command = Command{};
    if (memory.self.known != 0 && !options_.targets.empty()) {
        decision.command = drive(observation, memory);
        annotate(memory, decision);
    }
    memory.motion.issue(*decision.command);
}

}  // namespace mrose
