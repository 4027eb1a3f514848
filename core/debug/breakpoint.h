#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "assessment/reality.h"
#include "debug/branch_setup.h"
#include "debug/timeline_mark.h"
#include "io/error.h"

namespace mrose {

enum class BreakKind : std::uint8_t { condition, contact, kick, goal, fault, breakHere, divergence };

/// What stops a run. Its text is a condition (core/condition), or one of these words: "contact", "kick", "goal" and
/// "fault", with the name of a body or a goal behind them where only that one counts; "breakHere()", which controllers
/// call; "divergence" from the real log that is laid over.
struct Breakpoint {
    std::uint32_t id = 0;  ///< given when it is added
    std::string text;
    bool enabled = true;
    bool oneShot = false;  ///< disabled once it has stopped
    int from = 1;          ///< it stops from this time on: earlier ones are counted
    std::string error;     ///< what became of it at run time; empty: nothing

    bool operator==(const Breakpoint&) const;
};

/// A breakpoint's text in parts.
struct BreakText {
    BreakKind kind = BreakKind::condition;
    std::string_view name;  ///< of the body or goal that counts; empty: any. Of a condition: all of it
};
BreakText readBreakText(std::string_view text);

/// What conditions ask of the real log; null: none is open.
using RealityPointer = std::shared_ptr<const Reality>;
/// Whether both hold the same real robots, whatever models they have.
bool isSameTruth(const RealityPointer& a, const RealityPointer& b);

/// Error: a condition that does not compile, a body or goal that the scenario does not have. A robot of the real log
/// that is not in this rollout may be in others: Reality::allRobots knows them.
Expected<void> checkBreakText(std::string_view text, const BranchSetup& setup, const RealityPointer& reality);

/// The same of this rollout alone.
Expected<void> checkBreakHere(std::string_view text, const BranchSetup& setup, const RealityPointer& reality);

/// Whether a mark of the timeline is what such a breakpoint waits for.
bool isMeant(const BreakText& text, const TimelineMark& mark, const BranchSetup& setup);

/// "red 1 touches ball": a mark that stopped the run, in words.
std::string textOf(const TimelineMark& mark, const BranchSetup& setup);

}  // namespace mrose
