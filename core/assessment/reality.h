#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/log_world.h"
#include "quantities/real_robots.h"

namespace mrose {

/// What really happened beside a run that begins at an instant of a log, on the run's clock. A value; views of the run
/// show it too, and errors of the simulated robots, as windowErrors() has them, are against it.
struct Reality : RealRobots {
    struct Robot {
        std::string name;                        ///< of the simulated robot
        std::string realName;                    ///< in the log
        const Trajectory* trajectory = nullptr;  ///< in `log`
        Nanoseconds origin = 0;                  ///< the instant of the log at which the run's clock is 0

        /// Where the real robot is at an instant of the run's clock; nullopt where there is no ground truth. Heading
        /// continuous.
        std::optional<Pose> poseAt(Nanoseconds now) const;
        /// How fast it is then, by the slope of the measured poses.
        std::optional<Velocity> velocityAt(Nanoseconds now) const;
        /// The measured poses in between, both ends included. Their times are the log's.
        std::span<const StampedPose> posesBetween(Nanoseconds from, Nanoseconds to) const;
        /// A stretch of the run's clock without truth: between the last pose before and the next one.
        struct Stretch {
            Nanoseconds from = 0, to = 0;
            bool operator==(const Stretch&) const = default;
        };
        /// In which its place is not known, between two instants, in order.
        std::vector<Stretch> unknownBetween(Nanoseconds from, Nanoseconds to) const;
    };
    /// What another motion model makes of the same start and the same commands.
    struct ModelRollout {
        std::string name;
        Nanoseconds step = 0;
        std::vector<std::vector<Pose>>
            poses;  ///< by robot of `robots`: at 0, step, 2 step ...; empty or missing: it has none

        /// The one at or before that instant; nullopt beyond its end.
        std::optional<Pose> poseAt(std::size_t robot, Nanoseconds now) const;
    };
    std::shared_ptr<const Log> log;
    Nanoseconds start = 0;  ///< on the session's clock, where the run's is 0
    std::vector<Robot> robots;
    std::vector<ModelRollout> models;
    std::shared_ptr<const Scenario> allRobots = {};  ///< LogWorld::allRobots(); null: no robot is left out

    /// What its robots are called: Log::real().
    const char* real() const { return log == nullptr ? "real" : log->real(); }
    /// Of the simulated robot of that name; nullptr: none really drove beside it.
    const Robot* robotNamed(const std::string& simulated) const;
    /// Instants between which it is not known where a robot is, from the run's start on; nullptr: in which it is not
    /// known of any. What has not been measured at the end is unknown for good.
    std::vector<Robot::Stretch> unknownOf(const Robot* robot) const;
    /// How far a model is from a robot of `robots`, at the last of its instants up to `now`; nullopt where one of the
    /// two is unknown then.
    std::optional<PoseError> modelError(const ModelRollout& model, std::size_t robot, Nanoseconds now) const;

    std::optional<Pose> poseOf(const std::string& simulated, Nanoseconds now) const override;
    std::optional<Velocity> velocityOf(const std::string& simulated, Nanoseconds now) const override;
    std::vector<std::string> modelNames() const override;
    std::optional<PoseError> errorOf(const std::string& model, const std::string& simulated,
                                     Nanoseconds now) const override;
};

/// Beside LogWorld::openAt() of that session and start.
Reality realityOf(const LogWorld& world, std::size_t session, Nanoseconds start);

}  // namespace mrose
