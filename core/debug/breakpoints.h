#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "debug/break_search.h"
#include "debug/breakpoint.h"

namespace mrose {

/// How often breakpoints were met in the runs that go before this one and that follow it, by their texts.
struct HitsInOtherRuns {
    std::map<std::string, std::int64_t> before, after;
};

/// A breakpoint and what is known of it in the shown branch.
struct BreakpointState {
    Breakpoint breakpoint;
    std::int64_t hits = 0;   ///< how often it has been met up to the shown tick, with what was before this run
    std::int64_t all = 0;    ///< and in all that has been simulated, with what was elsewhere
    std::int64_t inRun = 0;  ///< of that, in this run
    bool known = false;      ///< all of that has been looked at
    bool here = false;       ///< it holds at the shown tick
    std::string unfit;       ///< why it cannot hold in this scenario; empty: it can
    bool elsewhere = false;  ///< the missing robot is in other rollouts of the log
};

/// Which break is looked for.
struct BreakWish {
    bool back = false;      ///< the last one; otherwise the next
    std::string text = {};  ///< where this was met last, whether it is a breakpoint or not; empty: any of them
    bool operator==(const BreakWish&) const = default;
};

/// The breakpoints of a run: they are asked at each tick that playing arrives at, and find where they held before and
/// hold next. Without Qt, thread or clock, as TimeTravel.
class Breakpoints {
public:
    Breakpoints() { forgetRun(); }

    /// Another run: nothing but breakHere() stops it.
    void forgetRun();
    const std::vector<Breakpoint>& all() const { return breakpoints_; }
    /// These and no others.
    void replace(const std::vector<Breakpoint>& breakpoints);
    /// Its number.
    std::uint32_t add(Breakpoint breakpoint);
    /// In the place of the one with its number, if there is one.
    void change(const Breakpoint& breakpoint);
    void remove(std::uint32_t id);
    void enableAll(bool enabled);
    /// What "divergence" asks; empty: no log is laid over.
    struct DivergenceQuestion {
        TickPredicate holds = {};
        TickText who = {};  ///< may be empty
    };
    void setDivergence(DivergenceQuestion diverged);
    bool canDiverge() const { return diverged_.holds != nullptr; }

    /// This run is one of several that follow each other: counts go on from those before.
    void setHitsInOtherRuns(HitsInOtherRuns met);
    /// Another real log lies beside the run, or none any more: what conditions gave is no longer true.
    void forgetAnswers();

    /// Before playing goes on from the shown tick: what holds there does not begin to hold in the next.
    void leave(const TimeTravel& run);
    /// A place to go to, and what is to be said there once it is shown.
    struct Stop {
        std::int64_t tick = 0;
        std::vector<std::uint32_t> ids;
        bool failed = false;     ///< the expression could not be answered there
        bool backwards = false;  ///< it was looked for in the past
        std::string text = {};   ///< what was asked for, where it is none of the breakpoints
    };
    using Answer = Expected<std::optional<Stop>>;
    /// Why playing is to stop at a tick; nullopt: it is not, or that was not found out (`known`) when it was to end.
    struct Arrival {
        std::optional<std::string> why = {};
        bool known = true;
    };
    /// Playing has arrived at the shown tick. How often something was met before may take a search.
    Expected<Arrival> arrive(TimeTravel& run, const Progress& progress);
    /// Where one of them was met last before a tick, as playing meets it; with a text as of BreakSearch::before(), as
    /// if it were the only one. How often counts for nothing. Error: of the text, too.
    Answer last(const BreakWish& wish, TimeTravel& run, std::int64_t before, const Progress& progress);
    /// Where one of them stops next, in what has been simulated; up to a tick, if one is given.
    Answer ahead(TimeTravel& run, const Progress& progress, std::optional<std::int64_t> upTo = {});
    /// The run stands at a stop: what is to be said there. A breakpoint that is to stop only once, or failed, is
    /// disabled.
    std::string stopped(const TimeTravel& run, const Stop& stop);

    /// Looks at some more ticks of the shown branch; whether there are more to look at.
    Expected<bool> learn(const TimeTravel& run);

    /// Where conditions and divergence are met in the shown branch, in the order of time.
    std::vector<TimelineMark> marks(const TimeTravel& run) const;
    /// `happened` are the run's own marks.
    std::vector<BreakpointState> states(const TimeTravel& run, const std::vector<TimelineMark>& happened);
    /// Another one whenever marks() may have become others.
    std::uint64_t version() const { return version_; }

private:
    using Compiled = std::map<std::pair<const BranchSetup*, std::string>, Expected<Condition>>;

    using Looks = BreakSearch::Answer (BreakSearch::*)(std::int64_t tick, const std::vector<Question*>& questions,
                                                       const Progress& progress, std::optional<std::int64_t> rival);
    Answer lastOfAll(TimeTravel& run, std::int64_t before, const Progress& progress, Looks looks);
    Breakpoint* find(std::uint32_t id);
    bool asks(const Breakpoint& breakpoint) const;
    Question& questionOf(const Breakpoint& breakpoint);
    const Question* knownOf(const Breakpoint& breakpoint) const;
    std::vector<Question*> questions(std::vector<std::uint32_t>* ids = nullptr);
    Expected<Condition>& compiled(const TimeTravel& run, const std::string& text);
    bool fitsElsewhere(const TimeTravel& run, const std::string& text);
    std::int64_t metBefore(const Breakpoint& breakpoint) const;
    Expected<bool> answer(const TimeTravel& run, const Question& question);
    /// At the shown tick, and that often enough; nullopt: the search was ended.
    Expected<std::optional<bool>> meets(TimeTravel& run, const Breakpoint& breakpoint, const Progress& progress);
    Expected<std::optional<Stop>> conditionsAt(TimeTravel& run, std::int64_t tick, const Progress& progress);
    Expected<std::optional<bool>> oftenEnough(const TimeTravel& run, const Breakpoint& breakpoint, std::int64_t tick,
                                              const Progress& progress);
    std::string reasonOf(const TimeTravel& run, const std::string& waitsFor) const;

    std::vector<Breakpoint> breakpoints_;
    std::uint32_t nextId_ = 1;
    std::map<std::uint32_t, Question> questions_;  ///< of breakpoints that ask, by their number
    DivergenceQuestion diverged_;
    HitsInOtherRuns elsewhere_;
    std::unique_ptr<ConditionEvaluator> evaluator_;
    Compiled compiled_;
    std::map<std::string, bool> fitElsewhere_;  ///< texts that do not fit the shown branch
    std::uint64_t version_ = 0;
};

/// What is wrong with an expression, in words that speak of it alone.
std::string wrongWith(const Error& error);

}  // namespace mrose
