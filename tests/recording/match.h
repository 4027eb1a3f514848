#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "simulation/step.h"

namespace mrose {

/// Drives about, remembers what it did, goes for the ball where it sees it, kicks now and then.
class Rover final : public Controller {
public:
    struct Memory {
        std::int64_t decisions = 0;
        double lastTurn = 0;
    };
    /// `variant` changes what it decides from `from` on; `asked` counts how often it was.
    explicit Rover(int variant = 0, Nanoseconds from = 0, int* asked = nullptr)
        : variant_(variant), from_(from), asked_(asked) {}
    std::size_t memorySize() const override { return sizeof(Memory); }
    std::size_t commandsPerPeriod(Nanoseconds) const override { return 2; }
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    int variant_;
    Nanoseconds from_;
    int* asked_;
};

struct MatchOptions {
    std::uint32_t robots = 8;
    bool lively = true;  ///< latency and noise of sensors and motion, dead times, random factor
    std::shared_ptr<const Controller> controller = std::make_shared<const Rover>();
};

/// Robots of two kinds with kickers and kinematic models in a walled field with goals, a ball and a box: many contacts.
ScenarioParts matchParts(const MatchOptions& options = {});

/// All states of a run, from the initial one on, and what recorders need of each tick.
struct StraightRun {
    std::vector<WorldState> states;
    std::vector<StepTrace> traces;  ///< traces[i] leads from states[i] to states[i + 1]
};
/// `outside` may give decisions from outside for a tick.
using OutsideDecisions = std::function<std::vector<RobotDecision>(std::int64_t tick)>;
StraightRun runMatch(const Scenario& scenario, const WorldState& start, std::int64_t ticks,
                     const OutsideDecisions& outside = {});

}  // namespace mrose
