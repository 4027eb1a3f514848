#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "debug/branch_record.h"
#include "debug/branch_setup.h"
#include "debug/field_frame.h"

namespace mrose {

/// What is changed by hand at a tick. It begins a branch.
struct Edit {
    std::string name;  ///< of the branch
    /// nullopt: the shown tick. Before it: the branch begins there, where the shown branch was then.
    std::optional<std::int64_t> tick = {};
    std::function<void(const Scenario&, WorldState&)> change = {};  ///< of the state there; may be empty
    std::vector<HandOrder> orders = {};
    /// This robot has observed and decided in that tick as it did, and then gets another command: what its sensors and
    /// its controller remember is that of after its decision. The tick after must be known.
    std::optional<std::uint32_t> afterDeciding = {};
    BranchSetupPointer setup = {};         ///< another one; null: as before
    std::optional<WorldState> start = {};  ///< in another setup: begins with this state instead of the one that was
    std::string note = {};                 ///< said of it instead of the usual; may be empty
};

/// A body in another place, or turned; an object lies still there.
Edit moveBody(const FieldFrame& frame, std::size_t body, const Pose& pose);
/// The same at the nearest place where nothing is in its way, which the note says. Error: there is none near.
Expected<Edit> putBody(const FieldFrame& frame, std::size_t body, const Pose& pose);
/// What a robot is to do instead of what it decided last, for so many control periods; its sensors and its controller
/// have seen and remember what they did. Without an insight there is no such edit: `frame.insights[robot].tick` >= 0.
struct OtherDecision {
    Command command;
    std::vector<Kick> kicks = {};
    int periods = 1;
};
Edit changeDecision(const FieldFrame& frame, std::size_t robot, const OtherDecision& other);
/// What it decided, or the command that was in force.
Command decidedCommand(const FieldFrame& frame, std::size_t robot);

/// The shown state with other noise from there on.
Edit changeNoise();
/// From the run's start with another seed.
Edit restartWithSeed(const BranchSetupPointer& setup, std::uint64_t seed);
/// The shown state in another setup, whose parts keep what they remember where they can; `name` says what is changed.
Edit changeSetup(const std::string& name, const BranchSetupPointer& from, BranchSetupPointer to);

}  // namespace mrose
