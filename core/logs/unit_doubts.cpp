#include "logs/unit_doubts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "geometry/point.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

constexpr Nanoseconds shortTime = truthGap / 2;   // noise is small beside what happens meanwhile
constexpr double fastest = 50, fastestTurn = 20;  // m/s, rad/s: no mobile robot is
constexpr double leastWay = 0.05;                 // m: less is noise of a ball that lies
constexpr double farthest = 300;                  // m: no sensor of a mobile robot reports more
constexpr double seldom = 0.05;                   // share of the time that trackers and sensors may err

/// Calls `use` with the ends of each span of poses that is long enough, and what it takes in s.
template <class Use>
void forSpans(const std::vector<StampedPose>& poses, const Use& use) {
    for (std::size_t i = 1, from = 0; i < poses.size(); ++i) {
        if (poses[i].time - poses[i - 1].time >= truthGap) from = i;
        if (poses[i].time - poses[from].time < shortTime) continue;
        use(poses[from].pose, poses[i].pose, toSeconds(poses[i].time - poses[from].time));
        from = i;
    }
}

/// What is known of neighbouring poses of all robots.
struct Motion {
    std::int64_t steps = 0, far = 0;  ///< `far`: nothing is known between
    double seconds = 0;               ///< of all steps
    std::int64_t spans = 0, fast = 0, fastTurns = 0;

    void add(const std::vector<StampedPose>& poses);
};

/// What is known of neighbouring positions of all tracked balls.
struct BallMotion {
    std::int64_t spans = 0, fast = 0;

    void add(const std::vector<StampedBall>& ball) {
        for (std::size_t i = 1, from = 0; i < ball.size(); ++i) {
            const Nanoseconds step = ball[i].time - ball[from].time;
            if (ball[i].time - ball[i - 1].time >= truthGap) from = i;
            if (from == i || step < shortTime) continue;
            // A ball lies most of the time.
            const double way = distance(ball[from].place, ball[i].place);
            spans += way > leastWay;
            fast += way > fastest * toSeconds(step);
            from = i;
        }
    }
};

void Motion::add(const std::vector<StampedPose>& poses) {
    for (std::size_t i = 1; i < poses.size(); ++i) {
        const Nanoseconds step = poses[i].time - poses[i - 1].time;
        ++steps;
        far += step >= truthGap;
        seconds += toSeconds(step);
    }
    forSpans(poses, [this](const Pose& from, const Pose& to, double time) {
        ++spans;
        fast += distance(position(from), position(to)) > fastest * time;
        fastTurns += std::abs(to.heading - from.heading) > fastestTurn * time;
    });
}

/// What is known of ranges of all sensors.
struct Ranges {
    std::int64_t count = 0, far = 0;

    void add(double range) {
        if (!std::isfinite(range)) return;
        ++count;
        far += range > farthest;
    }
    void add(const SensorLog& sensor) {
        for (const Look& look : sensor.looks)
            for (const LogReading& reading : look.readings) add(reading.range);
        for (const LogScan& scan : sensor.scans)
            for (const double range : scan.ranges) add(range);
    }
};

bool isOften(std::int64_t count, std::int64_t all) {
    return static_cast<double>(count) > seldom * static_cast<double>(all);
}

/// How fast the robot of a trajectory would be, and how fast it is told to be.
struct Speeds {
    std::vector<double> spans;  ///< m/s
    double commanded = 0;       ///< m/s: the most
};

Speeds speedsOf(const Trajectory& trajectory) {
    Speeds speeds;
    for (const StampedCommand& command : trajectory.commands)
        speeds.commanded = std::max(speeds.commanded, std::abs(command.command.v));
    forSpans(trajectory.poses, [&speeds](const Pose& from, const Pose& to, double time) {
        speeds.spans.push_back(distance(position(from), position(to)) / time);
    });
    return speeds;
}

std::string shortText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace

std::string withUnitDoubts(std::string cause, const Log& log) {
    for (const std::string& doubt : unitDoubts(log))
        if (cause.find(doubt) == std::string::npos)
            cause += (cause.ends_with('?') || cause.ends_with('.') ? " " : ". ") + doubt;
    return cause;
}

std::vector<std::string> unitDoubts(const Log& log) {
    if (log.format != "csv") return {};
    Motion motion, reported;
    BallMotion ball;
    Ranges ranges;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            motion.add(trajectory.poses);
            ball.add(trajectory.ball);
            for (const SensorLog& sensor : trajectory.sensors) {
                reported.add(sensor.poses);
                ranges.add(sensor);
            }
        }
    std::vector<std::string> doubts;
    if (motion.steps > 0 && motion.far == motion.steps)
        doubts.push_back("The poses of the log are " + shortText(motion.seconds / static_cast<double>(motion.steps)) +
                         " s apart, so that no rollout can be compared: times are expected in seconds.");
    if (isOften(motion.fast, motion.spans))
        doubts.push_back("The real robots would drive at more than " + shortText(fastest) +
                         " m/s: positions are expected in metres, times in seconds.");
    if (isOften(motion.fastTurns, motion.spans))
        doubts.push_back("The real robots would turn by more than " + shortText(fastestTurn) +
                         " rad/s: headings are expected in radians, not in degrees.");
    if (isOften(ball.fast, ball.spans))
        doubts.push_back("The ball would often move at more than " + shortText(fastest) +
                         " m/s: its positions are expected in metres, times in seconds.");
    if (isOften(reported.fast, reported.spans) || isOften(reported.fastTurns, reported.spans))
        doubts.push_back("By the poses that they reported, the real robots would drive at more than " +
                         shortText(fastest) + " m/s or turn by more than " + shortText(fastestTurn) +
                         " rad/s: metres, seconds and radians are expected.");
    if (isOften(ranges.far, ranges.count))
        doubts.push_back("The sensors would report what is more than " + shortText(farthest) +
                         " m away: ranges are expected in metres, not in millimetres.");
    return doubts;
}

Expected<void> checkMetres(const Log& log) {
    constexpr double asTold = 30, slowest = 3;  // times what is commanded; m/s
    if (log.format != "csv") return {};
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            if (trajectory.commands.empty()) continue;
            const Speeds speeds = speedsOf(trajectory);
            const double most = std::min(fastest, std::max(slowest, asTold * speeds.commanded));
            std::vector<double> fast;
            for (const double speed : speeds.spans)
                if (speed > most) fast.push_back(speed);
            if (!isOften(std::ssize(fast), std::ssize(speeds.spans))) continue;
            std::ranges::sort(fast);
            const double typical = fast[fast.size() / 2];
            // Told in the same unit, it does not show which one.
            const char* const seem = speeds.commanded > fastest         ? "x, y and v_cmd seem to be in another unit"
                                     : typical < 300 * speeds.commanded ? "x and y seem to be in centimetres"
                                                                        : "x and y seem to be in millimetres";
            return fail(log.files.size() == 1 ? log.files.front().path : log.source,
                        "robot " + robot.robot + ", trajectory " + trajectory.name + ": by its poses it drives at " +
                            shortText(typical) + " m/s where it is told at most " + shortText(speeds.commanded) +
                            " m/s: " + seem + "; expected metres");
        }
    return {};
}

}  // namespace mrose
