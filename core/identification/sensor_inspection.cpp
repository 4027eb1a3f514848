#include "identification/sensor_inspection.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/point.h"
#include "identification/robust_statistics.h"
#include "io/format.h"
#include "logs/log_lookup.h"
#include "logs/sensor_defects.h"

namespace mrose {
namespace {

constexpr double grossRange = 1, grossBearing = 0.15;  // m, rad
// Less comes and goes with the geometry.
constexpr double leastBearingChange = 0.02;                     // rad
constexpr double leastRangeChange = 0.15, mostRangeChange = 1;  // share of the range
constexpr double shortestRange = 0.5;                           // m: a nearer one is no measure of shares
constexpr double causeSignificance = 3;                         // standard errors

template <class Sample>
void addPauses(std::vector<double>& pauses, const std::vector<Sample>& samples) {
    for (std::size_t i = 1; i < samples.size(); ++i) pauses.push_back(toSeconds(samples[i].time - samples[i - 1].time));
}

void count(SensorInspection& found, const Log& log, const SensorLog& sensor, std::set<std::size_t>& subjects) {
    found.looks += sensor.looks.size();
    found.poses += sensor.poses.size();
    found.scans += sensor.scans.size();
    for (const Look& look : sensor.looks) {
        found.seeingLooks += !look.readings.empty();
        found.readings += look.readings.size();
        for (const LogReading& reading : look.readings) {
            subjects.insert(reading.subject);
            found.landmarkReadings += log.subjects[reading.subject].kind == LogSubject::Kind::landmark;
        }
    }
    addDefects(found.defects, sensor.defects);
}

SensorInspection countsOf(const Log& log, const RobotLog& robot, const std::string& name) {
    SensorInspection found{.sensor = name};
    std::set<std::size_t> subjects;
    std::vector<double> pauses;
    for (const Trajectory& trajectory : robot.trajectories) {
        const SensorLog* const sensor = findSensor(trajectory, name);
        if (sensor == nullptr) continue;
        count(found, log, *sensor, subjects);
        addPauses(pauses, sensor->looks);
        if (sensor->looks.empty()) addPauses(pauses, sensor->poses);
        if (sensor->looks.empty() && sensor->poses.empty()) addPauses(pauses, sensor->scans);
    }
    found.subjects = subjects.size();
    if (pauses.empty()) return found;
    found.period = medianOf(pauses);
    found.periodSpread = robustSpread(std::move(pauses), found.period);
    return found;
}

/// A sensor's known readings at its lateness: those that are not gross.
struct SoundMisfits {
    std::vector<std::vector<StampedMisfit>> ranges, bearings;  // by trajectory; shares of the range, and rad
    std::vector<double> range, rangeShare, bearing;
};

SoundMisfits soundMisfits(SensorInspection& found, const std::vector<KnownReading>& readings,
                          std::size_t trajectories) {
    SoundMisfits sound{std::vector<std::vector<StampedMisfit>>(trajectories),
                       std::vector<std::vector<StampedMisfit>>(trajectories),
                       {},
                       {},
                       {}};
    for (const KnownReading& known : readings) {
        const auto misfit = misfitOf(known, found.lateness.identified ? found.lateness.lateness : 0);
        if (!misfit) continue;
        ++found.known;
        if (isGross(misfit->range, misfit->bearing)) {
            ++found.gross;
            continue;
        }
        const double distance = known.reading.range - misfit->range;
        sound.ranges[known.trajectory].push_back({known.time, misfit->range / std::max(distance, shortestRange)});
        sound.rangeShare.push_back(sound.ranges[known.trajectory].back().value);
        sound.bearings[known.trajectory].push_back({known.time, misfit->bearing});
        sound.range.push_back(misfit->range);
        sound.bearing.push_back(misfit->bearing);
    }
    return sound;
}

/// How the tracked heading is off within a stretch, by the direction of motion there and elsewhere.
void compareHeading(SensorChange& change, const LevelChange& level, const std::vector<LevelChange>& all,
                    const std::vector<StampedMisfit>& course) {
    constexpr std::size_t fewest = 10;
    std::vector<double> within, elsewhere;
    for (const StampedMisfit& misfit : course) {
        const auto holds = [&](const LevelChange& other) {
            return misfit.time >= other.begin && misfit.time <= other.end;
        };
        if (holds(level))
            within.push_back(misfit.value);
        else if (std::none_of(all.begin(), all.end(), holds))
            elsewhere.push_back(misfit.value);
    }
    if (within.size() < fewest || elsewhere.size() < fewest) return;
    const double usual = medianOf(elsewhere), now = medianOf(within);
    const double spread = std::max(robustSpread(within, now), robustSpread(elsewhere, usual));
    change.headingOffset = usual - now;
    // Neighbours share half of their way, and a median is known a quarter worse than a mean.
    change.headingError = 1.25 * spread * std::sqrt(2.0 / static_cast<double>(within.size()));
    const double error = length({change.headingError, change.error}), notOff = std::abs(change.headingOffset);
    const double differs = std::abs(change.headingOffset - change.offset);
    if (differs < notOff && notOff > causeSignificance * error)
        change.cause = SensorChange::Cause::truth;
    else if (notOff < differs && differs > causeSignificance * error)
        change.cause = SensorChange::Cause::sensor;
}

void findChanges(SensorInspection& found, const RobotLog& robot, const SoundMisfits& sound) {
    const double usualShare = medianOf(sound.rangeShare);
    for (std::size_t index = 0; index < robot.trajectories.size(); ++index) {
        const Trajectory& trajectory = robot.trajectories[index];
        if (sound.bearings[index].empty()) continue;
        const auto bearings =
            levelChanges(sound.bearings[index], found.bearingOffset, leastBearingChange, grossBearing);
        const auto ranges = levelChanges(sound.ranges[index], usualShare, leastRangeChange, mostRangeChange);
        const auto course = bearings.empty() ? std::vector<StampedMisfit>{} : courseMisfits(trajectory.poses);
        Nanoseconds origin = trajectory.poses.front().time;
        if (!trajectory.commands.empty()) origin = std::min(origin, trajectory.commands.front().time);
        const auto changeOf = [&](const LevelChange& level, bool bearing) {
            return SensorChange{bearing,
                                trajectory.name,
                                toSeconds(level.begin - origin),
                                toSeconds(level.end - origin),
                                index,
                                level.begin,
                                level.end,
                                level.offset,
                                level.error};
        };
        for (const LevelChange& level : bearings) {
            SensorChange change = changeOf(level, true);
            compareHeading(change, level, bearings, course);
            found.changes.push_back(std::move(change));
        }
        for (const LevelChange& level : ranges) found.changes.push_back(changeOf(level, false));
    }
}

SensorLateness latenessOf(const SensorInspection& found, const RobotLog& robot,
                          const std::vector<KnownReading>& readings) {
    const bool tracked = std::any_of(robot.trajectories.begin(), robot.trajectories.end(),
                                     [](const Trajectory& trajectory) { return !trajectory.poses.empty(); });
    if (!tracked) return {false, "no ground truth"};
    if (found.readings > 0) return fitLateness(bearingMisfits(readings));
    if (found.poses > 0) return fitLateness(motionMisfits(robot, found.sensor));
    return {false, found.scans > 0 ? "nothing says what its scans should show" : "it reported no subject"};
}

void checkPoses(SensorInspection& found, const RobotLog& robot) {
    if (found.readings > 0 || found.poses == 0) return;
    const double lateness = found.lateness.identified ? found.lateness.lateness : 0;
    found.pose = poseMisfit(robot, found.sensor, lateness);
    const FollowedMotion followed = followedMotion(robot, found.sensor, lateness);
    if (followed.share + 3 * followed.error < 0.5) found.followed = followed.share;
}

}  // namespace

std::string exchangedText(const PoseMisfit& pose) {
    return "its poses are " + fixed(pose.distance, 2) + " m off the ground truth in the median, and " +
           fixed(pose.exchanged, 2) + " m with x and y exchanged: are the columns reported_x and reported_y exchanged?";
}

bool isGross(double range, double bearing) { return std::abs(range) > grossRange || std::abs(bearing) > grossBearing; }

SensorInspection inspectSensor(const Log& log, const RobotLog& robot, const std::string& name) {
    SensorInspection found = countsOf(log, robot, name);
    const std::vector<KnownReading> readings = knownReadings(log, robot, name);
    found.lateness = latenessOf(found, robot, readings);
    const SoundMisfits sound = soundMisfits(found, readings, robot.trajectories.size());
    checkPoses(found, robot);
    if (found.misfits()) found.lateness = {false, "its readings do not fit the ground truth"};
    if (sound.range.empty()) return found;
    found.rangeOffset = medianOf(sound.range);
    found.rangeSpread = robustSpread(sound.range, found.rangeOffset);
    found.bearingOffset = medianOf(sound.bearing);
    found.bearingSpread = robustSpread(sound.bearing, found.bearingOffset);
    if (!found.misfits()) findChanges(found, robot, sound);
    return found;
}

std::vector<SensorInspection> inspectSensors(const Log& log, const RobotLog& robot) {
    std::vector<SensorInspection> found;
    for (const Trajectory& trajectory : robot.trajectories)
        for (const SensorLog& sensor : trajectory.sensors) {
            const bool known = std::any_of(found.begin(), found.end(), [&](const SensorInspection& other) {
                return other.sensor == sensor.sensor;
            });
            if (!known) found.push_back(inspectSensor(log, robot, sensor.sensor));
        }
    return found;
}

}  // namespace mrose
