#include "identification/sensor_samples.h"

#include <algorithm>

#include "geometry/angle.h"
#include "logs/log_lookup.h"
#include "logs/pose_grid.h"
#include "world/noise.h"

namespace mrose {
namespace {

int blockOf(const Trajectory& trajectory, Nanoseconds sinceBegin, const SensorSampleOptions& options) {
    return trajectory.group + static_cast<int>(toSeconds(sinceBegin) / options.block);
}

/// Collects the cases of one robot's trajectory: of subjects.
class SubjectCollector {
public:
    SubjectCollector(const LoggedView& view, const SensorSampleOptions& options, SensorSamples& samples)
        : view_(view), options_(options), margin_(options.view.margin()), samples_(samples) {}

    void collect(std::size_t log, std::size_t robot, std::size_t trajectory, int name) {
        const Trajectory& from = view_.log().robots[robot].trajectories[trajectory];
        const SensorLog* const sensor = findSensor(from, options_.sensor);
        if (sensor == nullptr || sensor->looks.empty()) return;
        const Nanoseconds begin = sensor->looks.front().time;
        for (const Look& look : sensor->looks) {
            const Nanoseconds measured = look.time - options_.latency;
            if (!view_.known(robot, trajectory, measured)) {
                ++samples_.withoutTruth;
                continue;
            }
            if (isFalse(log, robot, trajectory, look.time)) {
                ++samples_.falseTruth;
                continue;
            }
            const int block = blockOf(from, look.time - begin, options_);
            const auto add = [&](const std::optional<LoggedView::Unknown>& unknown) {
                samples_.looks.push_back({log, name, look.time, block, samples_.cases.size(), 0, unknown.has_value()});
                addCases(look, view_.at(robot, trajectory, measured, options_.view, unknown), unknown.has_value());
                samples_.looks.back().count = samples_.cases.size() - samples_.looks.back().first;
            };
            add(std::nullopt);
            if (const auto unknown = oneKnown(robot, from, measured)) add(unknown);
        }
    }

private:
    bool isFalse(std::size_t log, std::size_t robot, std::size_t trajectory, Nanoseconds time) const {
        return std::ranges::any_of(options_.falseTruth, [&](const FalseTruth& off) {
            return off.log == log && off.robot == robot && off.trajectory == trajectory && time >= off.begin &&
                   time <= off.end;
        });
    }

    bool isAsked(SubjectKind kind) const {
        return kind == SubjectKind::landmark ? options_.landmarks : options_.robotSubjects;
    }

    /// One of the tracked robots, another one every now and then; nothing where there are no two.
    std::optional<LoggedView::Unknown> oneKnown(std::size_t robot, const Trajectory& own, Nanoseconds time) const {
        constexpr Nanoseconds stays = 20'000'000'000;
        std::vector<std::size_t> tracked;
        const std::vector<LogSubject>& subjects = view_.log().subjects;
        for (std::size_t i = 0; i < subjects.size(); ++i)
            if (subjects[i].kind == LogSubject::Kind::robot && subjects[i].robot != view_.log().robots[robot].robot &&
                view_.positionOf(own, i, time))
                tracked.push_back(i);
        if (tracked.size() < 2) return std::nullopt;
        const NoiseKey key{0, time / stays, static_cast<std::uint32_t>(robot), 0};
        return LoggedView::Unknown{tracked[noiseBits(key) % tracked.size()]};
    }

    void addCases(const Look& look, const std::vector<LoggedSubject>& subjects, bool again) {
        std::int64_t found = 0;
        for (const LoggedSubject& subject : subjects) {
            const auto reading = std::find_if(look.readings.begin(), look.readings.end(), [&](const LogReading& known) {
                return known.subject == subject.subject;
            });
            const bool reported = reading != look.readings.end();
            found += reported;
            const SensedState& state = subject.state;
            if (!isAsked(state.subject)) continue;
            if (!margin_.holds(state.range, state.bearing)) {
                if (!again) samples_.outOfView += reported;
                continue;
            }
            SensorCase& added = samples_.cases.emplace_back(SensorCase{state, subject.subject, reported, {}});
            if (reported) added.error = {reading->range - state.range, wrapAngle(reading->bearing - state.bearing)};
        }
        if (!again) samples_.unknownPlace += static_cast<std::int64_t>(look.readings.size()) - found;
    }

    const LoggedView& view_;
    const SensorSampleOptions& options_;
    View margin_;
    SensorSamples& samples_;
};

/// The same of poses: one case for each instant of the sensor's clock.
class PoseCollector {
public:
    PoseCollector(const LoggedView& view, const SensorSampleOptions& options, SensorSamples& samples)
        : view_(view), options_(options), samples_(samples) {}

    void collect(std::size_t log, std::size_t robot, std::size_t trajectory, int name) {
        const Trajectory& from = view_.log().robots[robot].trajectories[trajectory];
        const SensorLog* const sensor = findSensor(from, options_.sensor);
        if (sensor == nullptr) return;
        const std::vector<StampedPose>& poses = sensor->poses;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const auto add = [&](Nanoseconds time, const Pose* reported) {
                const Nanoseconds measured = time - options_.latency;
                if (!view_.known(robot, trajectory, measured)) {
                    ++samples_.withoutTruth;
                    return;
                }
                const int block = blockOf(from, time - poses.front().time, options_);
                samples_.looks.push_back({log, name, time, block, samples_.cases.size(), 1});
                samples_.cases.push_back(caseOf(robot, trajectory, measured, reported));
            };
            if (i > 0) visitMissing(poses[i - 1].time, poses[i].time, [&](Nanoseconds time) { add(time, nullptr); });
            add(poses[i].time, &poses[i].pose);
        }
    }

private:
    template <class Visit>
    void visitMissing(Nanoseconds before, Nanoseconds after, const Visit& visit) const {
        constexpr std::int64_t longest = 50;  // periods
        if (options_.period <= 0) return;
        const std::int64_t periods = (after - before + options_.period / 2) / options_.period;
        for (std::int64_t i = 1; i < periods && periods <= longest; ++i) visit(before + (after - before) * i / periods);
    }

    SensorCase caseOf(std::size_t robot, std::size_t trajectory, Nanoseconds measured, const Pose* reported) const {
        SensorCase one;
        one.state.own = truthAt(view_.log().robots[robot].trajectories[trajectory].poses, measured);
        one.state.velocity = view_.velocityOf(robot, trajectory, measured);
        one.reported = reported != nullptr;
        if (!one.reported) return one;
        const Pose error = relative(one.state.own, *reported);
        one.error = {error.x, error.y, wrapAngleNearly(error.heading)};
        return one;
    }

    const LoggedView& view_;
    const SensorSampleOptions& options_;
    SensorSamples& samples_;
};

int indexOf(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

template <class Collector>
SensorSamples collected(std::span<const Log> logs, const SensorSampleOptions& options) {
    SensorSamples samples;
    for (std::size_t log = 0; log < logs.size(); ++log) {
        const LoggedView view(logs[log], options.sizes);
        Collector collector(view, options, samples);
        for (std::size_t robot = 0; robot < logs[log].robots.size(); ++robot) {
            const RobotLog& from = logs[log].robots[robot];
            if (!options.robots.empty() &&
                std::find(options.robots.begin(), options.robots.end(), from.robot) == options.robots.end())
                continue;
            const int name = indexOf(samples.robots, from.robot);
            const std::size_t before = samples.looks.size();
            for (std::size_t t = 0; t < from.trajectories.size(); ++t) collector.collect(log, robot, t, name);
            if (samples.looks.size() > before && static_cast<std::size_t>(name) == samples.robots.size())
                samples.robots.push_back(from.robot);
        }
    }
    return samples;
}

}  // namespace

std::size_t SensorSamples::readings() const {
    std::size_t count = 0;
    visitReadings([&](const SensorCase&) { ++count; });
    return count;
}

SensorSamples sensorSamples(std::span<const Log> logs, const SensorSampleOptions& options) {
    return options.measures == SensorNetwork::Measures::pose ? collected<PoseCollector>(logs, options)
                                                             : collected<SubjectCollector>(logs, options);
}

}  // namespace mrose
