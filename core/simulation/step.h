#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "control/controller.h"
#include "motion/motion_model.h"
#include "physics/contact_task.h"
#include "scenario/scenario.h"
#include "sensing/radio_traffic.h"
#include "world/world_state.h"

namespace mrose {

/// Raised whenever the same state steps to other bits: recordings of another step are exact at their keyframes alone.
/// tests/reference/keep_hashes then makes the kept hashes anew.
constexpr int stepVersion = 3;

struct RobotDecision {
    std::uint32_t robot = 0;
    Decision decision;
};

/// What is decided from outside in a tick: by a recording, or by hand.
struct Overrides {
    std::span<const RobotDecision> decisions;  ///< these robots' controllers are not asked, at their control instants
    bool askControllers = true;                ///< false: robots not named above keep the command in force
};

/// What a debugger and a recording want to see of a tick and the state does not need. Never hashed.
struct StepTrace {
    struct Robot {
        bool decided = false;  ///< it was its control instant; what follows up to `predicted` is of it
        bool observed = false;
        Observation observation;
        Observation unread;  ///< what its own sensors gave beside that, where `asksUnread`
        Decision decision;
        MotionStep predicted;
        bool touched = false;  ///< contact took it off its way
        Pose planned;          ///< where it would be without
    };
    struct Kicked {
        std::uint32_t robot = 0, manipulator = 0;
        Nanoseconds due = 0;  ///< when it was
        bool hit = false;
        std::uint32_t object = 0;
        Point speed_W;  ///< that the object has now, m/s
    };
    struct Fault {
        std::uint32_t robot = 0;
        std::string what;  ///< "its controller gave a command that is not finite"
    };

    /// Asks for the readings of robots' [[sensor]]s that their controllers do not read, or that were not asked.
    bool asksUnread = false;
    /// Asks for Robot::observation, Robot::decision with what it annotates, and for messages.
    bool asksInsights = true;

    std::vector<Robot> robots;
    std::vector<ContactReport> contacts;
    std::vector<PendingKick> orderedKicks;
    std::vector<Kicked> kicks;
    std::vector<std::uint32_t> goals;  ///< in which a ball arrived
    std::vector<Fault> faults;
    /// Messages that were due to those that it was the control instant of. Broadcasts that were out of range are among
    /// them only up to so many times the range.
    static constexpr double outOfRangeNoted = 2;
    std::vector<Transmission> transmissions;
    std::vector<SentMessage> messages;  ///< that they are of
    std::vector<bool> touchedObjects;

    void clear(std::size_t robotCount, std::size_t objectCount);
};

/// Memory that a tick works in, kept from tick to tick for speed. Its content never matters to the result.
class StepBuffers {
public:
    StepBuffers();
    ~StepBuffers();
    StepBuffers(StepBuffers&&) noexcept;
    StepBuffers& operator=(StepBuffers&&) noexcept;

    struct Content;
    Content& content() { return *content_; }

private:
    std::unique_ptr<Content> content_;
};

/// One tick: observe, decide, issue, predict, touch. A pure function of scenario, state and overrides; `buffers` and
/// `trace` do not enter it. It neither throws nor prints: what goes wrong is in StepTrace::faults, and the robot
/// stands.
void step(const Scenario& scenario, WorldState& state, StepBuffers& buffers, const Overrides& overrides = {},
          StepTrace* trace = nullptr);

/// The same by values, at some cost in speed.
WorldState stepped(const Scenario& scenario, WorldState state, const Overrides& overrides = {},
                   StepTrace* trace = nullptr);

}  // namespace mrose
