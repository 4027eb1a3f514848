#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "debug/breakpoints.h"
#include "debug/run_frame.h"
#include "debug/time_travel.h"
#include "world/state_hash.h"

namespace mrose {

/// A branch as lists show it.
struct BranchInfo {
    std::string name;
    std::uint32_t parent = 0;
    std::int64_t departed = 0, first = 0, last = 0;  ///< ticks
    bool hidden = false;                             ///< as TimeTravel has it: not to be listed
    bool undone = false;                             ///< and can be done again
    /// What it consists of, in the order of time; itself, at the end, without one: it may grow.
    std::vector<BranchTicks> lineage = {};
    /// What happened in it, and before it in those that it came from, up to the shown tick.
    struct Events {
        int kicks = 0, contacts = 0;
        bool operator==(const Events&) const = default;
    };
    Events events;
    bool operator==(const BranchInfo&) const = default;
};

/// What just came about.
enum class RunEvent {
    none,
    playedOut,  ///< playing has come to where it ends
    broke,      ///< a breakpoint stopped it here
    noBreak     ///< a break was looked for in vain
};

/// What there is to be shown at a moment: all of one tick.
struct Shown {
    std::shared_ptr<const FieldFrame> frame;
    std::shared_ptr<const FieldFrame> beside;  ///< another branch at this tick or its nearest; may be nothing
    std::optional<std::uint32_t> besideBranch;
    BranchSetupPointer setup;
    StateHash hash;
    std::uint32_t branch = 0;
    std::int64_t first = 0, last = 0;
    std::vector<BranchInfo> branches;
    std::shared_ptr<const std::vector<TimelineMark>> marks;
    std::vector<BranchRecord::FirstFault> faults;  ///< up to the shown tick
    std::vector<BreakpointState> breakpoints;
    bool atBreak = false;             ///< one of them stopped it here
    bool canDiverge = false;          ///< a breakpoint on divergence has something to ask
    RunEvent event = RunEvent::none;  ///< reported once
    bool playing = false;
    bool canUndo = false, canRedo = false;
    std::string undoName, redoName;      ///< the edits that are taken back, and made again
    std::optional<std::size_t> subject;  ///< the body that an answer is about: to be selected
    std::optional<std::int64_t> goal;    ///< it is on its way to this tick
    std::string message;                 ///< why it stopped, or what went wrong; empty: nothing
    // Of who opens runs and plays them in real time.
    std::uint64_t run = 0;      ///< how many runs were opened before, and this one
    double realTimeFactor = 0;  ///< achieved; 0 while it stands

    std::int64_t tick() const { return frame->state.tick; }
};

/// Of those from `first` on, how many are to be listed.
int listedBranches(const std::vector<BranchInfo>& branches, std::size_t first = 0);
/// "1 branch", "2 branches"
std::string branchesText(int count);

/// What a run itself says of its shown tick; what only its debugger knows is left empty.
Shown shownOf(const TimeTravel& run, const FrameOptions& options);

}  // namespace mrose
