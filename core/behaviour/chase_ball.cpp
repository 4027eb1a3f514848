#include "behaviour/chase_ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "behaviour/dice.h"
#include "behaviour/memory_entries.h"
#include "behaviour/steering.h"
#include "geometry/point.h"

namespace mrose {
namespace {

constexpr std::array phaseNames{"searching",
                                "roaming",
                                "going behind the ball",
                                "pushing",
                                "straight on",
                                "backing off",
                                "sweeping out of a corner",
                                "waiting",
                                "striking it off the wall",
                                "sweeping out of a jam"};

constexpr double wayRound = 0.25;                        // m, between robot and ball on the way behind it
constexpr double stepRound = 1;                          // rad, how far round the ball it aims at most
constexpr double lookAhead = 0.4;                        // m, along the line to the target
constexpr double beginPushing = 0.85, endPushing = 0.6;  // cosine of the angle off that line
constexpr double wallsWithin = 1;                        // m, of the ball: those that count
constexpr double roomBehind = 0.05, roomBeside = 0.02;   // m, behind the ball and beside the robot
constexpr double searchShare = 0.7;                      // of the rotation rate
constexpr double turnAway = 0.6;                         // rad, after backing off
constexpr double straightFor = 3;                        // s, after it got stuck with the ball
constexpr double sweepFor = 1.5, sweepShare = 0.5;       // s; of the speed: in a corner
constexpr double jammedAfter = 0.2, jamSweepFor = 0.8;   // s, at full speed
constexpr double aloneWithin = 2.5;                      // m, from the ball: nobody else, where it takes a stand
constexpr double rollsAlong = 0.25;                      // m/s: a ball that it lets roll
constexpr double sweepReach = 0.06;                      // m, between front and ball
constexpr double crowd = 0.7;                            // m, from the ball: of robots that are at it
constexpr double waitAt = 1.6, waitWithin = 0.3;         // m, from the ball, and how exactly
constexpr double waitAside = 0.7;                        // of 1
constexpr double lookRound = 1.5, stopWithin = 0.4;      // m, ahead
constexpr double bodyRadius = 0.28;                      // m, that others take up
constexpr double contested = 0.55;                       // m, from the ball: who is there is not driven round
constexpr double kickEvery = 1;                          // s
constexpr double kickWidth = 0.09, kickReach = 0.05;     // m, beside and before its front
constexpr double kickAngle = 0.5, kickMiss = 0.85;       // rad; m, beside the target

Point unit(const Point& vector) { return (1 / std::max(1e-9, length(vector))) * vector; }

bool isAnyWithin(double far, const Point& place, std::span<const Point> others) {
    return std::ranges::any_of(others, [&](const Point& body) { return distance(body, place) < far; });
}

}  // namespace

const char* ChaseBall::name(std::int64_t phase) { return phaseNames[static_cast<std::size_t>(phase)]; }

std::size_t ChaseBall::memorySize() const {
    static_assert(
        sizeof(Memory) == sizeof(MotionMemory) + sizeof(OwnBelief) + sizeof(BackOff) + sizeof(BallBelief) + 6 * 8,
        "no padding");
    return sizeof(Memory) + (options_.stroke ? sizeof(WallStroke) : 0);
}

DriveLimits ChaseBall::limits() const { return {options_.speed, options_.rotation}; }

BallFloor ChaseBall::floor() const { return {options_.walls.get(), options_.ballRadius}; }

/// Turns once round and a little more, then goes somewhere else to look.
Command ChaseBall::search(const Observation& observation, Memory& memory) const {
    const bool begins = memory.phase != searching && memory.phase != roaming;
    if (begins || observation.time >= memory.phaseEnd) {
        Dice dice(observation.noise);
        memory.phase = begins || memory.phase == roaming ? searching : roaming;
        const double wholeTurn = 2 * std::numbers::pi / (searchShare * std::max(0.05, options_.rotation));
        const double lasts = memory.phase == searching ? dice.between(1.1, 1.5) * wholeTurn : dice.between(1.5, 3);
        memory.phaseEnd = observation.time + fromSeconds(lasts);
        memory.turn = Placement(memory.self.pose).placeBack(memory.ball.position).y < 0 ? -1 : 1;
    }
    if (memory.phase == searching) return {0, memory.turn * searchShare * options_.rotation};
    return evading({options_.speed, 0}, evade(observation.robots(), memory.motion, options_.deadTime), limits());
}

ChaseBall::Situation ChaseBall::situation(const Memory& memory) const {
    Situation now;
    now.robot = memory.self.pose * memory.motion.motionDuring(options_.deadTime);
    now.ball = memory.ball.after(options_.deadTime, floor()).position;
    now.walls = options_.walls->wallsNear(now.ball, wallsWithin);
    now.way = pushingWay(
        now.ball, unit(options_.target - now.ball), now.walls,
        {options_.front + options_.ballRadius + roomBehind, options_.halfWidth + roomBeside, options_.ballRadius});
    return now;
}

Point ChaseBall::aim(const Situation& now, Memory& memory) const {
    const Point& onwards = now.way.direction;
    const Point offset = position(now.robot) - now.ball;
    const double far = length(offset), along = dot(offset, onwards);
    const double behind = -along / std::max(1e-9, far);
    const double touch = options_.front + options_.ballRadius;
    const bool pushes =
        memory.phase == pushing ? behind > endPushing && far < touch + 0.8 : behind > beginPushing && far < touch + 0.6;
    memory.phase = pushes ? pushing : goingBehind;
    if (pushes) return now.ball + (along + lookAhead) * onwards;
    const Point back{-dot(offset, onwards), cross(offset, -1 * onwards)};
    const double round = std::clamp(direction(back), -stepRound, stepRound);
    return now.ball + (touch + wayRound) * Placement({0, 0, round}).rotate(unit(offset));
}

Command ChaseBall::chase(const Observation& observation, Memory& memory, WallStroke* stroke,
                         std::span<const Point> others, Decision& decision) const {
    const Situation now = situation(memory);
    const bool strikes = stroke != nullptr && stroke->strikes();
    if (!strikes && mustWait(now, others)) return wait(now, memory, others);
    if (strikes || (stroke != nullptr && !isAnyWithin(aloneWithin, now.ball, others))) {
        if (const auto command = strike(now, observation, memory, *stroke)) return *command;
    } else if (stroke != nullptr) {
        stroke->stop();
    }
    if (beginsSweeping(now, observation, others, memory)) return sweep(memory);
    const bool straight = memory.phase == straightOn && observation.time < memory.phaseEnd;
    memory.aim = clearOf(now.walls, straight ? now.ball : aim(now, memory), options_.halfWidth + roomBeside);
    if (shouldKick(observation, memory)) {
        decision.kicks.push_back({});
        memory.nextKick = observation.time + fromSeconds(kickEvery);
    }
    if (memory.phase != goingBehind) return driveTowards(Placement(now.robot).placeBack(memory.aim), limits());
    std::vector<Point> inTheWay;  // who is at the ball is not: it is fought for
    for (const Point& body : others)
        if (distance(body, now.ball) > contested) inTheWay.push_back(body);
    return goTo(memory.aim, now.robot, inTheWay);
}

/// Round those that are in the way, the slower the shorter the way ahead. The place is clear of walls: they count where
/// it goes round somebody.
Command ChaseBall::goTo(const Point& place, const Pose& from, std::span<const Point> others) const {
    const Point line = place - position(from);
    const double look = std::min(lookRound, length(line)), room = options_.halfWidth + roomBeside;
    std::vector<ConvexPiece> pieces;
    for (const Point& body : others)
        if (distance(body, position(from)) < look + room + bodyRadius)
            pieces.push_back(ConvexPiece::circle(body, bodyRadius));
    if (pieces.empty()) return driveTowards(Placement(from).placeBack(place), limits());
    const FloorPlan bodies(std::move(pieces));
    const auto freeWay = [&](double heading) {
        const Point way = Placement({0, 0, heading}).rotate({1, 0});
        return std::min(bodies.freeWay(position(from), way, room, look),
                        options_.walls->freeWay(position(from), way, options_.halfWidth, look));
    };
    const double wanted = direction(line), heading = clearHeading(wanted, look, freeWay);
    const Point towards = heading == wanted ? line : Placement({0, 0, heading}).rotate({1, 0});
    Command command = driveTowards(Placement({0, 0, from.heading}).rotateBack(towards), limits());
    command.v *= std::min(1.0, freeWay(from.heading) / std::max(1e-3, std::min(look, stopWithin)));
    return command;
}

/// Where a sighting of now has the ball right before the front, and the target lies ahead.
bool ChaseBall::shouldKick(const Observation& observation, const Memory& memory) const {
    const bool sighted = !observation.objects().empty() && observation.objects().front().index == 0;
    if (!options_.kicks || observation.manipulators == 0 || observation.time < memory.nextKick || !sighted)
        return false;
    const SeenBody& seen = observation.objects().front();
    const Point ball_B = Placement(memory.motion.motionSince(seen.measured)).placeBack(seen.position_B);
    const Point target_B = Placement(memory.self.pose).placeBack(options_.target);
    return ball_B.x > 0 && ball_B.x < options_.front + options_.ballRadius + kickReach &&
           std::abs(ball_B.y) < kickWidth && std::abs(direction(target_B)) < kickAngle &&
           std::abs(target_B.y) < kickMiss;
}

/// Where the ball lies still at a wall.
std::optional<Command> ChaseBall::strike(const Situation& now, const Observation& observation, Memory& memory,
                                         WallStroke& stroke) const {
    if (length(memory.ball.velocity) > rollsAlong && !stroke.strikes()) return std::nullopt;
    const auto command =
        stroke.update({observation.time, now.robot, now.ball, options_.target, *options_.walls}, *options_.stroke);
    if (!command) return std::nullopt;
    memory.phase = striking;
    memory.aim = position(stroke.stance(now.ball, *options_.stroke));
    return command;
}

bool ChaseBall::isSweeping(const Memory& memory) { return memory.phase == sweeping || memory.phase == sweepingJam; }

/// Between the horns of a guide the ball comes along when the robot turns: out of a corner, where a push leads nowhere,
/// and, if it strikes, from where another robot holds against it.
bool ChaseBall::beginsSweeping(const Situation& now, const Observation& observation, std::span<const Point> others,
                               Memory& memory) const {
    const bool jammed =
        options_.stroke && memory.backOff.hardlyMoving > jammedAfter && isAnyWithin(contested, now.ball, others);
    const Placement frame(memory.self.pose);
    const Point ball_B = frame.placeBack(memory.ball.position);
    if ((!now.way.cornered && !jammed) || isSweeping(memory) || ball_B.x < 0 ||
        length(ball_B) > options_.front + options_.ballRadius + sweepReach)
        return false;
    const Point free = now.way.out + 0.5 * unit(options_.target - now.ball);
    memory.turn = frame.rotateBack(free).y < 0 ? -1 : 1;
    memory.phase = now.way.cornered ? sweeping : sweepingJam;
    memory.phaseEnd = observation.time + fromSeconds(now.way.cornered ? sweepFor : jamSweepFor);
    return true;
}

Command ChaseBall::sweep(const Memory& memory) const {
    const double share = memory.phase == sweeping ? sweepShare : 1;
    return {share * options_.speed, memory.turn * options_.rotation};
}

/// At a wall there is no room for two robots, and no use in pushing the ball into a corner.
bool ChaseBall::mustWait(const Situation& now, std::span<const Point> others) const {
    if (now.way.cornered && !options_.guide) return true;
    if (!options_.yields || now.way.out == Point{} || distance(position(now.robot), now.ball) < crowd) return false;
    return isAnyWithin(crowd, now.ball, others);
}

/// Some way off, on the side that the target is not on, and looks at the ball.
Command ChaseBall::wait(const Situation& now, Memory& memory, std::span<const Point> others) const {
    memory.phase = waiting;
    const Point place = now.ball + waitAt * unit(now.way.out - waitAside * unit(options_.target - now.ball));
    return standBy(place, now.ball, memory, others);
}

Command ChaseBall::standBy(const Point& place, const Point& watched, Memory& memory,
                           std::span<const Point> others) const {
    memory.aim = place;
    const Pose robot = memory.self.pose * memory.motion.motionDuring(options_.deadTime);
    const Placement frame(robot);
    const Point aim_B = frame.placeBack(memory.aim);
    if (length(aim_B) < waitWithin) {
        const double turn = turnGain * direction(frame.placeBack(watched));
        return {0, std::clamp(turn, -options_.rotation, options_.rotation)};
    }
    if (aim_B.x < 0) {  // tail first, out of where others want to go
        const Command forward = driveTowards(-1 * aim_B, limits());
        return {-forward.v, forward.w};
    }
    return goTo(place, robot, others);
}

void ChaseBall::annotate(const Memory& memory, Decision& decision) const {
    if (!decision.wantsAnnotations) return;
    decision.annotations.push_back({.kind = Annotation::Kind::text, .label = "state", .text = name(memory.phase)});
    if (memory.ball.known == 0) return;
    const Point ball = memory.ball.position;
    decision.annotations.push_back({.kind = Annotation::Kind::point, .label = "ball", .points = {ball}});
    decision.annotations.push_back({.label = "ball speed (m/s)", .value = length(memory.ball.velocity)});
    decision.annotations.push_back({.kind = Annotation::Kind::point, .label = "aim", .points = {memory.aim}});
    decision.annotations.push_back(
        {.kind = Annotation::Kind::line, .label = "shot", .points = {ball, options_.target}});
}

void ChaseBall::explain(const Memory& memory, MemoryEntries& entries) const {
    const Nanoseconds now = memory.motion.now();
    entries.add("state lasts for", toSeconds(std::max<Nanoseconds>(0, memory.phaseEnd - now)), "s");
    entries.add("may kick in", toSeconds(std::max<Nanoseconds>(0, memory.nextKick - now)), "s");
    entries.add("aim x", memory.aim.x, "m");
    entries.add("aim y", memory.aim.y, "m");
    entries.add("turns to the", memory.turn < 0 ? "right" : "left");
    explainBall(memory.ball, now, entries);
    explainSelf(memory.self, now, entries);
    explainBackOff(memory.backOff, now, entries);
}

void ChaseBall::explain(std::span<const std::byte> bytes, MemoryEntries& entries) const {
    const Memory& memory = as<Memory>(bytes);
    entries.add("state", name(memory.phase));
    explain(memory, entries);
}

std::optional<Command> ChaseBall::backOff(const Observation& observation, Memory& memory) const {
    return memory.backOff.update(observation, memory.motion,
                                 {options_.speed, options_.rotation, options_.deadTime, turnAway});
}

Command ChaseBall::play(const Observation& observation, Memory& memory, WallStroke* stroke,
                        std::span<const Point> others, Decision& decision) const {
    if (const std::optional<Command> back = backOff(observation, memory)) {
        memory.phase = backingOff;
        if (stroke != nullptr) stroke->stop();
        // Every other time it tries the ball from where it is: the place behind it may be out of reach.
        memory.phaseEnd = observation.time + fromSeconds(straightFor);
        return *back;
    }
    if (isSweeping(memory) && observation.time < memory.phaseEnd) return sweep(memory);
    if (memory.ball.known == 0) return search(observation, memory);
    if (memory.phase == backingOff && memory.backOff.times % 2 == 1) memory.phase = straightOn;
    return chase(observation, memory, stroke, others, decision);
}

void ChaseBall::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    memory.motion.observe(observation);
    memory.self.update(observation, memory.motion);
    decision.command = Command{};
    if (memory.self.known != 0) {
        memory.ball.update(observation, memory.motion, memory.self, floor());
        WallStroke* const stroke = options_.stroke ? &as<WallStroke>(bytes.subspan(sizeof(Memory))) : nullptr;
        std::vector<Point> others;
        for (const SeenBody& seen : observation.robots())
            others.push_back(Placement(memory.self.at(seen.measured, memory.motion)).place(seen.position_B));
        decision.command = play(observation, memory, stroke, others, decision);
        annotate(memory, decision);
    }
    memory.motion.issue(*decision.command);
}

}  // namespace mrose
