#include "recording/replay.h"

#include <cassert>

#include "io/format.h"
#include "recording/difference_text.h"
#include "recording/playback.h"
#include "recording/tick_decisions.h"
#include "scenario/first_version.h"

namespace mrose {
namespace {

std::string ordersText(const Decision& decision) {
    std::string text;
    const auto add = [&](const std::string& order) { text += (text.empty() ? "" : ", ") + order; };
    const auto commandText = [](const Command& c) { return "v " + numberText(c.v) + " w " + numberText(c.w); };
    for (const StampedCommand& earlier : decision.earlier)
        add(commandText(earlier.command) + " at " + std::to_string(earlier.time) + " ns");
    if (decision.command) add(commandText(*decision.command));
    for (const Kick& kick : decision.kicks)
        add("kick " + std::to_string(kick.manipulator) + " with " + numberText(kick.power));
    if (!decision.fault.empty()) add("fault: " + decision.fault);
    return text.empty() ? "nothing" : text;
}

/// One branch on its way.
class BranchReplay {
public:
    BranchReplay(const Scenario& scenario, const ReplayOptions& options, const Timeline& timeline)
        : scenario_(scenario), options_(options), blocks_(timeline.blocks()) {}

    Expected<void> start() {
        Expected<WorldState> state = parseStateOf(scenario_, blocks_.front().keyframe, "the beginning of a branch");
        if (!state) return tl::unexpected(state.error());
        if (const std::string wrong = validate(scenario_, *state); !wrong.empty())
            return fail({}, "it was recorded of another scenario: its beginning has " + wrong);
        state_ = std::move(*state);
        return {};
    }

    /// Whether all ticks of a block came out the same.
    bool run(const TimelineBlock& block) {
        DecisionReader decisions(block.decisions);
        while (state_.tick < block.last()) {
            advance(decisions);
            const SameHashes same = block.compare(scenario_, state_);
            if (same.world && (!options_.decide || same.memories)) continue;
            describe(block, decisions, same.world);
            return false;
        }
        return true;
    }
    ReplayDifference difference_;

private:
    void advance(DecisionReader& decisions) {
        decisions.next(options_.decide ? DecisionsOf::outside : DecisionsOf::all);
        step(scenario_, state_, buffers_, {decisions.decisions(), options_.decide},
             options_.decide ? &trace_ : nullptr);
    }

    void describe(const TimelineBlock& block, DecisionReader& rest, bool onlyMemories) {
        difference_.tick = state_.tick;
        if (onlyMemories) difference_.what = "what sensors or controllers remember differs; ";
        if (options_.decide) describeDecisions(block);
        const TimelineBlock* const next = blockAfter(block);
        if (next == nullptr) {
            difference_.what += "no state was kept at or after this tick, so that what differs is not known";
            return;
        }
        while (state_.tick < next->first) advance(rest);
        const Expected<WorldState> recorded = parseStateOf(scenario_, next->keyframe, {});
        if (next->first > difference_.tick)
            difference_.what += "at tick " + std::to_string(next->first) + ", where the next state was kept, ";
        const auto found =
            recorded ? firstDifference(*recorded, state_, options_.decide ? StateScope::all : StateScope::world)
                     : std::nullopt;
        difference_.what += found ? differenceText(scenario_, state_, *found) : "nothing differs any more";
    }

    /// Which controllers decided otherwise in the tick that led here.
    void describeDecisions(const TimelineBlock& block) {
        DecisionReader recorded(block.decisions);
        for (std::int64_t tick = block.first; tick < state_.tick; ++tick) recorded.next(DecisionsOf::all);
        for (const RobotDecision& then : recorded.decisions()) {
            if (then.robot >= trace_.robots.size()) continue;
            const Decision& now = trace_.robots[then.robot].decision;
            if (now.sameOrders(then.decision) && now.fault == then.decision.fault) continue;
            difference_.what += "the controller of " + robotText(scenario_, then.robot) + " had ordered " +
                                ordersText(then.decision) + " and now orders " + ordersText(now) + "; ";
        }
    }

    const TimelineBlock* blockAfter(const TimelineBlock& block) const {
        for (const TimelineBlock& other : blocks_)
            if (other.first > block.first && other.first >= state_.tick) return &other;
        return nullptr;
    }

    const Scenario& scenario_;
    const ReplayOptions& options_;
    const std::deque<TimelineBlock>& blocks_;
    WorldState state_;
    StepBuffers buffers_;
    StepTrace trace_;
};

}  // namespace

Expected<ReplayReport> replay(std::span<const Branch> branches, const Scenario& scenario,
                              const ReplayOptions& options) {
    const std::shared_ptr<const Scenario> borrowed(std::shared_ptr<const Scenario>(), &scenario);
    return replay(branches, std::vector(branches.size(), borrowed), options);
}

Expected<ReplayReport> replay(std::span<const Branch> branches,
                              std::span<const std::shared_ptr<const Scenario>> scenarios,
                              const ReplayOptions& options) {
    assert(scenarios.size() == branches.size());
    ReplayReport report;
    std::int64_t total = 0;
    for (const Branch& branch : branches) total += branch.timeline.last() - branch.timeline.first();
    for (std::uint32_t i = 0; i < branches.size(); ++i) {
        BranchReplay run(*scenarios[i], options, branches[i].timeline);
        if (const auto started = run.start(); !started) return tl::unexpected(started.error());
        for (const TimelineBlock& block : branches[i].timeline.blocks()) {
            if (!run.run(block)) {
                run.difference_.branch = i;
                report.difference = run.difference_;
                report.ticks += run.difference_.tick - block.first;
                return report;
            }
            report.ticks += block.last() - block.first;
            report.cancelled = options.progress && !options.progress(report.ticks, total);
            if (report.cancelled) return report;
        }
    }
    return report;
}

}  // namespace mrose
