#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "break_search.h"
#include "breakpoint.h"

namespace mrose::gui {

/// A breakpoint and what is known of it in the shown branch's course.
struct BreakpointState {
    Breakpoint breakpoint;
    std::int64_t hits = 0;  ///< how often it has been met up to the shown tick
    std::int64_t all = 0;   ///< and in what has been simulated
    bool known = false;     ///< all of that has been looked at
    bool here = false;      ///< it holds at the shown tick
    std::string unfit;      ///< why it cannot hold in this course; empty: it can
};

/// The breakpoints of a run: they judge each tick that playing arrives at, and find where they held before and hold
/// next. Without Qt, thread or clock, as TimeTravel.
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
    void setDivergence(TickPredicate diverged);
    bool canDiverge() const { return diverged_ != nullptr; }

    /// Before playing goes on from the shown tick: who holds there begins nothing in the next.
    void leave(const TimeTravel& run);
    /// Playing has arrived at the shown tick: why it is to stop there; nothing: it is not.
    std::optional<std::string> arrive(TimeTravel& run);

    /// A place to go to, and what is to be said there once it is shown.
    struct Stop {
        std::int64_t tick = 0;
        std::vector<std::uint32_t> ids;
        bool failed = false;     ///< the expression could not be answered there
        bool backwards = false;  ///< it was looked for in the past
        std::string text = {};   ///< what was asked for, where it is none of the breakpoints
    };
    using Answer = Expected<std::optional<Stop>>;
    using Progress = BreakSearch::Progress;
    /// Where one of them was met last before the shown tick, as of BreakSearch::before(). How often counts for nothing.
    Answer back(TimeTravel& run, const Progress& progress);
    /// Where one of them stops next, in what has been simulated.
    Answer ahead(TimeTravel& run, const Progress& progress);
    /// Where such a text was met last before the shown tick, whether it is one of the breakpoints or not. Error: of the
    /// text, too.
    Answer last(TimeTravel& run, const std::string& text, const Progress& progress);
    /// The run stands at a stop: what is to be said there. Who is to stop only once, or failed, is disabled.
    std::string stopped(const TimeTravel& run, const Stop& stop);

    /// Looks at some more ticks of the shown course; whether there are more to look at.
    Expected<bool> learn(const TimeTravel& run);

    /// Where conditions and divergence are met in the shown course, in the order of time.
    std::vector<TimelineMark> marks(const TimeTravel& run) const;
    /// `happened` are the run's own marks.
    std::vector<BreakpointState> states(const TimeTravel& run, const std::vector<TimelineMark>& happened);
    /// Another one whenever marks() may have become others.
    std::uint64_t version() const { return version_; }

private:
    using Compiled = std::map<std::pair<const Course*, std::string>, Expected<Condition>>;

    Breakpoint* find(std::uint32_t id);
    bool asks(const Breakpoint& breakpoint) const;
    Question& questionOf(const Breakpoint& breakpoint);
    const Question* knownOf(const Breakpoint& breakpoint) const;
    std::vector<Question*> questions(std::vector<std::uint32_t>* ids = nullptr);
    Expected<Condition>& compiled(const Course& course, const std::string& text);
    Expected<bool> answer(const TimeTravel& run, const Question& question);
    Expected<void> coverUpTo(const TimeTravel& run, Question& question, std::int64_t tick, const Progress& progress);
    bool meets(TimeTravel& run, const BreakSearch& search, const Breakpoint& breakpoint);
    static std::string reasonOf(const TimeTravel& run, const std::string& waitsFor);

    std::vector<Breakpoint> breakpoints_;
    std::uint32_t nextId_ = 1;
    std::map<std::uint32_t, Question> questions_;  ///< of breakpoints that ask, by their number
    TickPredicate diverged_;
    std::unique_ptr<BlockJudge> judge_;
    Compiled compiled_;
    std::uint64_t version_ = 0;
};

/// What is wrong with an expression, in words that speak of it alone.
std::string wrongWith(const Error& error);

}  // namespace mrose::gui
