#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/rollout.h"
#include "io/error.h"
#include "logs/robot_log.h"
#include "scenario/scenario.h"

namespace mrose {

/// A robot of a scenario and the real one whose commands it is given.
struct ComparedRobot {
    std::size_t body = 0;  ///< in LogWorld::parts().scene.robots
    std::string name;      ///< there
    std::size_t real = 0;  ///< in Log::robots
    std::string realName;  ///< there
};

/// Trajectories of a log on one clock, one of each compared robot: what was driven at the same time.
struct Take {
    struct Part {
        std::size_t trajectory = 0;  ///< in RobotLog::trajectories
        Nanoseconds origin = 0;      ///< the instant of the log at which the take's clock is 0
    };
    std::string name;         ///< of the trajectories; "" where no robot has several
    std::vector<Part> parts;  ///< by compared robot
    Nanoseconds length = 0;   ///< on the take's clock: where the last ground truth ends
};

/// Whether a robot can be compared over a trajectory of its. Error: it has no commands, or no ground truth of the same
/// time.
Expected<void> checkComparable(const Log& log, const RobotLog& robot, const Trajectory& trajectory);

/// A scenario whose robots play a log, and that log. The world can be opened at any instant of it: the simulated robots
/// are then where the real ones were, as fast, and told the same.
class LogWorld {
public:
    /// `parts` as loaded without ScenarioLoading::playLogs. Of the robots that play the log those stay whose real one
    /// is named in `robots`; empty: all of which the log has both commands and ground truth (leftOut() names the
    /// others). A take's clock is 0 where mrose run would begin. Error: no robot plays a log; the log lacks one of the
    /// robots, or the trajectory, commands or ground truth of one.
    static Expected<LogWorld> create(ScenarioParts parts, std::shared_ptr<const Log> log,
                                     const std::vector<std::string>& robots = {});

    const ScenarioParts& parts() const { return parts_; }
    const Log& log() const { return *log_; }
    const std::shared_ptr<const Log>& sharedLog() const { return log_; }
    const std::vector<ComparedRobot>& robots() const { return robots_; }
    /// Who is not compared for want of commands or of ground truth, though nobody asked for certain robots: a sentence
    /// each.
    const std::vector<std::string>& leftOut() const { return leftOut_; }
    const std::vector<Take>& takes() const { return takes_; }
    /// A world that all compared robots are in, at the scenario's starts and told nothing: what openAt() leaves out
    /// where a robot has no ground truth can be named in it.
    const std::shared_ptr<const Scenario>& everybody() const { return everybody_; }
    const Trajectory& trajectory(std::size_t take, std::size_t robot) const {
        return log_->robots[robots_[robot].real].trajectories[takes_[take].parts[robot].trajectory];
    }

    /// The world at one instant.
    struct Opened {
        std::shared_ptr<const Scenario> scenario;
        WorldState state;
        /// By compared robot: what was measured at the start; nothing where there is no ground truth. Such a robot is
        /// not in the world.
        std::vector<std::optional<RolloutStart>> starts;
        std::vector<std::size_t> bodies;  ///< by compared robot: in the scenario
    };
    /// At `start` on the take's clock, with commands for `duration`. Every compared robot has its control instant then;
    /// the other bodies begin as the scenario says.
    Opened openAt(std::size_t take, Nanoseconds start, Nanoseconds duration, std::uint64_t seed) const;

    /// What that world is made of, for whoever wants something in it otherwise. Velocities that are not measured are
    /// filled in in the scene, but not in `starts`.
    struct OpenedParts {
        ScenarioParts parts;
        std::vector<std::optional<RolloutStart>> starts;  ///< as in Opened
        std::vector<std::size_t> bodies;                  ///< likewise
    };
    OpenedParts partsAt(std::size_t take, Nanoseconds start, Nanoseconds duration) const;

    /// What tells a robot the commands of its start's trajectory, for `duration`, on a clock that begins at the start.
    static std::shared_ptr<const Controller> player(const RolloutStart& start, Nanoseconds duration);

private:
    LogWorld(ScenarioParts parts, std::shared_ptr<const Log> log) : parts_(std::move(parts)), log_(std::move(log)) {}
    Expected<void> findRobots(const std::vector<std::string>& chosen);
    std::vector<bool> removedOf(const std::vector<std::string>& chosen);
    Expected<void> findTakes();
    void gatherAll();
    Expected<Take> takeOf(const std::vector<std::size_t>& trajectories, bool first) const;

    ScenarioParts parts_;
    std::shared_ptr<const Log> log_;
    std::vector<ComparedRobot> robots_;
    std::vector<std::string> leftOut_;
    std::vector<LogExcerpt> excerpts_;  ///< by compared robot
    std::vector<Take> takes_;
    std::shared_ptr<const Scenario> everybody_;
};

}  // namespace mrose
