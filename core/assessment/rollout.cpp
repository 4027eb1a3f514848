#include "assessment/rollout.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "io/format.h"
#include "io/value_bytes.h"
#include "world/noise.h"
#include "world/noise_channel.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// Robots that advance together: enough for a model to profit, few enough for their histories to stay in the cache.
constexpr std::size_t batchSize = 512;

/// A robot under way: its commands so far and where the model has brought it.
struct Runner {
    const RolloutStart* start = nullptr;
    CommandHistory history;
    std::size_t next = 0;  ///< the first command not yet issued
    Pose pose;
    Velocity velocity;
    std::vector<std::byte> memory;  ///< the model's
};

void issueUntil(Runner& runner, Nanoseconds time) {
    const auto& commands = runner.start->trajectory->commands;
    for (; runner.next < commands.size() && commands[runner.next].time <= time; ++runner.next)
        runner.history.issue(commands[runner.next].time, commands[runner.next].command);
}

/// Where the commands begin that are known at `time`: with the one in force `lead` before.
struct Beginning {
    std::size_t first = 0;
    std::optional<StampedCommand> before;  ///< of a steady trajectory, which has none so early
};
Beginning beginningOf(const Trajectory& trajectory, Nanoseconds time, Nanoseconds lead) {
    const auto& commands = trajectory.commands;
    const auto later = std::upper_bound(commands.begin(), commands.end(), time - lead,
                                        [](Nanoseconds t, const StampedCommand& c) { return t < c.time; });
    if (later != commands.begin()) return {static_cast<std::size_t>(later - commands.begin()) - 1, std::nullopt};
    if (!trajectory.steady || commands.empty()) return {};
    return {0, StampedCommand{std::min(commands.front().time, time - lead), commands.front().command}};
}

/// The history as it is at `time`.
Runner prepare(const MotionModel& model, const RolloutStart& start, Nanoseconds time, Nanoseconds lead) {
    Runner runner;
    runner.start = &start;
    runner.memory.resize(model.memorySize());
    model.start(runner.memory);
    model.adapt(runner.memory, start.tracked);
    const Beginning beginning = beginningOf(*start.trajectory, time, lead);
    if (beginning.before) runner.history.issue(beginning.before->time, beginning.before->command);
    runner.next = beginning.first;
    issueUntil(runner, time);
    model.recall(runner.memory, runner.history, time);
    return runner;
}

enum class Drawn { nothing, noise };

/// Moves every runner from its own start time + `elapsed` through one period.
void advance(const MotionModel& model, std::span<Runner> runners, Nanoseconds elapsed, const RolloutOptions& options,
             Drawn drawn, std::vector<MotionInput>& inputs, std::vector<MotionStep>& steps) {
    inputs.resize(runners.size());
    steps.resize(runners.size());
    for (std::size_t i = 0; i < runners.size(); ++i) {
        const Nanoseconds now = runners[i].start->time + elapsed;
        issueUntil(runners[i], now);
        inputs[i] = {&runners[i].history, now, runners[i].velocity, runners[i].memory};
        if (drawn == Drawn::noise && runners[i].start->seed)
            inputs[i].noise = NoiseKey{*runners[i].start->seed, elapsed / options.tick, runners[i].start->body,
                                       channelOf(NoiseChannel::motion)};
    }
    model.predict(inputs, steps);
    for (std::size_t i = 0; i < runners.size(); ++i) {
        runners[i].pose = runners[i].pose * steps[i].increment;
        runners[i].velocity = steps[i].velocity;
    }
}

/// Advances the starts with these indices, longest first, so that those still under way are always the first ones.
void rollOutBatch(const MotionModel& model, std::span<const RolloutStart> starts, std::span<const std::size_t> order,
                  const RolloutOptions& options, std::vector<std::vector<Pose>>& poses) {
    std::vector<Runner> runners;
    runners.reserve(order.size());
    for (const std::size_t i : order) {
        runners.push_back(prepare(model, starts[i], starts[i].time, options.lead));
        runners.back().pose = starts[i].pose;
        runners.back().velocity = starts[i].velocity->velocity;
        poses[i].reserve(static_cast<std::size_t>(std::max(0, starts[i].steps)));
    }
    std::vector<MotionInput> inputs;
    std::vector<MotionStep> steps;
    std::size_t active = runners.size();
    const Nanoseconds periodsPerStep = options.step / model.period();
    for (int step = 0;; ++step) {
        while (active > 0 && runners[active - 1].start->steps <= step) --active;
        if (active == 0) return;
        const std::span underWay(runners.data(), active);
        for (Nanoseconds i = 0; i < periodsPerStep; ++i)
            advance(model, underWay, step * options.step + i * model.period(), options, Drawn::noise, inputs, steps);
        for (std::size_t i = 0; i < active; ++i) poses[order[i]].push_back(runners[i].pose);
    }
}

}  // namespace

std::uint32_t sampleSeed(std::uint64_t seed, const std::string& robot, const RolloutStart& start,
                         std::uint32_t sample) {
    const std::uint64_t of = hashOf(Value(robot + '\n' + start.trajectory->name));
    return static_cast<std::uint32_t>(noiseBits({seed ^ of, start.time, sample, channelOf(NoiseChannel::sample)}));
}

std::vector<StampedCommand> commandsRead(const RolloutStart& start, Nanoseconds until, const RolloutOptions& options) {
    const auto& commands = start.trajectory->commands;
    const Beginning beginning = beginningOf(*start.trajectory, start.time, options.lead);
    std::vector<StampedCommand> read;
    if (beginning.before && beginning.before->time < commands.front().time) read.push_back(*beginning.before);
    for (std::size_t i = beginning.first; i < commands.size() && commands[i].time <= until; ++i)
        read.push_back(commands[i]);
    return read;
}

void fillVelocities(const MotionModel& model, std::span<RolloutStart> starts, const RolloutOptions& options) {
    const Nanoseconds period = model.period();
    std::map<Nanoseconds, std::vector<RolloutStart*>> earlier;  // by how many periods
    for (RolloutStart& start : starts) {
        const Nanoseconds before = start.velocity ? start.time - start.velocity->time + period / 2  // to the nearest
                                                  : options.lead + period - 1;
        earlier[before / period].push_back(&start);
    }
    std::vector<MotionInput> inputs;
    std::vector<MotionStep> steps;
    for (const auto& [periods, group] : earlier) {
        std::vector<Runner> runners;
        for (RolloutStart* start : group) {
            runners.push_back(prepare(model, *start, start->time - periods * period, options.lead));
            if (start->velocity) runners.back().velocity = start->velocity->velocity;
        }
        for (Nanoseconds i = -periods; i < 0; ++i)
            advance(model, runners, i * period, options, Drawn::nothing, inputs, steps);
        for (std::size_t i = 0; i < group.size(); ++i) group[i]->velocity = {group[i]->time, runners[i].velocity};
    }
}

Expected<std::vector<std::vector<Pose>>> rollOut(const MotionModel& model, std::span<const RolloutStart> starts,
                                                 const RolloutOptions& options) {
    const Nanoseconds period = model.period();
    if (period <= 0 || options.step % period != 0)
        return fail({}, "the model's period of " + secondsText(period) + " s does not divide the output's step of " +
                            secondsText(options.step) + " s");
    std::vector<RolloutStart> known(starts.begin(), starts.end());
    fillVelocities(model, known, options);
    std::vector<std::size_t> order(known.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return known[a].steps > known[b].steps; });
    std::vector<std::vector<Pose>> poses(known.size());
    for (std::size_t first = 0; first < order.size(); first += batchSize)
        rollOutBatch(model, known, std::span(order).subspan(first, std::min(batchSize, order.size() - first)), options,
                     poses);
    return poses;
}

}  // namespace mrose
