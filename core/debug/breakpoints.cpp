#include "debug/breakpoints.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace mrose {
namespace {

/// Texts that were asked once and never again are not kept for ever.
constexpr std::size_t mostCompiled = 200;

bool isEvent(BreakKind kind) { return kind != BreakKind::condition && kind != BreakKind::divergence; }

std::string clockAt(const TimeTravel& run) {
    char text[40];
    std::snprintf(text, sizeof text, "%.2f s", toSeconds(run.setup().scene().timeOf(run.tick())));
    return text;
}

/// What happened at a tick of the shown branch. What a branch begins with has come about in the one before.
std::vector<TimelineMark> marksAt(const TimeTravel& run, std::int64_t tick) {
    std::vector<TimelineMark> marks;
    for (const BranchTicks& part : run.branches().parts(run.branch())) {
        if (tick < part.first || tick > part.last + (part.branch == run.branch() ? 0 : 1)) continue;
        const std::vector<TimelineMark>& all = run.branches().record(part.branch).marks();
        const auto begin = std::lower_bound(all.begin(), all.end(), tick,
                                            [](const TimelineMark& mark, std::int64_t t) { return mark.tick < t; });
        for (auto mark = begin; mark != all.end() && mark->tick == tick; ++mark) marks.push_back(*mark);
    }
    return marks;
}

std::string trimmedText(const std::string& text) {
    const auto begin = text.find_first_not_of(" \t\r\n");
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
}

/// Looks for marks up to a tick, of a file that has not been looked through yet.
Expected<void> learnMarks(TimeTravel& run, std::int64_t tick, const Progress& progress) {
    constexpr std::int64_t atOnce = 500;
    for (std::int64_t at = run.first(); at < tick + atOnce; at += atOnce) {
        if (auto learned = run.branches().learnUpTo(run.branch(), std::min(at, tick)); !learned) return learned;
        const double all = static_cast<double>(std::max<std::int64_t>(1, tick - run.first()));
        if (!progress(std::min(1.0, static_cast<double>(at - run.first()) / all))) break;
    }
    return {};
}

void join(std::string& text, const std::string& more, const char* between) {
    if (!text.empty() && !more.empty()) text += between;
    text += more;
}

}  // namespace

std::string wrongWith(const Error& error) {
    std::string text = error.cause;
    if (error.line > 1) text += " (line " + std::to_string(error.line) + ')';
    if (error.line == 1 && error.column > 0) text += " (at character " + std::to_string(error.column) + ')';
    return text;
}

void Breakpoints::forgetRun() {
    breakpoints_.clear();
    questions_.clear();
    compiled_.clear();
    fitElsewhere_.clear();
    evaluator_ = std::make_unique<ConditionEvaluator>();
    diverged_ = {};
    elsewhere_ = {};
    Breakpoint here;
    here.text = "breakHere()";
    add(here);
}

void Breakpoints::replace(const std::vector<Breakpoint>& breakpoints) {
    breakpoints_.clear();
    questions_.clear();
    ++version_;
    for (const Breakpoint& breakpoint : breakpoints) add(breakpoint);
}

std::uint32_t Breakpoints::add(Breakpoint breakpoint) {
    breakpoint.id = nextId_++;
    breakpoint.text = trimmedText(breakpoint.text);
    breakpoints_.push_back(std::move(breakpoint));
    ++version_;
    return breakpoints_.back().id;
}

void Breakpoints::change(const Breakpoint& breakpoint) {
    Breakpoint* const changed = find(breakpoint.id);
    if (changed == nullptr) return;
    const std::string before = std::exchange(*changed, breakpoint).text;
    changed->text = trimmedText(changed->text);
    // A new text is another question; who enables it again wants to know whether it fails again.
    if (changed->text != before) questions_.erase(breakpoint.id);
    if (changed->enabled) changed->error.clear();
    ++version_;
}

void Breakpoints::remove(std::uint32_t id) {
    std::erase_if(breakpoints_, [&](const Breakpoint& breakpoint) { return breakpoint.id == id; });
    questions_.erase(id);
    ++version_;
}

void Breakpoints::enableAll(bool enabled) {
    for (Breakpoint breakpoint : std::vector(breakpoints_)) {
        breakpoint.enabled = enabled;
        change(breakpoint);
    }
}

void Breakpoints::setDivergence(DivergenceQuestion diverged) {
    diverged_ = std::move(diverged);
    std::erase_if(questions_, [&](const auto& one) { return one.second.predicate != nullptr; });
    ++version_;
}

void Breakpoints::setHitsInOtherRuns(HitsInOtherRuns met) { elsewhere_ = std::move(met); }

void Breakpoints::forgetAnswers() {
    questions_.clear();
    compiled_.clear();
    fitElsewhere_.clear();
    ++version_;
}

/// In the runs before this one.
std::int64_t Breakpoints::metBefore(const Breakpoint& breakpoint) const {
    const auto met = elsewhere_.before.find(breakpoint.text);
    return met == elsewhere_.before.end() ? 0 : met->second;
}

Breakpoint* Breakpoints::find(std::uint32_t id) {
    const auto found = std::find_if(breakpoints_.begin(), breakpoints_.end(),
                                    [&](const Breakpoint& breakpoint) { return breakpoint.id == id; });
    return found == breakpoints_.end() ? nullptr : &*found;
}

/// Whether it holds is asked at every tick, instead of being read from the run's marks.
bool Breakpoints::asks(const Breakpoint& breakpoint) const {
    const BreakKind kind = readBreakText(breakpoint.text).kind;
    return breakpoint.enabled && (kind == BreakKind::condition || (kind == BreakKind::divergence && canDiverge()));
}

Question& Breakpoints::questionOf(const Breakpoint& breakpoint) {
    const auto known = questions_.find(breakpoint.id);
    if (known != questions_.end()) return known->second;
    const bool condition = readBreakText(breakpoint.text).kind == BreakKind::condition;
    return questions_.emplace(breakpoint.id, Question{breakpoint.text, condition ? nullptr : diverged_.holds})
        .first->second;
}

const Question* Breakpoints::knownOf(const Breakpoint& breakpoint) const {
    const auto known = questions_.find(breakpoint.id);
    return known == questions_.end() ? nullptr : &known->second;
}

std::vector<Question*> Breakpoints::questions(std::vector<std::uint32_t>* ids) {
    std::vector<Question*> all;
    for (const Breakpoint& breakpoint : breakpoints_) {
        if (!asks(breakpoint)) continue;
        all.push_back(&questionOf(breakpoint));
        if (ids != nullptr) ids->push_back(breakpoint.id);
    }
    return all;
}

Expected<Condition>& Breakpoints::compiled(const TimeTravel& run, const std::string& text) {
    const std::pair key(&run.setup(), text);
    const auto known = compiled_.find(key);
    if (known != compiled_.end()) return known->second;
    if (compiled_.size() >= mostCompiled) compiled_.clear();
    auto condition = compileCondition(text, *run.setup().scenario, "condition", run.reality().get());
    return compiled_.emplace(key, std::move(condition)).first->second;
}

/// Of a text that does not fit the shown branch.
bool Breakpoints::fitsElsewhere(const TimeTravel& run, const std::string& text) {
    const auto [known, isNew] = fitElsewhere_.try_emplace(text);
    if (isNew) known->second = checkBreakText(text, run.setup(), run.reality()).has_value();
    return known->second;
}

/// At the shown tick.
Expected<bool> Breakpoints::answer(const TimeTravel& run, const Question& question) {
    if (question.predicate) return question.predicate(run.branches(), run.owner(), run.tick());
    Expected<Condition>& condition = compiled(run, question.text);
    return condition ? condition->holds(run.moment()) : false;
}

void Breakpoints::leave(const TimeTravel& run) {
    for (Question* question : questions()) {
        Verdicts& known = question->known[run.owner()];
        if (!known.asked.contains(run.tick())) known.add(run.tick(), answer(run, *question));
    }
}

/// Whether one that begins to hold at a tick has done so as often as it is to; nullopt: the search was ended.
Expected<std::optional<bool>> Breakpoints::oftenEnough(const TimeTravel& run, const Breakpoint& breakpoint,
                                                       std::int64_t tick, const Progress& progress) {
    const std::int64_t asked = breakpoint.from - metBefore(breakpoint);
    if (asked <= 1) return true;
    Question& question = questionOf(breakpoint);
    BreakSearch search(run, *evaluator_);
    while (!search.knownUpTo(question, tick)) {
        if (!progress(0)) return std::nullopt;
        if (auto more = search.learn({&question}); !more) return tl::unexpected(more.error());
    }
    return search.beginningsUpTo(question, tick) >= asked;
}

Expected<std::optional<bool>> Breakpoints::meets(TimeTravel& run, const Breakpoint& breakpoint,
                                                 const Progress& progress) {
    const std::int64_t tick = run.tick();
    if (asks(breakpoint)) {
        const Question& question = questionOf(breakpoint);
        const BreakSearch search(run, *evaluator_);
        if (!search.holdsAt(question, tick) || search.holdsAt(question, tick - 1)) return false;
        return oftenEnough(run, breakpoint, tick, progress);
    }
    const BreakText text = readBreakText(breakpoint.text);
    if (!isEvent(text.kind)) return false;
    const auto meant = [&](const TimelineMark& mark) { return isMeant(text, mark, run.setup()); };
    const std::vector<TimelineMark> here = marksAt(run, tick);
    if (std::none_of(here.begin(), here.end(), meant)) return false;
    const std::int64_t asked = breakpoint.from - metBefore(breakpoint);
    if (asked <= 1) return true;
    const std::vector<TimelineMark> all = run.branches().marks(run.branch());
    return std::count_if(all.begin(), all.end(),
                         [&](const TimelineMark& mark) { return mark.tick <= tick && meant(mark); }) >= asked;
}

Expected<Breakpoints::Arrival> Breakpoints::arrive(TimeTravel& run, const Progress& progress) {
    if (auto learned = run.branches().learnUpTo(run.branch(), run.tick()); !learned)
        return tl::unexpected(learned.error());
    Stop stop{run.tick()};
    std::vector<std::uint32_t> ids;
    const std::vector<Question*> asked = questions(&ids);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        Verdicts& known = asked[i]->known[run.owner()];
        const std::size_t before = known.holds.ranges().size();
        if (!known.asked.contains(run.tick())) known.add(run.tick(), answer(run, *asked[i]));
        if (known.holds.ranges().size() != before) ++version_;
        if (known.failed.contains(run.tick())) {
            stop.ids = {ids[i]};
            stop.failed = true;
            return Arrival{stopped(run, stop)};
        }
    }
    for (const Breakpoint& breakpoint : breakpoints_) {
        if (!breakpoint.enabled) continue;
        const auto met = meets(run, breakpoint, progress);
        if (!met) return tl::unexpected(met.error());
        if (!*met) return Arrival{{}, false};
        if (**met) stop.ids.push_back(breakpoint.id);
    }
    if (stop.ids.empty()) return Arrival{};
    return Arrival{stopped(run, stop)};
}

Breakpoints::Answer Breakpoints::lastOfAll(TimeTravel& run, std::int64_t before, const Progress& progress,
                                           Looks looks) {
    if (auto known = learnMarks(run, before, progress); !known) return tl::unexpected(known.error());
    Stop stop{run.first() - 1};
    stop.backwards = true;
    const std::vector<TimelineMark> marks = run.branches().marks(run.branch());
    for (const Breakpoint& breakpoint : breakpoints_) {
        const BreakText text = readBreakText(breakpoint.text);
        if (!breakpoint.enabled || !isEvent(text.kind)) continue;
        const auto met = std::find_if(marks.rbegin(), marks.rend(), [&](const TimelineMark& mark) {
            return mark.tick < before && isMeant(text, mark, run.setup());
        });
        if (met == marks.rend() || met->tick < stop.tick) continue;
        if (met->tick > stop.tick) stop.ids.clear();
        stop.tick = met->tick;
        stop.ids.push_back(breakpoint.id);
    }
    std::vector<std::uint32_t> ids;
    const std::vector<Question*> asked = questions(&ids);
    BreakSearch search(run, *evaluator_);
    const auto found = (search.*looks)(before, asked, progress, stop.tick);
    ++version_;
    if (!found) return tl::unexpected(found.error());
    if (*found) stop = {(*found)->tick, {ids[(*found)->question]}, (*found)->failed, true};
    if (stop.ids.empty()) return std::nullopt;
    // What else was met there.
    for (std::size_t i = 0; i < asked.size() && !stop.failed; ++i) {
        const auto same = (search.*looks)(before, {asked[i]}, progress, stop.tick - 1);
        if (!same) return tl::unexpected(same.error());
        const bool met = *same && (*same)->tick == stop.tick && !(*same)->failed;
        if (met && std::find(stop.ids.begin(), stop.ids.end(), ids[i]) == stop.ids.end()) stop.ids.push_back(ids[i]);
    }
    return stop;
}

/// The conditions that stop at a tick as arrive() would. nullopt: none, or the search was ended.
Expected<std::optional<Breakpoints::Stop>> Breakpoints::conditionsAt(TimeTravel& run, std::int64_t tick,
                                                                     const Progress& progress) {
    Stop stop{tick};
    BreakSearch search(run, *evaluator_);
    for (const Breakpoint& breakpoint : breakpoints_) {
        if (!asks(breakpoint)) continue;
        const auto found = search.after(tick - 1, {&questionOf(breakpoint)}, progress, tick + 1);
        if (!found) return tl::unexpected(found.error());
        if (!*found) continue;
        if ((*found)->failed) return Stop{tick, {breakpoint.id}, true};
        const auto often = oftenEnough(run, breakpoint, tick, progress);
        if (!often) return tl::unexpected(often.error());
        if (often->value_or(false)) stop.ids.push_back(breakpoint.id);
    }
    if (stop.ids.empty()) return std::nullopt;
    return stop;
}

Breakpoints::Answer Breakpoints::ahead(TimeTravel& run, const Progress& progress, std::optional<std::int64_t> upTo) {
    const std::int64_t until = std::min(upTo.value_or(run.last()), run.last());
    if (auto known = learnMarks(run, until, progress); !known) return tl::unexpected(known.error());
    Stop stop{until + 1};
    const std::vector<TimelineMark> marks = run.branches().marks(run.branch());
    for (const Breakpoint& breakpoint : breakpoints_) {
        const BreakText text = readBreakText(breakpoint.text);
        if (!breakpoint.enabled || !isEvent(text.kind)) continue;
        std::int64_t count = metBefore(breakpoint);
        const auto met = std::find_if(marks.begin(), marks.end(), [&](const TimelineMark& mark) {
            return isMeant(text, mark, run.setup()) && ++count >= breakpoint.from && mark.tick > run.tick();
        });
        if (met == marks.end() || met->tick > std::min(stop.tick, until)) continue;
        if (met->tick < stop.tick) stop.ids.clear();
        stop.tick = met->tick;
        stop.ids.push_back(breakpoint.id);
    }
    const std::vector<Question*> asked = questions();
    BreakSearch search(run, *evaluator_);
    ++version_;
    for (std::int64_t from = run.tick();;) {
        const auto found = search.after(from, asked, progress, stop.tick);
        if (!found) return tl::unexpected(found.error());
        from = *found ? (*found)->tick : stop.tick;
        if (from > until) return std::nullopt;
        auto met = conditionsAt(run, from, progress);
        if (!met) return met;
        const bool event = !*found;
        if (*met && (!event || (*met)->failed)) return met;
        if (!event) continue;
        if (*met) stop.ids.insert(stop.ids.end(), (*met)->ids.begin(), (*met)->ids.end());
        return stop;
    }
}

Breakpoints::Answer Breakpoints::last(const BreakWish& wish, TimeTravel& run, std::int64_t before,
                                      const Progress& progress) {
    const std::string& text = wish.text;
    if (text.empty()) return lastOfAll(run, before, progress, &BreakSearch::lastBeginning);
    if (auto fits = checkBreakText(text, run.setup(), run.reality()); !fits) return tl::unexpected(fits.error());
    // As if it were the only one; what is known of one of the same text is of use.
    Breakpoints alone;
    alone.breakpoints_.clear();
    alone.diverged_ = diverged_;
    Breakpoint only;
    only.text = text;
    only.id = alone.add(only);
    for (const Breakpoint& breakpoint : breakpoints_)
        if (const Question* known = knownOf(breakpoint); known != nullptr && breakpoint.text == text)
            alone.questions_[only.id] = *known;
    Answer answer = alone.lastOfAll(run, before, progress, &BreakSearch::before);
    if (answer && *answer) {
        (*answer)->ids.clear();
        (*answer)->text = only.text;
    }
    for (const Breakpoint& breakpoint : breakpoints_)
        if (asks(breakpoint) && breakpoint.text == text)
            questionOf(breakpoint) = alone.questionOf(alone.breakpoints_[0]);
    return answer;
}

std::string Breakpoints::reasonOf(const TimeTravel& run, const std::string& waitsFor) const {
    const BreakText text = readBreakText(waitsFor);
    if (text.kind == BreakKind::condition) return std::string(text.name);
    if (text.kind == BreakKind::divergence)
        return diverged_.who ? diverged_.who(run.branches(), run.owner(), run.tick())
                             : "a robot leaves the trajectory of the log";
    if (text.kind == BreakKind::breakHere && text.name.empty() && !run.cursor().breakReason().empty())
        return run.cursor().breakReason();
    std::string reason;
    for (const TimelineMark& mark : marksAt(run, run.tick()))
        if (isMeant(text, mark, run.setup())) join(reason, textOf(mark, run.setup()), ", ");
    return reason;
}

std::string Breakpoints::stopped(const TimeTravel& run, const Stop& stop) {
    std::string reasons = stop.text.empty() ? "" : reasonOf(run, stop.text);
    if (!stop.text.empty() && stop.failed)
        if (const Expected<bool> failed = answer(run, Question{stop.text}); !failed)
            reasons += " fails here: " + wrongWith(failed.error());
    for (const std::uint32_t id : stop.ids) {
        Breakpoint* const breakpoint = find(id);
        if (breakpoint == nullptr) continue;
        std::string reason = reasonOf(run, breakpoint->text);
        if (stop.failed) {
            const Expected<bool> failed = answer(run, questionOf(*breakpoint));
            breakpoint->error = failed ? "failed" : wrongWith(failed.error());
            reason = "switched off, " + breakpoint->error + ": " + reason;
        }
        if (breakpoint->oneShot || stop.failed) {
            breakpoint->enabled = false;
            ++version_;
        }
        join(reasons, reason, "; ");
    }
    return (stop.backwards ? "Back at " : "Stopped at ") + clockAt(run) + ": " + reasons;
}

Expected<bool> Breakpoints::learn(const TimeTravel& run) {
    std::vector<Question*> open;
    for (Question* question : questions()) {
        // Of one that fails somewhere, no more is wanted before it gets there.
        const bool fails = std::any_of(question->known.begin(), question->known.end(),
                                       [](const auto& known) { return !known.second.failed.empty(); });
        if (!fails) open.push_back(question);
    }
    if (open.empty()) return false;
    Expected<bool> more = BreakSearch(run, *evaluator_).learn(open);
    if (more && *more) ++version_;
    return more;
}

std::vector<TimelineMark> Breakpoints::marks(const TimeTravel& run) const {
    std::vector<TimelineMark> marks;
    const BreakSearch search(run, *evaluator_);
    for (const Breakpoint& breakpoint : breakpoints_) {
        const Question* const question = knownOf(breakpoint);
        if (question == nullptr || !asks(breakpoint)) continue;
        for (const std::int64_t tick : search.beginnings(*question))
            marks.push_back({tick, TimelineMark::Kind::hit, breakpoint.id, noBody});
    }
    std::stable_sort(marks.begin(), marks.end(),
                     [](const TimelineMark& a, const TimelineMark& b) { return a.tick < b.tick; });
    return marks;
}

std::vector<BreakpointState> Breakpoints::states(const TimeTravel& run, const std::vector<TimelineMark>& happened) {
    std::vector<BreakpointState> states;
    const BreakSearch search(run, *evaluator_);
    for (const Breakpoint& breakpoint : breakpoints_) {
        BreakpointState& state = states.emplace_back(BreakpointState{breakpoint});
        const BreakText text = readBreakText(breakpoint.text);
        if (text.kind == BreakKind::condition) {
            if (const auto& condition = compiled(run, std::string(text.name)); !condition)
                state.unfit = wrongWith(condition.error());
        } else if (text.kind == BreakKind::divergence && !canDiverge()) {
            state.unfit = "no log is laid over the run yet";
        } else if (const auto fits = checkBreakHere(breakpoint.text, run.setup(), run.reality()); !fits) {
            state.unfit = fits.error().cause;
        }
        state.elsewhere = !state.unfit.empty() && fitsElsewhere(run, breakpoint.text);
        if (isEvent(text.kind)) {
            for (const TimelineMark& mark : happened) {
                if (!isMeant(text, mark, run.setup())) continue;
                ++state.inRun;
                if (mark.tick <= run.tick()) ++state.hits;
                state.here = state.here || mark.tick == run.tick();
            }
            state.known = run.branches().record(run.branch()).last() >= run.last();
        } else if (const Question* question = knownOf(breakpoint); question != nullptr) {
            state.hits = search.beginningsUpTo(*question, run.tick());
            state.inRun = search.beginningsUpTo(*question, run.last());
            state.known = search.knownUpTo(*question, run.last());
            state.here = search.holdsAt(*question, run.tick());
        }
        const auto after = elsewhere_.after.find(breakpoint.text);
        state.hits += metBefore(breakpoint);
        state.all = metBefore(breakpoint) + state.inRun + (after == elsewhere_.after.end() ? 0 : after->second);
    }
    return states;
}

}  // namespace mrose
