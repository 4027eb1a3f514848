#pragma once

#include <optional>
#include <vector>

#include "logs/robot_log.h"
#include "perception/sensed_state.h"
#include "perception/view.h"

namespace mrose {

/// How large what a log tracks is, as discs about what is tracked: m.
struct TrackedSizes {
    double robot = 0.17, landmark = 0.05;
};

/// A subject of a log (index in Log::subjects) as it truly was.
struct LoggedSubject {
    std::size_t subject = 0;
    SensedState state;
};

/// What the sensors of a log's robots had before them: the ground truth of all of them, and the landmarks. Readings are
/// never looked at. The log must outlive it.
class LoggedView {
public:
    explicit LoggedView(const Log& log, const TrackedSizes& sizes = {});

    /// Whether the ground truth of a robot's trajectory says where it was.
    bool known(std::size_t robot, std::size_t trajectory, Nanoseconds time) const;

    /// Where a subject was beside a trajectory of the log, at an instant of its clock; nothing where the log does not
    /// say it.
    std::optional<Point> positionOf(const Trajectory& own, std::size_t subject, Nanoseconds time) const;

    /// The velocity of a robot, from the truth up to 0.16 s before and after.
    Velocity velocityOf(std::size_t robot, std::size_t trajectory, Nanoseconds time) const;

    /// As if of the other robots nobody knew the places, but for the subject `known`: for learning what such logs look
    /// like.
    struct Unknown {
        std::size_t known = 0;
    };

    /// All subjects whose place is known, but for the robot itself, as a sensor of such a view has them before it; of a
    /// trajectory with ground truth, where known() does not hold by its nearest poses.
    std::vector<LoggedSubject> at(std::size_t robot, std::size_t trajectory, Nanoseconds time, const View& view,
                                  const std::optional<Unknown>& unknown = std::nullopt) const;

    const Log& log() const { return log_; }

private:
    struct Body {
        std::size_t subject;
        Point offset;  ///< from the sensor's robot
        double distance, radius;
        bool robot;
    };
    std::vector<Body> bodiesAt(std::size_t robot, const Trajectory& own, const Point& eye, Nanoseconds time,
                               const std::optional<Unknown>& unknown) const;
    double shareUnknown(std::size_t robot, const std::vector<Body>& bodies) const;

    const Log& log_;
    TrackedSizes sizes_;
    std::vector<std::optional<std::size_t>> robotOf_;  ///< by subject: in Log::robots
};

}  // namespace mrose
