#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assessment/rollout.h"
#include "assessment/tracker_history.h"
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

/// Trajectories of a log on one clock, one of each compared robot: what was driven at the same time: a recording
/// session.
struct LogSession {
    struct Part {
        std::size_t trajectory = 0;  ///< in RobotLog::trajectories
        Nanoseconds origin = 0;      ///< the instant of the log at which the session's clock is 0
    };
    std::string name;         ///< of the trajectories; "" where no robot has several
    std::vector<Part> parts;  ///< by compared robot
    Nanoseconds length = 0;   ///< on the session's clock: where the last ground truth ends
};

/// Whether a robot can be compared over a trajectory of its. Error: it has no commands, or no ground truth of the same
/// time.
Expected<void> checkComparable(const Log& log, const RobotLog& robot, const Trajectory& trajectory);

/// A scenario whose robots play a log, and that log. The world can be opened at any instant of it: the simulated robots
/// are then where the real ones were, as fast, and get the same commands.
class LogWorld {
public:
    /// `parts` as loaded without ScenarioLoading::playLogs. Of the robots that play the log those stay whose real one
    /// is named in `robots`; empty: all of which the log has both commands and ground truth (leftOut() names the
    /// others). A session's clock is 0 where mrose run would begin. Error: no robot plays a log; the log lacks one of
    /// the robots, or the trajectory, commands or ground truth of one.
    static Expected<LogWorld> create(ScenarioParts parts, std::shared_ptr<const Log> log,
                                     const std::vector<std::string>& robots = {});

    const ScenarioParts& parts() const { return parts_; }
    const Log& log() const { return *log_; }
    const std::shared_ptr<const Log>& sharedLog() const { return log_; }
    const std::vector<ComparedRobot>& robots() const { return robots_; }
    /// Robots that are not compared as they lack commands or ground truth, though no robots were asked for by name: a
    /// sentence each.
    const std::vector<std::string>& leftOut() const { return leftOut_; }
    const std::vector<LogSession>& sessions() const { return sessions_; }
    /// A world that all compared robots are in, at the scenario's starts and without commands: what openAt() leaves out
    /// where a robot has no ground truth can be named in it.
    const std::shared_ptr<const Scenario>& allRobots() const { return allRobots_; }
    const Trajectory& trajectory(std::size_t session, std::size_t robot) const {
        return log_->robots[robots_[robot].real].trajectories[sessions_[session].parts[robot].trajectory];
    }

    /// The world at one instant.
    struct Opened {
        std::shared_ptr<const Scenario> scenario;
        WorldState state;
        /// By compared robot: what was measured at the start; nullopt where there is no ground truth. Such a robot is
        /// not in the world.
        std::vector<std::optional<RolloutStart>> starts;
        std::vector<std::size_t> bodies;  ///< by compared robot: in the scenario
    };
    /// At `start` on the session's clock, with commands for `duration`. Every compared robot has its control instant
    /// then; the other bodies begin as the scenario says.
    Opened openAt(std::size_t session, Nanoseconds start, Nanoseconds duration, std::uint64_t seed) const;

    /// What that world is made of, for callers that change something in it. Its bodies play() the starts.
    struct OpenedParts {
        ScenarioParts parts;
        std::vector<std::optional<RolloutStart>> starts;  ///< as in Opened
        std::vector<std::size_t> bodies;                  ///< likewise
    };
    OpenedParts partsAt(std::size_t session, Nanoseconds start, Nanoseconds duration) const;

    /// Lets a body of `parts` begin as `start` says, as fast as its model makes of that, and play the commands of the
    /// start's trajectory for `duration`. What its player reads changes none of them.
    static void play(ScenarioParts& parts, std::size_t body, const RolloutStart& start, Nanoseconds duration,
                     Attention reads = Attention::ofItself());

private:
    LogWorld(ScenarioParts parts, std::shared_ptr<const Log> log) : parts_(std::move(parts)), log_(std::move(log)) {}
    Expected<void> findRobots(const std::vector<std::string>& chosen);
    std::vector<bool> removedOf(const std::vector<std::string>& chosen);
    Expected<void> findSessions();
    void gatherAll();
    Expected<LogSession> sessionOf(const std::vector<std::size_t>& trajectories, bool first) const;

    ScenarioParts parts_;
    std::shared_ptr<const Log> log_;
    std::vector<ComparedRobot> robots_;
    std::vector<std::string> leftOut_;
    std::vector<LogExcerpt> excerpts_;  ///< by compared robot
    std::vector<LogSession> sessions_;
    std::vector<std::vector<TrackerHistory>> tracked_;  ///< by session and compared robot
    std::shared_ptr<const Scenario> allRobots_;
};

}  // namespace mrose
