#include "synthetic/log_generator.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "synthetic/ball_play.h"
#include "synthetic/field_landmarks.h"
#include "synthetic/reference_camera.h"
#include "synthetic/reference_localiser.h"
#include "synthetic/sensor_noise.h"

namespace mrose {
namespace {

enum TrackerChannel : std::uint32_t {
    trackedX = 200,
    trackedY,
    trackedHeading,
    startX,
    startY,
    startHeading,
    seedOfRuns
};

constexpr double pause = 5;  // s between trajectories

double inTenThousandths(double value) { return std::round(value * 1e4) / 1e4; }

Pose tracked(const Pose& pose, std::uint64_t seed, std::int64_t sample, const SyntheticTracker& tracker) {
    const auto noise = [&](std::uint32_t channel) { return boxMullerPair({seed, sample, 0, channel}).first; };
    return {inTenThousandths(pose.x + tracker.positionNoise * noise(trackedX)),
            inTenThousandths(pose.y + tracker.positionNoise * noise(trackedY)),
            inTenThousandths(pose.heading + tracker.headingNoise * noise(trackedHeading))};
}

Pose startOf(std::uint64_t seed, std::uint32_t index, DrivePattern pattern) {
    const auto uniform = [&](std::uint32_t channel) {
        return uniformNoise({seed, static_cast<std::int64_t>(pattern), index, channel});
    };
    return {syntheticFieldLength * uniform(startX), syntheticFieldWidth * uniform(startY),
            std::numbers::pi * (2 * uniform(startHeading) - 1)};
}

/// A seed of its own for each run of a log.
std::uint64_t seedOfRun(std::uint64_t seed, DrivePattern pattern, std::uint32_t index, int repeat) {
    const std::int64_t which = static_cast<std::int64_t>(pattern) * 1'000'000 + repeat;
    return static_cast<std::uint64_t>(uniformNoise({seed, which, index, seedOfRuns}) * 0x1p53);
}

std::string trajectoryName(const SyntheticPart& part, int index, int repeat) {
    char text[64];
    std::snprintf(text, sizeof text, part.repeats > 1 ? "%s%d.%d" : "%s%d", std::string(name(part)).c_str(), index + 1,
                  repeat + 1);
    return text;
}

std::vector<SensorLog> sensorsOf(const SyntheticRun& run, std::uint64_t seed) {
    const TruePath path(run.truth);
    return {localise(path, seed), photograph(path, seed)};
}

/// By so much later.
void shift(Trajectory& trajectory, Nanoseconds by) {
    for (StampedCommand& command : trajectory.commands) command.time += by;
    for (StampedPose& pose : trajectory.poses) pose.time += by;
    for (StampedKick& kick : trajectory.kicks) kick.time += by;
    for (StampedBall& ball : trajectory.ball) ball.time += by;
    for (SensorLog& sensor : trajectory.sensors) {
        for (Look& look : sensor.looks) look.time += by;
        for (StampedPose& pose : sensor.poses) pose.time += by;
    }
}

Nanoseconds wholeSteps(double seconds) {
    return std::llround(seconds / toSeconds(ReferenceRobot::step)) * ReferenceRobot::step;
}

}  // namespace

SyntheticRun runReferenceRobot(std::span<const StampedCommand> commands, double duration, const Pose& start,
                               std::uint64_t seed, const SyntheticTracker& tracker) {
    const ReferenceRobot robot(seed);
    ReferenceRobotState state = robot.start(start);
    SyntheticRun run;
    const Nanoseconds end = wholeSteps(duration);
    for (std::size_t next = 0; state.time <= end; state = robot.next(state)) {
        for (; next < commands.size() && commands[next].time <= state.time; ++next)
            state = robot.issue(state, commands[next].command);
        if (state.time % tracker.period != 0) continue;
        const std::int64_t sample = state.time / tracker.period;
        run.truth.push_back({state.time, state.pose});
        run.tracked.push_back({state.time, tracked(state.pose, seed, sample, tracker)});
    }
    return run;
}

const std::vector<SyntheticSet>& syntheticSets() {
    static const std::vector<SyntheticSet> sets{
        {"training", "more than 100,000 patterns of random driving, to learn from", {{DrivePattern::random, 200, 60}}},
        {"held-out",
         "100 trajectories with one window of 10 s each, 20 of them with a full-to-zero switch, to judge by",
         {{DrivePattern::random, 80, 15}, {DrivePattern::hardSwitch, 20, 15}}},
        {"example",
         "a few minutes of driving and the two drive patterns, to try the program on",
         {{DrivePattern::random, 4, 60}, {DrivePattern::jink, 1}, {DrivePattern::ellipse, 1}}},
        {"repeat",
         "the same commands several times, to see how far runs differ",
         {{DrivePattern::random, 30, 15, 4}, {DrivePattern::jink, 1, -1, 10}, {DrivePattern::ellipse, 1, -1, 10}}},
        {"kicks",
         "600 kicks at a ball that is tracked, and 120 thrown balls, to learn a kicker and identify the ball by",
         {{.trajectories = 600, .ball = BallPlay::kicks}, {.trajectories = 120, .ball = BallPlay::throws}}},
        {"more-kicks", "300 kicks, to judge by; with another seed", {{.trajectories = 300, .ball = BallPlay::kicks}}},
    };
    return sets;
}

namespace {

/// What one run of a part leaves in the log, on a clock of its own.
Trajectory trajectoryOf(const SyntheticPart& part, std::uint64_t seed, int index, int repeat) {
    const auto number = static_cast<std::uint32_t>(index);
    const double duration = durationOf(part);
    Trajectory trajectory;
    trajectory.name = trajectoryName(part, index, repeat);
    trajectory.group = index;
    if (part.ball != BallPlay::none) {
        const int kind = patternCount + static_cast<int>(part.ball);
        const std::uint64_t runSeed = seedOfRun(seed, static_cast<DrivePattern>(kind), number, repeat);
        BallRun run = playBall(part.ball, duration, runSeed, index);
        trajectory.commands = std::move(run.commands);
        trajectory.poses = run.robot.tracked;
        trajectory.kicks = std::move(run.kicks);
        trajectory.ball = std::move(run.ball);
        if (part.sensors) trajectory.sensors = sensorsOf(run.robot, runSeed);
        return trajectory;
    }
    const std::uint64_t runSeed = seedOfRun(seed, part.pattern, number, repeat);
    trajectory.commands = patternCommands(part.pattern, duration, seed, number);
    const SyntheticRun run =
        runReferenceRobot(trajectory.commands, duration, startOf(seed, number, part.pattern), runSeed);
    trajectory.poses = run.tracked;
    if (part.sensors) trajectory.sensors = sensorsOf(run, runSeed);
    return trajectory;
}

}  // namespace

std::string_view name(const SyntheticPart& part) {
    if (part.ball == BallPlay::none) return name(part.pattern);
    return part.ball == BallPlay::kicks ? "kicks" : "throws";
}

double durationOf(const SyntheticPart& part) {
    constexpr double ofBalls = 6;  // s: most rest by then
    if (part.duration >= 0) return part.duration;
    return part.ball == BallPlay::none ? patternDuration(part.pattern) : ofBalls;
}

std::optional<Log> generateLog(const SyntheticPart& part, std::uint64_t seed, const Progress& progress) {
    Log log{"", "csv", 0, {{"reference", {}, {}}}, {}, true};
    if (part.sensors) log.subjects = fieldLandmarks();
    auto& trajectories = log.robots.front().trajectories;
    Nanoseconds begin = 0;
    for (int i = 0; i < part.trajectories; ++i) {
        for (int repeat = 0; repeat < part.repeats; ++repeat) {
            shift(trajectories.emplace_back(trajectoryOf(part, seed, i, repeat)), begin);
            begin += fromSeconds(std::ceil(durationOf(part) + pause));
            const double done = static_cast<double>(trajectories.size()) / (part.trajectories * part.repeats);
            if (progress && !progress(done)) return std::nullopt;
        }
    }
    return log;
}

}  // namespace mrose
