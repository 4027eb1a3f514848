#include "debug/break_search.h"

#include <algorithm>
#include <cassert>

namespace mrose {
namespace {

/// Blocks asked at once: few at first, where an answer near is likely, then so many that threads do not wait for each
/// other, and that it can still be ended soon.
constexpr std::size_t fewBlocks = 2, manyBlocks = 16;

}  // namespace

const TickRanges& BreakSearch::ticksOf(const Question& question, Set set, std::uint32_t branch) {
    static const TickRanges none;
    const auto found = question.known.find(branch);
    return found == question.known.end() ? none : found->second.*set;
}

const BranchTicks& BreakSearch::partOf(std::int64_t tick) const {
    const auto found = std::lower_bound(parts_.begin(), parts_.end(), tick,
                                        [](const BranchTicks& part, std::int64_t t) { return part.last < t; });
    assert(found != parts_.end() && found->first <= tick);
    return *found;
}

/// The earliest tick from which on all up to `tick` are in the set; the one after `tick` where it is not in it itself.
std::int64_t BreakSearch::reachDown(const Question& question, Set set, std::int64_t tick) const {
    while (tick >= first() && tick <= last()) {
        const BranchTicks& part = partOf(tick);
        const TickRange* const range = ticksOf(question, set, part.branch).rangeOf(tick);
        if (range == nullptr) break;
        if (range->first > part.first) return range->first;
        tick = part.first - 1;
    }
    return tick + 1;
}

std::int64_t BreakSearch::reachUp(const Question& question, Set set, std::int64_t tick) const {
    while (tick >= first() && tick <= last()) {
        const BranchTicks& part = partOf(tick);
        const TickRange* const range = ticksOf(question, set, part.branch).rangeOf(tick);
        if (range == nullptr) break;
        if (range->last < part.last) return range->last;
        tick = part.last + 1;
    }
    return tick - 1;
}

std::optional<std::int64_t> BreakSearch::lastUpTo(const Question& question, Set set, std::int64_t tick) const {
    for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) {
        if (part->first > tick) continue;
        const auto found = ticksOf(question, set, part->branch).lastUpTo(std::min(tick, part->last));
        if (found && *found >= part->first) return found;
    }
    return {};
}

std::optional<std::int64_t> BreakSearch::firstFrom(const Question& question, Set set, std::int64_t tick) const {
    for (const BranchTicks& part : parts_) {
        if (part.last < tick) continue;
        const auto found = ticksOf(question, set, part.branch).firstFrom(std::max(tick, part.first));
        if (found && *found <= part.last) return found;
    }
    return {};
}

BreakSearch::Known BreakSearch::knownBefore(const Question& question, std::int64_t tick) const {
    const std::int64_t low = reachDown(question, &Verdicts::asked, tick - 1);
    const auto held = lastUpTo(question, &Verdicts::holds, tick - 1);
    const auto failed = lastUpTo(question, &Verdicts::failed, tick - 1);
    if (held && *held == tick - 1 && low < tick) {
        const std::int64_t begin = reachDown(question, &Verdicts::holds, *held);
        if (begin > low || low <= first()) return {true, Found{0, begin}};
        return {};
    }
    const std::int64_t latest = std::max(held.value_or(first() - 1), failed.value_or(first() - 1));
    if (latest >= std::max(low, first())) return {true, Found{0, latest, failed == latest}};
    return {low <= first(), {}};
}

BreakSearch::Known BreakSearch::knownAfter(const Question& question, std::int64_t tick) const {
    const std::int64_t high = reachUp(question, &Verdicts::asked, tick);
    const std::int64_t from = std::max(tick, reachUp(question, &Verdicts::holds, tick)) + 1;
    const auto begins = firstFrom(question, &Verdicts::holds, from);
    const auto failed = firstFrom(question, &Verdicts::failed, tick + 1);
    const std::int64_t earliest = std::min(begins.value_or(last() + 1), failed.value_or(last() + 1));
    if (earliest <= high) return {true, Found{0, earliest, failed == earliest}};
    return {high >= last(), {}};
}

/// Tick by tick: a predicate, or a condition that reads what sensors and controllers saw and remember, which are asked
/// again for it.
Verdicts BreakSearch::walk(const Question& question, const BlockTicks& block, std::uint32_t branch) const {
    Verdicts verdicts;
    if (question.predicate) {
        for (std::int64_t at = block.first; at <= block.last; ++at)
            verdicts.add(at, question.predicate(run_.branches(), branch, at));
        return verdicts;
    }
    const Scenario& scenario = *block.setup->scenario;
    const Reality* const reality = run_.reality().get();
    auto condition = compileCondition(question.text, scenario, "condition", reality);
    auto cursor = run_.branches().cursorAt(branch, block.first);
    for (std::int64_t at = block.first; at <= block.last; ++at) {
        if (cursor && at > block.first)
            if (auto done = run_.branches().advance(*cursor, branch); !done) cursor = tl::unexpected(done.error());
        verdicts.add(at, condition && cursor ? condition->holds(cursor->moment(scenario, reality)) : false);
    }
    return verdicts;
}

/// Asks in so many blocks, of which the first has `tick`, further ones lie before it or after it.
Expected<void> BreakSearch::ask(const std::vector<Question*>& questions, std::int64_t tick, bool backwards,
                                std::size_t most) {
    const BranchTicks& part = partOf(tick);
    const Timeline& timeline = run_.branches()[part.branch].timeline;
    const auto isEvaluated = [&](const Question& question) {
        return !question.predicate &&
               !readsControl(question.text, *run_.branches().record(part.branch).setup().scenario);
    };
    // A condition that walks does so on one core.
    if (std::any_of(questions.begin(), questions.end(),
                    [&](const Question* one) { return !one->predicate && !isEvaluated(*one); }))
        most = std::min(most, fewBlocks);
    std::vector<BlockTicks> blocks;
    for (std::int64_t at = tick; blocks.size() < most && at >= part.first && at <= part.last;) {
        const TimelineBlock& block = timeline.blockOf(std::max(at - 1, timeline.first()));
        const std::int64_t begin = block.first == timeline.first() ? block.first : block.first + 1;
        blocks.push_back({&run_.branches().record(part.branch).setup(), &block, std::max(begin, part.first),
                          std::min(block.last(), part.last)});
        at = backwards ? blocks.back().first - 1 : blocks.back().last + 1;
    }
    std::vector<std::string> texts;
    std::vector<Question*> conditions;
    for (Question* question : questions) {
        if (isEvaluated(*question)) {
            texts.push_back(question->text);
            conditions.push_back(question);
            continue;
        }
        for (const BlockTicks& block : blocks) question->known[part.branch].add(walk(*question, block, part.branch));
    }
    if (conditions.empty()) return {};
    const auto verdicts = evaluator_.evaluate(blocks, texts, run_.reality());
    if (!verdicts) return tl::unexpected(verdicts.error());
    for (const std::vector<Verdicts>& ofBlock : *verdicts)
        for (std::size_t i = 0; i < conditions.size(); ++i) conditions[i]->known[part.branch].add(ofBlock[i]);
    return {};
}

BreakSearch::Answer BreakSearch::before(std::int64_t tick, const std::vector<Question*>& questions,
                                        const Progress& progress, std::optional<std::int64_t> rival) {
    tick = std::min(tick, last() + 1);
    const std::int64_t notBefore = rival.value_or(first() - 1);
    for (std::size_t blocks = fewBlocks;; blocks = std::min(2 * blocks, manyBlocks)) {
        std::optional<Found> latest;
        for (std::size_t i = 0; i < questions.size(); ++i) {
            const Known known = knownBefore(*questions[i], tick);
            if (known.found && known.found->tick > (latest ? latest->tick : notBefore))
                latest = Found{i, known.found->tick, known.found->failed};
        }
        // Of the others, those that could still hold later than that.
        std::vector<Question*> open;
        std::int64_t low = first();
        for (Question* question : questions) {
            const std::int64_t from = reachDown(*question, &Verdicts::asked, tick - 1);
            if (knownBefore(*question, tick).whole || from <= (latest ? latest->tick : notBefore)) continue;
            open.push_back(question);
            low = std::max(low, from);
        }
        if (open.empty()) return latest;
        const double all = static_cast<double>(std::max<std::int64_t>(1, tick - first()));
        if (!progress(static_cast<double>(tick - low) / all)) return std::nullopt;
        if (auto asked = ask(open, low - 1, true, blocks); !asked) return tl::unexpected(asked.error());
    }
}

BreakSearch::Answer BreakSearch::lastBeginning(std::int64_t tick, const std::vector<Question*>& questions,
                                               const Progress& progress, std::optional<std::int64_t> rival) {
    std::optional<Found> latest;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const std::int64_t notBefore = std::max(first(), latest ? latest->tick : rival.value_or(first()));
        Answer found = before(tick, {questions[i]}, progress, notBefore);
        if (found && *found && !(*found)->failed)
            found = before((*found)->tick + 1, {questions[i]}, progress, notBefore);
        if (!found) return found;
        if (*found) latest = Found{i, (*found)->tick, (*found)->failed};
    }
    return latest;
}

BreakSearch::Answer BreakSearch::after(std::int64_t tick, const std::vector<Question*>& questions,
                                       const Progress& progress, std::optional<std::int64_t> rival) {
    tick = std::max(tick, first());
    const std::int64_t notAfter = rival.value_or(last() + 1);
    for (std::size_t blocks = fewBlocks;; blocks = std::min(2 * blocks, manyBlocks)) {
        std::optional<Found> earliest;
        for (std::size_t i = 0; i < questions.size(); ++i) {
            const Known known = knownAfter(*questions[i], tick);
            if (known.found && known.found->tick < (earliest ? earliest->tick : notAfter))
                earliest = Found{i, known.found->tick, known.found->failed};
        }
        std::vector<Question*> open;
        std::int64_t high = last();
        for (Question* question : questions) {
            const std::int64_t to = reachUp(*question, &Verdicts::asked, tick);
            if (knownAfter(*question, tick).whole || to >= (earliest ? earliest->tick : notAfter) - 1) continue;
            open.push_back(question);
            high = std::min(high, to);
        }
        if (open.empty()) return earliest;
        const double all = static_cast<double>(std::max<std::int64_t>(1, last() - tick));
        if (!progress(static_cast<double>(high - tick) / all)) return std::nullopt;
        if (auto asked = ask(open, high + 1, false, blocks); !asked) return tl::unexpected(asked.error());
    }
}

Expected<bool> BreakSearch::learn(const std::vector<Question*>& questions) {
    std::vector<Question*> open;
    std::int64_t next = last();
    for (Question* question : questions) {
        const std::int64_t known = reachUp(*question, &Verdicts::asked, first());
        if (known >= last()) continue;
        open.push_back(question);
        next = std::min(next, known + 1);
    }
    if (open.empty()) return false;
    if (auto asked = ask(open, next, false, fewBlocks); !asked) return tl::unexpected(asked.error());
    return true;
}

std::vector<std::int64_t> BreakSearch::beginnings(const Question& question) const {
    std::vector<std::int64_t> ticks;
    for (const BranchTicks& part : parts_)
        for (const TickRange& range : ticksOf(question, &Verdicts::holds, part.branch).ranges()) {
            if (range.last < part.first) continue;
            if (range.first > part.last) break;
            const std::int64_t begin = std::max(range.first, part.first);
            if (begin == first() || !holdsAt(question, begin - 1)) ticks.push_back(begin);
        }
    return ticks;
}

std::int64_t BreakSearch::beginningsUpTo(const Question& question, std::int64_t tick) const {
    std::int64_t count = 0;
    for (const BranchTicks& part : parts_) {
        if (part.first > tick) break;
        const TickRanges& holds = ticksOf(question, &Verdicts::holds, part.branch);
        count += holds.beginningsWithin(part.first + 1, std::min(tick, part.last));
        const bool here = holds.contains(part.first);
        count += here && (part.first == first() || !holdsAt(question, part.first - 1)) ? 1 : 0;
    }
    return count;
}

}  // namespace mrose
