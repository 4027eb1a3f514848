#include "support/toy_camera.h"

#include <cmath>

#include "geometry/normal_distribution.h"
#include "perception/logged_view.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr Nanoseconds second = 1'000'000'000;

Trajectory circle(const Point& centre, double radius, double rotation, double seconds) {
    Trajectory trajectory;
    for (int i = 0; i <= static_cast<int>(25 * seconds); ++i) {
        const double heading = 0.04 * rotation * i;
        trajectory.poses.push_back(
            {i * (second / 25),
             {centre.x + radius * std::sin(heading), centre.y - radius * std::cos(heading), heading}});
    }
    trajectory.commands = {{0, {radius * rotation, rotation}}};
    return trajectory;
}

}  // namespace

void ToyCamera::distributions(std::span<const SensedState> states, const std::string&,
                              std::span<ReadingDistribution> to) const {
    for (std::size_t i = 0; i < states.size(); ++i) {
        const SensedState& state = states[i];
        ReadingDistribution& of = to[i] = {};
        of.form.components = 2;
        of.threshold = view().holds(state.range, state.bearing) ? 1.2 - 0.4 * state.range : -2.5;
        of.component[0] = {0.7, {0.03 * state.range, 0.01}, {wider_ * 0.02 * state.range, wider_ * 0.005}};
        of.component[1] = {0.3, {0.03 * state.range, -0.01}, {wider_ * 0.06 * state.range, wider_ * 0.015}};
    }
}

Log seenLog(const SensorModel& camera, double seconds) {
    Log log;
    log.source = "seen";
    log.format = "test";
    log.robots = {{"1", {circle({0, 0}, 1, 0.2, seconds)}, {}}, {"2", {circle({1, 0}, 2, -0.1, seconds)}, {}}};
    for (const RobotLog& robot : log.robots)
        log.subjects.push_back({robot.robot, LogSubject::Kind::robot, robot.robot});
    for (int i = 0; i < 15; ++i) {
        const double direction = 0.42 * i, distance = 2 + 0.3 * (i % 7) * (i % 3);
        log.subjects.push_back({std::to_string(6 + i), LogSubject::Kind::landmark, "", distance * towards(direction)});
    }
    SensorLog seen{"camera", {}};
    const LoggedView view(log);
    for (Nanoseconds time = second / 2; toSeconds(time) < seconds - 0.5; time += second / 4) {
        Look look{time, {}};
        for (const LoggedSubject& subject : view.at(0, 0, time - camera.latency(), camera.view())) {
            ReadingDistribution of;
            camera.distributions({&subject.state, 1}, "1", {&of, 1});
            const auto channel = static_cast<std::uint32_t>(4 * subject.subject);
            const NoisePair errors = normalPair({7, time, 0, channel});
            const ReadingDraw draw{normalNoise({7, time, 0, channel + 1}),
                                   uniformNoise({7, time, 0, channel + 2}),
                                   {errors.first, errors.second}};
            if (!of.reports(draw)) continue;
            const ReadingError error = of.error(draw);
            look.readings.push_back({subject.subject, std::max(0.0, subject.state.range + error[0]),
                                     wrapAngle(subject.state.bearing + error[1])});
        }
        seen.looks.push_back(std::move(look));
    }
    log.robots[0].trajectories[0].sensors.push_back(std::move(seen));
    return log;
}

}  // namespace mrose
