#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "debug/condition_evaluator.h"
#include "debug/time_travel.h"
#include "io/progress.h"

namespace mrose {

/// What is known of a question in the branches of a run, by their numbers. Branches never change but grow, so that it
/// stays true.
using KnownVerdicts = std::map<std::uint32_t, Verdicts>;

/// Whether something holds at one of a branch's own ticks, asked in the session's thread.
using TickPredicate = std::function<bool(const BranchTree& branches, std::uint32_t branch, std::int64_t tick)>;

/// What is to be said of one.
using TickText = std::function<std::string(const BranchTree& branches, std::uint32_t branch, std::int64_t tick)>;

/// What is looked for: a condition's text or a predicate.
struct Question {
    std::string text;
    TickPredicate predicate = {};  ///< where it is one
    KnownVerdicts known = {};      ///< what the search finds out is added
};

/// Looks through the shown branch and those that it came from for where questions hold, without going there, and so far
/// as has been simulated. What is already known is not computed again; the rest is, block after block, on all cores.
class BreakSearch {
public:
    BreakSearch(const TimeTravel& run, ConditionEvaluator& evaluator)
        : run_(run), evaluator_(evaluator), parts_(run.branches().parts(run.branch())) {}

    struct Found {
        std::size_t question = 0;  ///< its place among those asked
        std::int64_t tick = 0;
        bool failed = false;  ///< it could not be answered there
    };
    /// nullopt: it holds nowhere, or the search was ended.
    using Answer = Expected<std::optional<Found>>;

    /// Where one of them last held before a tick: where it holds in the tick before, that stretch's beginning,
    /// otherwise the last tick at which it held. The latest of all of them, if it is later than `rival`.
    Answer before(std::int64_t tick, const std::vector<Question*>& questions, const Progress& progress,
                  std::optional<std::int64_t> rival = {});
    /// Where one of them last began to hold before a tick, or failed: where playing would have stopped, which is never
    /// at the first tick. The latest of all of them, if it is later than `rival`.
    Answer lastBeginning(std::int64_t tick, const std::vector<Question*>& questions, const Progress& progress,
                         std::optional<std::int64_t> rival = {});
    /// Where one of them begins to hold after a tick, at which it may hold. The earliest of all of them, if it is
    /// earlier than `rival`.
    Answer after(std::int64_t tick, const std::vector<Question*>& questions, const Progress& progress,
                 std::optional<std::int64_t> rival = {});
    /// Asks some blocks of which not all is known, from the first tick on; whether there are more.
    Expected<bool> learn(const std::vector<Question*>& questions);

    /// The ticks at which a stretch begins in which it holds, as far as is known. What holds at the first tick begins
    /// there.
    std::vector<std::int64_t> beginnings(const Question& question) const;
    /// How many there are up to a tick.
    std::int64_t beginningsUpTo(const Question& question, std::int64_t tick) const;
    /// Whether all up to a tick has been asked.
    bool knownUpTo(const Question& question, std::int64_t tick) const {
        return reachUp(question, &Verdicts::asked, first()) >= tick;
    }
    bool holdsAt(const Question& question, std::int64_t tick) const {
        return reachUp(question, &Verdicts::holds, tick) >= tick;
    }

private:
    using Set = TickRanges Verdicts::*;
    static const TickRanges& ticksOf(const Question& question, Set set, std::uint32_t branch);
    std::int64_t first() const { return parts_.front().first; }
    std::int64_t last() const { return parts_.back().last; }
    const BranchTicks& partOf(std::int64_t tick) const;
    std::int64_t reachDown(const Question& question, Set set, std::int64_t tick) const;
    std::int64_t reachUp(const Question& question, Set set, std::int64_t tick) const;
    std::optional<std::int64_t> lastUpTo(const Question& question, Set set, std::int64_t tick) const;
    std::optional<std::int64_t> firstFrom(const Question& question, Set set, std::int64_t tick) const;
    struct Known {
        bool whole = false;  ///< there is no more to be found out
        std::optional<Found> found;
    };
    Known knownBefore(const Question& question, std::int64_t tick) const;
    Known knownAfter(const Question& question, std::int64_t tick) const;
    Verdicts walk(const Question& question, const BlockTicks& block, std::uint32_t branch) const;
    Expected<void> ask(const std::vector<Question*>& questions, std::int64_t tick, bool backwards, std::size_t blocks);

    const TimeTravel& run_;
    ConditionEvaluator& evaluator_;
    std::vector<BranchTicks> parts_;
};

}  // namespace mrose
