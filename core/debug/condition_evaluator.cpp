#include "debug/condition_evaluator.h"

#include <map>
#include <optional>

#include "learning/parallel_for.h"
#include "recording/tick_decisions.h"
#include "scenario/first_version.h"
#include "scenario/state_validation.h"
#include "simulation/step.h"

namespace mrose {

void Verdicts::add(std::int64_t tick, const Expected<bool>& answer) {
    asked.add(tick);
    if (!answer)
        failed.add(tick);
    else if (*answer)
        holds.add(tick);
}

void Verdicts::add(const Verdicts& others) {
    for (const TickRange& range : others.asked.ranges()) asked.add(range.first, range.last);
    for (const TickRange& range : others.holds.ranges()) holds.add(range.first, range.last);
    for (const TickRange& range : others.failed.ranges()) failed.add(range.first, range.last);
}

/// What a thread works with: an interpreter serves one at a time.
struct ConditionEvaluator::Worker {
    StepBuffers buffers;
    StepTrace trace;
    const Scenario* scenario = nullptr;
    RealityPointer reality;
    std::map<std::string, Expected<Condition>> known;  ///< compiled for both

    std::vector<Condition*> compiled(const Scenario& wanted, std::span<const std::string> texts,
                                     const RealityPointer& real);
    Expected<std::vector<Verdicts>> evaluate(const BlockTicks& ticks, std::span<const std::string> texts,
                                             const RealityPointer& real);
};

/// nullptr: it does not compile.
std::vector<Condition*> ConditionEvaluator::Worker::compiled(const Scenario& wanted, std::span<const std::string> texts,
                                                             const RealityPointer& real) {
    if (scenario != &wanted || reality != real) known.clear();
    scenario = &wanted;
    reality = real;
    std::vector<Condition*> all;
    for (const std::string& text : texts) {
        auto found = known.find(text);
        if (found == known.end())
            found = known.emplace(text, compileCondition(text, wanted, "condition", real.get())).first;
        all.push_back(found->second ? &*found->second : nullptr);
    }
    return all;
}

Expected<std::vector<Verdicts>> ConditionEvaluator::Worker::evaluate(const BlockTicks& ticks,
                                                                     std::span<const std::string> texts,
                                                                     const RealityPointer& real) {
    const Scenario& world = *ticks.setup->scenario;
    const TimelineBlock& block = *ticks.block;
    const std::vector<Condition*> conditions = compiled(world, texts, real);
    Expected<WorldState> state = parseStateOf(world, block.keyframe, "keyframe of tick " + std::to_string(block.first));
    if (!state) return tl::unexpected(state.error());
    if (!validate(world, *state).empty() || state->tick != block.first)
        return fail({}, "the state kept of tick " + std::to_string(block.first) + " is none of this scenario");
    std::vector<Verdicts> verdicts(texts.size());
    const auto ask = [&](const StepTrace* step) {
        const Moment at{&world, &*state, step, {}, real.get()};
        for (std::size_t i = 0; i < verdicts.size(); ++i)
            verdicts[i].add(state->tick, conditions[i] != nullptr ? conditions[i]->holds(at) : false);
    };
    if (ticks.first == block.first) ask(nullptr);
    DecisionReader reader(block.decisions);
    while (state->tick < ticks.last) {
        if (!reader.next(DecisionsOf::all))
            return fail({}, "the decisions of tick " + std::to_string(state->tick) + " are damaged");
        step(world, *state, buffers, {reader.decisions(), false}, &trace);
        if (state->tick >= ticks.first) ask(&trace);
    }
    return verdicts;
}

ConditionEvaluator::ConditionEvaluator() = default;
ConditionEvaluator::~ConditionEvaluator() = default;

std::unique_ptr<ConditionEvaluator::Worker> ConditionEvaluator::takeWorker() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<Worker>();
    std::unique_ptr<Worker> worker = std::move(idle_.back());
    idle_.pop_back();
    return worker;
}

Expected<std::vector<std::vector<Verdicts>>> ConditionEvaluator::evaluate(std::span<const BlockTicks> blocks,
                                                                          std::span<const std::string> texts,
                                                                          const RealityPointer& reality) {
    std::vector<Expected<std::vector<Verdicts>>> answers(blocks.size());
    parallelFor(blocks.size(), [&](std::size_t i) {
        std::unique_ptr<Worker> worker = takeWorker();
        answers[i] = worker->evaluate(blocks[i], texts, reality);
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(worker));
    });
    std::vector<std::vector<Verdicts>> all;
    for (Expected<std::vector<Verdicts>>& answer : answers) {
        if (!answer) return tl::unexpected(answer.error());
        all.push_back(std::move(*answer));
    }
    return all;
}

}  // namespace mrose
