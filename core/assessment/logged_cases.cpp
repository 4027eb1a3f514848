#include "assessment/logged_cases.h"

#include <algorithm>
#include <cmath>

#include "geometry/angle.h"
#include "geometry/point.h"
#include "logs/log_lookup.h"
#include "logs/pose_grid.h"
#include "logs/sensor_defects.h"
#include "perception/logged_view.h"

namespace mrose {
namespace {

/// "; it has "camera", "laser"": those that look for subjects, with what the log lacks.
std::string sensorsText(const Log& log) {
    std::string text;
    for (const std::string& name : sensorNames(log))
        if (std::ranges::any_of(log.robots, [&](const RobotLog& robot) { return hasLooks(robot, name); }))
            text += (text.empty() ? "; it has \"" : ", \"") + name + '"';
    return log.withIncomplete(text.empty() ? "; it has no readings of landmarks or robots" : text);
}

Expected<std::vector<std::size_t>> chosenRobots(const Log& log, const std::string& sensor,
                                                std::span<const std::string> names) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < log.robots.size(); ++i)
        if (names.empty() && hasLooks(log.robots[i], sensor)) chosen.push_back(i);
    for (const std::string& name : names) {
        const auto found = std::ranges::find(log.robots, name, &RobotLog::robot);
        if (found == log.robots.end()) return fail(log.source, "has no robot \"" + name + '"');
        const auto index = static_cast<std::size_t>(found - log.robots.begin());
        if (!hasLooks(*found, sensor))
            return fail(log.source, "has no sensor \"" + sensor + "\" of robot \"" + name + '"' + sensorsText(log));
        if (std::ranges::find(chosen, index) == chosen.end()) chosen.push_back(index);
    }
    if (chosen.empty()) return fail(log.source, "has no sensor \"" + sensor + '"' + sensorsText(log));
    return chosen;
}

/// Straight between the poses before and after, where there is truth.
Pose poseBetween(std::span<const StampedPose> poses, Nanoseconds time) {
    const auto after = std::ranges::upper_bound(poses, time, {}, &StampedPose::time);
    if (after == poses.begin()) return poses.front().pose;
    const StampedPose& before = *(after - 1);
    if (after == poses.end()) return before.pose;
    const double share = toSeconds(time - before.time) / toSeconds(after->time - before.time);
    const Pose &a = before.pose, &b = after->pose;
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.heading + share * (b.heading - a.heading)};
}

class Collector {
public:
    Collector(const Log& log, LoggedCases& cases) : log_(log), view_(log), cases_(cases) {}

    void collect(std::size_t robot, std::size_t trajectory) {
        LoggedCases::Robot& of = cases_.robots[robot];
        const Trajectory& from = log_.robots[of.inLog].trajectories[trajectory];
        const SensorLog* const sensor = findSensor(from, cases_.sensor);
        if (sensor == nullptr || sensor->looks.empty()) return;
        addDefects(of.defects, sensor->defects);
        for (const Look& look : sensor->looks) {
            if (!view_.known(of.inLog, trajectory, look.time)) {
                ++of.withoutTruth;
                continue;
            }
            LoggedLook added{robot, trajectory, look.time, cases_.cases.size(), 0};
            addCases(of, from, look);
            added.count = cases_.cases.size() - added.first;
            of.cases += added.count;
            ++of.looks;
            cases_.looks.push_back(added);
        }
    }

private:
    void addCases(LoggedCases::Robot& robot, const Trajectory& from, const Look& look) {
        const Pose own = poseBetween(from.poses, look.time);
        const bool landmarks = cases_.rule.subjects == SubjectKind::landmark;
        for (std::size_t i = 0; i < log_.subjects.size(); ++i) {
            const LogSubject& subject = log_.subjects[i];
            if ((subject.kind == LogSubject::Kind::landmark) != landmarks) continue;
            if (!landmarks && subject.robot == robot.name) continue;
            const auto place = view_.positionOf(from, i, look.time);
            if (!place) continue;
            const Point offset = *place - position(own);
            LoggedCase one{i, length(offset), wrapAngleNearly(direction(offset) - own.heading)};
            if (one.range > cases_.rule.range || std::abs(one.bearing) > cases_.rule.bearing) continue;
            addReading(look, one);
            robot.readings += one.reported;
            robot.gross += one.reported && !one.sound;
            cases_.cases.push_back(one);
        }
    }

    void addReading(const Look& look, LoggedCase& one) const {
        const auto reading = std::ranges::find(look.readings, one.subject, &LogReading::subject);
        if (reading == look.readings.end()) return;
        one.reported = true;
        one.measuredRange = reading->range;
        one.measuredBearing = reading->bearing;
        one.sound = std::abs(one.measuredRange - one.range) <= cases_.rule.grossRange &&
                    std::abs(wrapAngle(one.measuredBearing - one.bearing)) <= cases_.rule.grossBearing;
    }

    const Log& log_;
    LoggedView view_;
    LoggedCases& cases_;
};

std::string robotsText(const LoggedCases& cases) {
    std::string text = cases.robots.size() == 1 ? "robot " : "robots ";
    for (std::size_t i = 0; i < cases.robots.size(); ++i) text += (i == 0 ? "" : ", ") + cases.robots[i].name;
    return text;
}

}  // namespace

Expected<LoggedCases> loggedCases(const Log& log, const std::string& sensor, std::span<const std::string> robots,
                                  const CaseRule& rule) {
    const auto chosen = chosenRobots(log, sensor, robots);
    if (!chosen) return tl::unexpected(chosen.error());
    LoggedCases cases{log.source, log.format, sensor, log.dataset, log.synthetic, log.files, rule};
    cases.files.insert(cases.files.end(), log.measurementFiles.begin(), log.measurementFiles.end());
    for (const LogSubject& subject : log.subjects) cases.subjects.push_back(subject.name);
    for (const std::size_t robot : *chosen) cases.robots.push_back({log.robots[robot].robot, robot});
    Collector collector(log, cases);
    for (std::size_t i = 0; i < cases.robots.size(); ++i)
        for (std::size_t t = 0; t < log.robots[cases.robots[i].inLog].trajectories.size(); ++t) collector.collect(i, t);
    const char* const what = rule.subjects == SubjectKind::landmark ? "landmark" : "other robot";
    if (cases.cases.empty())
        return fail(log.source, std::string("has no ") + what + " that \"" + sensor + "\" of " + robotsText(cases) +
                                    " had before it while it is known where the robot was");
    std::int64_t readings = 0, gross = 0;
    for (const LoggedCases::Robot& robot : cases.robots) readings += robot.readings, gross += robot.gross;
    if (readings == 0)
        return fail(log.source, log.withIncomplete("\"" + sensor + "\" of " + robotsText(cases) + " reported no " +
                                                   what + ": nothing to judge errors by"));
    if (2 * gross > readings) return fail(log.source, misfitCause(sensor, robotsText(cases), gross, readings));
    return cases;
}

}  // namespace mrose
