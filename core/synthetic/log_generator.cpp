#include "synthetic/log_generator.h"

#include <cmath>
#include <cstdio>
#include <numbers>

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

std::string trajectoryName(DrivePattern pattern, int index, int repeat, int repeats) {
    char text[64];
    std::snprintf(text, sizeof text, repeats > 1 ? "%s%d.%d" : "%s%d", std::string(name(pattern)).c_str(), index + 1,
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
    };
    return sets;
}

std::optional<Log> generateLog(const SyntheticPart& part, std::uint64_t seed, const Progress& progress) {
    const double duration = part.duration < 0 ? patternDuration(part.pattern) : part.duration;
    Log log{"", "csv", 0, {{"reference", {}, {}}}, {}, true};
    if (part.sensors) log.subjects = fieldLandmarks();
    auto& trajectories = log.robots.front().trajectories;
    Nanoseconds begin = 0;
    for (int i = 0; i < part.trajectories; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        const auto commands = patternCommands(part.pattern, duration, seed, index);
        for (int repeat = 0; repeat < part.repeats; ++repeat) {
            const std::uint64_t runSeed = seedOfRun(seed, part.pattern, index, repeat);
            const SyntheticRun run = runReferenceRobot(commands, duration, startOf(seed, index, part.pattern), runSeed);
            Trajectory& trajectory = trajectories.emplace_back();
            trajectory.name = trajectoryName(part.pattern, i, repeat, part.repeats);
            trajectory.group = i;
            trajectory.commands = commands;
            trajectory.poses = run.tracked;
            if (part.sensors) trajectory.sensors = sensorsOf(run, runSeed);
            shift(trajectory, begin);
            begin += fromSeconds(std::ceil(duration + pause));
            const double done = static_cast<double>(trajectories.size()) / (part.trajectories * part.repeats);
            if (progress && !progress(done)) return std::nullopt;
        }
    }
    return log;
}

}  // namespace mrose
