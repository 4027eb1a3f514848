#include "behaviour/free_ball.h"

#include <algorithm>
#include <array>

#include "behaviour/back_off.h"
#include "behaviour/ball_belief.h"
#include "behaviour/memory_entries.h"
#include "behaviour/steering.h"
#include "geometry/point.h"

namespace mrose {
namespace {

enum FreeingPhase : std::int64_t { looking, goingThere, stroking, gettingOff, freed, turningOut };
constexpr std::array freeingNames{"searching", "going to the ball", "", "backing off", "free", "sweeping"};
constexpr double lookShare = 0.9;                          // of the rotation rate
constexpr double offTurn = 0.6;                            // rad, after backing off
constexpr double sweepGap = 0.06;                          // m, between front and ball
constexpr double sweepLasts = 1.5, sweepSpeedShare = 0.5;  // s; of the speed

}  // namespace

struct FreeBall::Memory {
    MotionMemory motion;
    OwnBelief self;
    BackOff backOff;
    BallBelief ball;
    WallStroke stroke;
    std::int64_t phase;
    double turn;  ///< 1 or -1, to the left or right, of searching and sweeping
    Nanoseconds sweepEnd;
};

std::size_t FreeBall::memorySize() const {
    static_assert(sizeof(Memory) == sizeof(MotionMemory) + sizeof(OwnBelief) + sizeof(BackOff) + sizeof(BallBelief) +
                                        sizeof(WallStroke) + 3 * 8,
                  "no padding");
    return sizeof(Memory);
}

Command FreeBall::act(const Observation& observation, Memory& memory) const {
    const WallStroke::Options& stroke = options_.stroke;
    const DriveLimits limits{stroke.speed, stroke.rotation};
    const auto back =
        memory.backOff.update(observation, memory.motion, {limits.speed, limits.rotation, options_.deadTime, offTurn});
    if (back) {
        memory.phase = gettingOff;
        memory.stroke.stop();
        return *back;
    }
    if (memory.phase == turningOut && observation.time < memory.sweepEnd) return sweeping(memory);
    if (memory.ball.known == 0 && !memory.stroke.strikes()) {
        const bool right = Placement(memory.self.pose).placeBack(memory.ball.position).y < 0;
        if (memory.phase != looking || memory.turn == 0) memory.turn = right ? -1 : 1;
        memory.phase = looking;
        return {0, memory.turn * lookShare * limits.rotation};
    }
    const Pose robot = memory.self.pose * memory.motion.motionDuring(options_.deadTime);
    const Point ball = memory.ball.position;
    memory.phase = stroking;
    if (const auto command =
            memory.stroke.update({observation.time, robot, ball, options_.towards, *options_.walls}, stroke))
        return *command;
    if (options_.walls->wallsNear(ball, stroke.ballRadius + stroke.within).empty()) {
        memory.phase = freed;
        return {};
    }
    return sweep(observation, memory, robot, ball);
}

/// In a corner there is no room for a stroke: it drives at the ball, and turns with it between the horns.
Command FreeBall::sweep(const Observation& observation, Memory& memory, const Pose& robot, const Point& ball) const {
    const WallStroke::Options& stroke = options_.stroke;
    const Placement frame(robot);
    const Point ball_B = frame.placeBack(ball);
    if (ball_B.x > 0 && length(ball_B) < options_.front + stroke.ballRadius + sweepGap) {
        memory.phase = turningOut;
        memory.turn = frame.rotateBack(options_.towards - ball).y < 0 ? -1 : 1;
        memory.sweepEnd = observation.time + fromSeconds(sweepLasts);
        return sweeping(memory);
    }
    memory.phase = goingThere;
    return driveTowards(ball_B, {stroke.speed, stroke.rotation});
}

Command FreeBall::sweeping(const Memory& memory) const {
    return {sweepSpeedShare * options_.stroke.speed, memory.turn * options_.stroke.strokeRotation};
}

void FreeBall::annotate(const Memory& memory, Decision& decision) const {
    if (!decision.wantsAnnotations) return;
    const bool strokes = memory.phase == stroking;
    decision.annotations.push_back(
        {.kind = Annotation::Kind::text,
         .label = "state",
         .text = std::string(strokes ? memory.stroke.doing() : freeingNames[static_cast<std::size_t>(memory.phase)])});
    if (memory.ball.known == 0) return;
    const Point ball = memory.ball.position;
    decision.annotations.push_back({.kind = Annotation::Kind::point, .label = "ball", .points = {ball}});
    if (!strokes) return;
    const Point stop = position(memory.stroke.stance(ball, options_.stroke));
    decision.annotations.push_back({.kind = Annotation::Kind::line, .label = "stroke", .points = {stop, ball}});
}

void FreeBall::explain(std::span<const std::byte> bytes, MemoryEntries& entries) const {
    const Memory& memory = as<Memory>(bytes);
    const Nanoseconds now = memory.motion.now();
    entries.add("state", memory.phase == stroking ? memory.stroke.doing()
                                                  : freeingNames[static_cast<std::size_t>(memory.phase)]);
    entries.add("strokes", static_cast<double>(memory.stroke.strokes));
    entries.add("turns to the", memory.stroke.side < 0 ? "right" : "left");
    explainBall(memory.ball, now, entries);
    explainSelf(memory.self, now, entries);
    explainBackOff(memory.backOff, now, entries);
}

void FreeBall::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    memory.motion.observe(observation);
    memory.self.update(observation, memory.motion);
    decision.command = Command{};
    if (memory.self.known != 0) {
        memory.ball.update(observation, memory.motion, memory.self, {options_.walls.get(), options_.stroke.ballRadius});
        decision.command = act(observation, memory);
        annotate(memory, decision);
    }
    memory.motion.issue(*decision.command);
}

}  // namespace mrose
