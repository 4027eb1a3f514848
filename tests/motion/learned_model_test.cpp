#include "motion/learned_model.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "learning/ensemble.h"
#include "motion/network_fixture.h"
#include "support/units.h"

namespace mrose {
namespace {

CommandHistory someHistory(int variant) {
    CommandHistory history;
    for (int i = 0; i < 12; ++i)
        history.issue(i * 37 * ms, {0.1 * uniformNoise({1, i, std::uint32_t(variant), 0}),
                                    normalNoise({1, i, std::uint32_t(variant), 1})});
    return history;
}

std::vector<std::byte> memoryFor(const LearnedMotion& motion, const LearnedMotion::Memory& begun) {
    std::vector<std::byte> memory(motion.memorySize(MotionDraw::mean));
    as<LearnedMotion::Memory>(std::span(memory)) = begun;
    return memory;
}

/// The definition, in double precision and with the library's functions.
MotionStep reference(const MotionNetwork& n, const MotionInput& input, int robot) {
    std::vector<double> x(n.inputs.size());
    InputReader(n).readRaw(input, robot, x.data());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = (x[i] - n.inputs[i].mean) / n.inputs[i].scale;
    const auto [ni, nh, no] = n.mlp.shape;
    const float* w = n.mlp.parameters.data();
    const float* b = w + nh * ni;
    const float* v = b + nh;
    const float* c = v + no * nh;
    std::vector<double> y;
    for (int k = 0; k < no; ++k) {
        double sum = c[k];
        for (int j = 0; j < nh; ++j) {
            double h = b[j];
            for (int i = 0; i < ni; ++i) h += double(w[j * ni + i]) * x[std::size_t(i)];
            sum += double(v[k * nh + j]) * std::tanh(h);
        }
        y.push_back(n.outputs[std::size_t(k)].mean + n.outputs[std::size_t(k)].scale * sum);
    }
    MotionStep step{{y[0], y[1], y[2]}, {y[3], y[4]}};
    if (n.form == MotionNetwork::Form::history) {
        const double left[] = {std::exp(-0.1 / n.recovery.v), std::exp(-0.1 / n.recovery.w)};
        const Velocity expected =
            input.memory.empty() ? Velocity{y[3], y[4]} : as<LearnedMotion::Memory>(input.memory).unperturbed;
        const double dv = input.velocity.v - expected.v, dw = input.velocity.w - expected.w;
        step.increment.x += dv * n.recovery.v * (1 - left[0]);
        step.increment.heading += dw * n.recovery.w * (1 - left[1]);
        step.velocity = {y[5] + dv * left[0], y[6] + dw * left[1]};
    }
    if (robot == 1)
        step.increment.y +=
            n.identified[0].tracker.ahead * step.increment.heading - n.identified[0].tracker.rotated * step.increment.x;
    return step;
}

TEST(LearnedModel, KnowsWhereThePointLiesThatWasTrackedBefore) {
    const auto motion = std::make_shared<const LearnedMotion>(arbitraryNetwork(MotionNetwork::Form::history));
    const CommandHistory history = someHistory(1);
    const TrackerOffset real{-0.05, 0.2};
    TrackerEvidence seen;
    for (const auto& [turn, way] : std::vector<std::pair<double, double>>{{0.3, 0.2}, {-0.2, 0.3}, {5, 0.1}, {1, 4}})
        seen.add(turn, way, real.ahead * turn - real.rotated * way);
    for (const char* const robot : {"b", "a", "unknown"}) {
        const LearnedModel model(motion, robot);
        std::vector<std::byte> memory(model.memorySize()), adapted = memory;
        model.adapt(memory, {});
        EXPECT_EQ(memory, adapted) << "nothing was seen";
        model.adapt(adapted, seen);
        for (int period = 0; period < 3; ++period) {
            if (period == 2) model.restart(memory), model.restart(adapted);
            const Nanoseconds now = (450 + 100 * period) * ms;
            const MotionStep unaware = model.predictOne({&history, now, {0.1, 0.2}, memory}),
                             aware = model.predictOne({&history, now, {0.1, 0.2}, adapted});
            EXPECT_EQ(aware.velocity, unaware.velocity);
            EXPECT_EQ(aware.increment.x, unaware.increment.x);
            EXPECT_EQ(aware.increment.heading, unaware.increment.heading);
            const double sideways = aware.increment.y - unaware.increment.y;
            // That nothing was thought to be left, or what is usual, still counts a little.
            EXPECT_NEAR(sideways, real.sideways(unaware.increment), 0.02 * std::abs(real.sideways(unaware.increment)));
        }
    }
}

class LearnedModelOfBothForms : public testing::TestWithParam<MotionNetwork::Form> {};

TEST_P(LearnedModelOfBothForms, PredictsWhatItsFileDefines) {
    const MotionNetwork network = arbitraryNetwork(GetParam());
    const auto motion = std::make_shared<const LearnedMotion>(network);
    for (const auto& [name, index] : {std::pair{"a", 0}, {"b", 1}, {"unknown", -1}}) {
        const LearnedModel model(motion, name);
        const CommandHistory history = someHistory(3);
        MotionInput input{&history, 400 * ms, {0.21, -0.4}};
        const bool remembers = GetParam() == MotionNetwork::Form::history;
        std::vector<std::byte> memory = memoryFor(*motion, {{0.2, -0.1}, remembers});
        if (index == 0) input.memory = memory;
        const MotionStep expected = reference(network, input, index), step = model.predictOne(input);
        EXPECT_NEAR(step.increment.x, expected.increment.x, 1e-7);
        EXPECT_NEAR(step.increment.y, expected.increment.y, 1e-7);
        EXPECT_NEAR(step.increment.heading, expected.increment.heading, 1e-7);
        EXPECT_NEAR(step.velocity.v, expected.velocity.v, 1e-7);
        EXPECT_NEAR(step.velocity.w, expected.velocity.w, 1e-7);
    }
}

TEST_P(LearnedModelOfBothForms, GivesTheSameBitsAloneAndInAnyBatch) {
    const auto motion = std::make_shared<const LearnedMotion>(arbitraryNetwork(GetParam()));
    const LearnedModel model(motion, "a");
    std::vector<CommandHistory> histories;
    for (int i = 0; i < 150; ++i) histories.push_back(someHistory(i));
    std::vector<MotionInput> inputs;
    for (int i = 0; i < 150; ++i) inputs.push_back({&histories[std::size_t(i)], (300 + i) * ms, {0.01 * i, -0.02 * i}});
    std::vector<std::vector<std::byte>> together(inputs.size(), std::vector<std::byte>(model.memorySize())),
        apart = together;
    for (int period = 0; period < 3; ++period) {
        std::vector<MotionStep> batch(inputs.size());
        for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i].memory = together[i];
        model.predict(inputs, batch);
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            inputs[i].memory = apart[i];
            const MotionStep alone = model.predictOne(inputs[i]);
            EXPECT_EQ(alone.increment, batch[i].increment) << i;
            EXPECT_EQ(alone.velocity, batch[i].velocity) << i;
            EXPECT_EQ(apart[i], together[i]) << i;
            inputs[i].start += model.period();
        }
    }
}

/// Of some members, whose layers differ; the velocities of the history form belong to all of them together.
MotionNetwork ensembleOf(std::size_t count, MotionNetwork::Form form) {
    MotionNetwork network = arbitraryNetwork(form);
    const std::size_t own = form == MotionNetwork::Form::history ? 3 : 5;
    const int inputs = network.mlp.shape.inputs;
    std::vector<Mlp> members;
    for (std::size_t m = 0; m < count; ++m) {
        Mlp& member = members.emplace_back(Mlp{{inputs, 8, int(own)}, {}});
        for (std::size_t i = 0; i < member.shape.parameterCount(); ++i)
            member.parameters.push_back(
                static_cast<float>(0.3 * normalNoise({6, std::int64_t(i), std::uint32_t(m), 0})));
    }
    network.mlp = mergedMean(members);
    network.members = membersOf(members);
    std::vector<float>& p = network.mlp.parameters;
    const std::vector<float> biases(p.end() - std::ptrdiff_t(own), p.end());
    p.resize(p.size() - own);
    const std::size_t others = network.outputs.size() - own, hidden = std::size_t(network.mlp.shape.hidden);
    for (std::size_t i = 0; i < others * hidden; ++i)
        p.push_back(static_cast<float>(0.3 * normalNoise({7, std::int64_t(i), 0, 0})));
    p.insert(p.end(), biases.begin(), biases.end());
    p.resize(p.size() + others, 0.1f);
    network.mlp.shape.outputs = int(network.outputs.size());
    return network;
}

/// One member of it as a network of its own.
MotionNetwork memberAlone(const MotionNetwork& ensemble, std::size_t member) {
    MotionNetwork alone = ensemble;
    const Mlp own = memberOf(ensemble.mlp, ensemble.members, member);
    alone.members.clear();
    if (ensemble.form == MotionNetwork::Form::state) {
        alone.mlp = own;
        return alone;
    }
    const std::size_t hidden = std::size_t(ensemble.mlp.shape.hidden);
    // Its outputs in the place of the first ones of the ensemble.
    std::size_t first = 0;
    for (std::size_t m = 0; m < member; ++m) first += std::size_t(ensemble.members[m].hidden);
    const std::size_t ownHidden = std::size_t(own.shape.hidden);
    const std::size_t inputs = std::size_t(own.shape.inputs);
    float* const weights = alone.mlp.parameters.data() + hidden * (inputs + 1);
    float* const biases = weights + hidden * ensemble.outputs.size();
    const float* const from = own.parameters.data() + ownHidden * (inputs + 1);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < hidden; ++j)
            weights[k * hidden + j] = j >= first && j < first + ownHidden ? from[k * ownHidden + j - first] : 0;
        biases[k] = from[3 * ownHidden + k];
    }
    return alone;
}

/// Inputs of robots with different histories.
struct SeveralInputs {
    explicit SeveralInputs(int count) {
        for (int i = 0; i < count; ++i) histories.push_back(someHistory(i));
        for (int i = 0; i < count; ++i)
            inputs.push_back({&histories[std::size_t(i)], (300 + i) * ms, {0.01 * i, -0.02 * i}});
    }
    std::vector<CommandHistory> histories;
    std::vector<MotionInput> inputs;
};

TEST_P(LearnedModelOfBothForms, MembersPredictAsTheyWouldAlone) {
    const MotionNetwork network = ensembleOf(4, GetParam());
    const LearnedMotion motion(network);
    ASSERT_EQ(motion.memberCount(), 4u);
    const SeveralInputs several(40);
    const std::size_t count = several.inputs.size();
    const std::vector<int> robots(count, 1);
    std::vector<MotionStep> mean(count), steps(count), members(4 * count), alone(count);
    motion.predict(several.inputs, robots, mean);
    motion.predictMembers(several.inputs, robots, steps, members);
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(steps[i].increment, mean[i].increment) << "another mean";
        EXPECT_EQ(steps[i].velocity, mean[i].velocity) << "another mean";
    }
    for (std::size_t m = 0; m < 4; ++m) {
        LearnedMotion(memberAlone(network, m)).predict(several.inputs, robots, alone);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(members[4 * i + m].increment, alone[i].increment) << m;
            EXPECT_EQ(members[4 * i + m].velocity, alone[i].velocity) << m;
        }
    }
}

TEST_P(LearnedModelOfBothForms, MembersReadWhatTheirMeanRemembers) {
    const MotionNetwork network = ensembleOf(2, GetParam());
    const LearnedMotion motion(network);
    const SeveralInputs several(1);
    const std::array<int, 1> robots{1};
    std::vector<std::byte> ofMean = memoryFor(motion, {{0.3, -0.2}, 1}), ofAll = ofMean;
    MotionInput input = several.inputs[0];
    std::array<MotionStep, 1> mean, step, alone;
    std::array<MotionStep, 2> members;
    input.memory = ofMean;
    motion.predict({&input, 1}, robots, mean);
    input.memory = ofAll;
    motion.predictMembers({&input, 1}, robots, step, members);
    EXPECT_EQ(step[0].increment, mean[0].increment);
    EXPECT_EQ(ofAll, ofMean) << "it remembers its own prediction, not the members'";
    for (std::size_t m = 0; m < 2; ++m) {
        std::vector<std::byte> own = memoryFor(motion, {{0.3, -0.2}, 1});
        input.memory = own;
        LearnedMotion(memberAlone(network, m)).predict({&input, 1}, robots, alone);
        EXPECT_EQ(members[m].increment, alone[0].increment) << m;
        EXPECT_EQ(members[m].velocity, alone[0].velocity) << m;
    }
}

TEST_P(LearnedModelOfBothForms, IsAsUnsureAsItsMembersDiffer) {
    const MotionNetwork network = ensembleOf(3, GetParam());
    const auto motion = std::make_shared<const LearnedMotion>(network);
    const LearnedModel model(motion, "b");
    const SeveralInputs several(40);
    const std::size_t count = several.inputs.size();
    std::vector<MotionStep> mean(count), steps(count), alone(count);
    std::vector<MotionSpread> spreads(count);
    model.predict(several.inputs, mean);
    model.predictWithSpread(several.inputs, steps, spreads);
    std::vector<std::vector<MotionStep>> members;
    for (std::size_t m = 0; m < 3; ++m) {
        LearnedModel(std::make_shared<const LearnedMotion>(memberAlone(network, m)), "b")
            .predict(several.inputs, alone);
        members.push_back(alone);
    }
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(steps[i].increment, mean[i].increment);
        const auto deviation = [&](const auto& value) {
            double sum = 0, squares = 0;
            for (const auto& member : members) sum += value(member[i]);
            for (const auto& member : members) squares += std::pow(value(member[i]) - sum / 3, 2);
            return std::sqrt(squares / 2);
        };
        const double x = deviation([](const MotionStep& s) { return s.increment.x; });
        EXPECT_GT(x, 1e-4) << "members that agree tell nothing";
        EXPECT_NEAR(spreads[i].increment.x, x, 1e-7);
        EXPECT_NEAR(spreads[i].increment.y, deviation([](const MotionStep& s) { return s.increment.y; }), 1e-7);
        EXPECT_NEAR(spreads[i].increment.heading, deviation([](const MotionStep& s) { return s.increment.heading; }),
                    1e-7);
        EXPECT_NEAR(spreads[i].velocity.v, deviation([](const MotionStep& s) { return s.velocity.v; }), 1e-7);
        EXPECT_NEAR(spreads[i].velocity.w, deviation([](const MotionStep& s) { return s.velocity.w; }), 1e-7);
    }
}

TEST_P(LearnedModelOfBothForms, WhoseMembersAreNotKnownTellsNoSpread) {
    const auto motion = std::make_shared<const LearnedMotion>(arbitraryNetwork(GetParam()));
    EXPECT_EQ(motion->memberCount(), 0u);
    const LearnedModel model(motion, "b");
    const SeveralInputs several(3);
    std::vector<MotionStep> steps(3);
    std::vector<MotionSpread> spreads(3, {{1, 1, 1}, {1, 1}});
    model.predictWithSpread(several.inputs, steps, spreads);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(steps[i].increment, model.predictOne(several.inputs[i]).increment);
        EXPECT_EQ(spreads[i], MotionSpread{});
    }
}

TEST_P(LearnedModelOfBothForms, SaysWhatItsDriveFollows) {
    MotionNetwork network = arbitraryNetwork(GetParam());
    network.limits = {0.5, 2, 0, 0};
    const LearnedModel model(std::make_shared<const LearnedMotion>(network), "a");
    double read = 0;  // s: the oldest that inputs are made from
    for (const NetworkInput& input : network.inputs)
        if (input.fromCommands()) read = std::max(read, input.oldest);
    CommandHistory history;
    history.issue(0, {0.4, -1});
    std::vector<std::byte> memory(model.memorySize());
    model.predictOne({&history, fromSeconds(read) + 100 * ms, {}, memory});
    MemoryEntries entries;
    model.explain(memory, entries);
    const auto said = std::move(entries).all();
    const auto of = [&](std::string_view name) {
        const auto found = std::ranges::find_if(said, [&](const MemoryEntry& entry) { return entry.name == name; });
        return found == said.end() ? 99.0 : found->value;
    };
    EXPECT_NEAR(of("followed_v"), 0.5 * 0.2, 1e-12);  // where the next period begins to read, 0.2 s after the command
    EXPECT_NEAR(of("followed_w"), -2 * 0.2, 1e-12);
}

/// What a world keeps of the commands beside what a rollout of a log knows.
TEST_P(LearnedModelOfBothForms, FollowsCommandsThatAWorldNoLongerKeeps) {
    MotionNetwork network = arbitraryNetwork(GetParam());
    network.limits = {0.2, 0.5, 0.5, 0.165, 0.3};
    const LearnedModel model(std::make_shared<const LearnedMotion>(network), "a");
    std::vector<std::byte> ofWorld(model.memorySize()), ofLog = ofWorld;
    CommandHistory all;
    std::array<StampedCommand, 8> slots;
    std::size_t kept = 0;
    Command before;
    bool differs = false;
    for (int i = 0; i < 60; ++i) {
        const Nanoseconds start = i * model.period();
        const StampedCommand issued{start, {0.4 * uniformNoise({2, i, 0, 0}), normalNoise({2, i, 0, 1})}};
        all.issue(issued.time, issued.command);
        issueCommand(std::span(slots).first(std::size_t(model.lookBack() / model.period()) + 2), kept, before, issued);
        const CommandView view{std::span<const StampedCommand>(slots).first(kept), before};
        const MotionStep inWorld = model.predictOne({view, start, {0.2, 0.1}, ofWorld});
        const MotionStep ofRollout = model.predictOne({&all, start, {0.2, 0.1}, ofLog});
        ASSERT_EQ(inWorld.increment, ofRollout.increment) << i;
        ASSERT_EQ(ofWorld, ofLog) << i;
        differs = differs || model.predictOne({view, start, {0.2, 0.1}}).increment != inWorld.increment;
    }
    EXPECT_TRUE(differs) << "what it remembers does not matter";
}

INSTANTIATE_TEST_SUITE_P(Forms, LearnedModelOfBothForms,
                         testing::Values(MotionNetwork::Form::state, MotionNetwork::Form::history),
                         [](const auto& instance) {
                             return instance.param == MotionNetwork::Form::state ? "State" : "History";
                         });

}  // namespace
}  // namespace mrose
