#include "motion/residual_noise.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "learning/ensemble.h"
#include "motion/learned_model.h"
#include "motion/network_fixture.h"
#include "support/units.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

using Axis = ResidualNoise::Axis;
using Form = MotionNetwork::Form;

ResidualNoise someNoise() {
    ResidualNoise noise;
    noise.processes = {{Axis::forward, 0.5, {{NoiseTrait::moving, 1e-3}, {NoiseTrait::distance, 0.2}}},
                       {Axis::left, 30, {{NoiseTrait::rotation, 0.1}}},
                       {Axis::heading, 0, {{NoiseTrait::unevennessW, 0.3}, {NoiseTrait::headingChange, 0.7}}}};
    noise.members = {0.8, 1};
    noise.scale = {0.4, 3};
    noise.horizon = 10;
    noise.rollouts = 1234;
    noise.most = {1, 0.05, 0.08, 0.9, 0.04, 0.06, 0.01, 0.03};
    return noise;
}

/// The mean of three networks, with noise.
MotionNetwork noisyEnsemble(Form form) {
    MotionNetwork network = arbitraryNetwork(form);
    std::vector<Mlp> all;
    for (std::int64_t m = 0; m < 3; ++m) {
        Mlp one = network.mlp;
        for (std::size_t i = 0; i < one.parameters.size(); ++i)
            one.parameters[i] += static_cast<float>(
                0.05 * normalNoise({11, static_cast<std::int64_t>(i), 0, static_cast<std::uint32_t>(m)}));
        all.push_back(std::move(one));
    }
    network.mlp = mergedMean(all);
    network.members = membersOf(all);
    network.noise = someNoise();
    return network;
}

NoiseKey keyAt(std::int64_t tick, std::uint32_t robot = 0, std::uint64_t seed = 3) {
    return {seed, tick, robot, channelOf(NoiseChannel::motion)};
}

TEST(NoiseProcesses, ValuesAreNormalAndForgetThemselvesWithTheirTimes) {
    const NoiseProcesses processes(someNoise(), 3, 0.1);
    ASSERT_EQ(processes.values(), 7u) << "three processes, three members, the scale";
    const std::vector<double> times{0.5, 30, 0, 1, 1, 1, 3};
    constexpr int runs = 20'000, later = 3;
    std::vector<double> sums(7), squares(7), fourths(7), products(7), across(7);
    for (int run = 0; run < runs; ++run) {
        std::vector<float> values(7), before;
        for (int k = 0; k <= 2 + later; ++k) {
            processes.advance(keyAt(5 * k, static_cast<std::uint32_t>(run)), k > 0, values);
            if (k == 2) before = values;
        }
        for (std::size_t i = 0; i < 7; ++i) {
            const double value = values[i];
            sums[i] += value / runs;
            squares[i] += value * value / runs;
            fourths[i] += value * value * value * value / runs;
            products[i] += value * before[i] / runs;
            across[i] += value * values[(i + 1) % 7] / runs;
        }
    }
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_NEAR(sums[i], 0, 0.03);
        EXPECT_NEAR(squares[i], 1, 0.04);
        EXPECT_NEAR(fourths[i], 3, 0.4);
        EXPECT_NEAR(across[i], 0, 0.03);
        EXPECT_NEAR(products[i], times[i] > 0 ? std::exp(-0.1 * later / times[i]) : 0, 0.03) << "value " << i;
    }
}

TEST(NoiseProcesses, NoiseIsTheSumOfItsParts) {
    const NoiseProcesses processes(someNoise(), 3, 0.1);
    const std::vector<float> values{0.5F, -2, 1.5F, 1, -1, 0.25F, 0.75F};
    const NoiseTraits traits{0.9, 0.03, 0.05, 0.7, 0.02, -0.03, 0.004, -0.01};
    const std::vector<Pose> members{{0.001, 0.002, 0.003}, {-0.002, 0.001, 0.004}, {0.001, -0.003, -0.007}};
    const double scale = std::exp(0.4 * 0.75), each = 0.8 / std::sqrt(2.0);
    const Pose noise = processes.noise(values, traits, members);
    const double x = 0.5 * (1e-3 * 0.9 + 0.2 * 0.03), y = -2 * 0.1 * 0.05, h = 1.5 * (0.3 * 0.02 - 0.7 * 0.01);
    EXPECT_NEAR(noise.x, scale * (x + each * (0.001 + 0.002 + 0.25 * 0.001)), 1e-15);
    EXPECT_NEAR(noise.y, scale * (y + each * (0.002 - 0.001 - 0.25 * 0.003)), 1e-15);
    EXPECT_NEAR(noise.heading, scale * (h + each * (0.003 - 0.004 - 0.25 * 0.007)), 1e-15);
}

TEST(NoiseProcesses, WhatIsMoreThanWasLearnedFromCountsAsMuchAsTheMost) {
    const std::vector<float> values{0.5F, -2, 1.5F, 1, -1, 0.25F, 0.75F};
    const std::vector<Pose> members(3);
    const NoiseTraits far{0.9, 0.2, 7, 0.7, 0.5, -0.3, 0.4, -1};
    NoiseTraits most = *someNoise().most;
    most[0] = 0.9;
    most[7] = -most[7];
    const NoiseProcesses bounded(someNoise(), 3, 0.1);
    EXPECT_EQ(bounded.noise(values, far, members), bounded.noise(values, most, members));
    ResidualNoise any = someNoise();
    any.most.reset();
    const Pose noise = NoiseProcesses(any, 3, 0.1).noise(values, far, members);
    EXPECT_NEAR(noise.y, -2 * 0.1 * 7 * std::exp(0.4 * 0.75), 1e-12) << "files from before it know no bound";
}

TEST(NoiseTraitReader, ReadsWhatAPeriodIsLike) {
    const MotionNetwork network = arbitraryNetwork(Form::history);
    std::vector<float> row(network.inputs.size());
    // inputs 3, 4 are parts of command_v and 5, 6 of command_w
    const std::vector<double> commands{0.3, 0.5, -0.2, -0.9};
    for (std::size_t i = 0; i < 4; ++i)
        row[3 + i] = static_cast<float>((commands[i] - network.inputs[3 + i].mean) / network.inputs[3 + i].scale);
    const NoiseTraits traits = NoiseTraitReader(network).read(row.data(), {-0.03, 0.001, 0.05}, {-0.01, 0, 0.08});
    EXPECT_NEAR(traits[0], 0.035 / 0.0355, 1e-12);
    EXPECT_EQ(traits[1], 0.03);
    EXPECT_EQ(traits[2], 0.05);
    EXPECT_NEAR(traits[3], 0.02, 1e-7);
    EXPECT_NEAR(traits[4], 0.07, 1e-7);
    EXPECT_EQ(traits[5], -0.03);
    EXPECT_NEAR(traits[6], -0.02, 1e-15);
    EXPECT_NEAR(traits[7], -0.03, 1e-15);
    EXPECT_EQ(NoiseTraitReader(network).read(row.data(), {}, {})[0], 0) << "a robot at rest is not moved";
}

class NoisyNetwork : public testing::TestWithParam<Form> {
protected:
    NoisyNetwork() {
        for (int i = 0; i < 12; ++i) history_.issue(i * 100 * ms, {0.05 * i, 0.3 - 0.1 * i});
    }

    /// Increments of successive periods from 1 s on.
    std::vector<Pose> drive(const MotionModel& model, const std::optional<std::uint64_t>& seed,
                            int periods = 20) const {
        std::vector<std::byte> memory(model.memorySize());
        std::vector<Pose> increments;
        Velocity velocity{0.1, 0.05};
        for (int k = 0; k < periods; ++k) {
            MotionInput input{&history_, 1000 * ms + k * 100 * ms, velocity, memory};
            if (seed) input.noise = keyAt(5 * k, 0, *seed);
            const MotionStep step = model.predictOne(input);
            increments.push_back(step.increment);
            velocity = step.velocity;
        }
        return increments;
    }

    const std::shared_ptr<const LearnedMotion> motion_ =
        std::make_shared<const LearnedMotion>(noisyEnsemble(GetParam()));
    const LearnedModel mean_{motion_, "b"}, noisy_{motion_, "b", MotionDraw::noisy};
    CommandHistory history_;
};

TEST_P(NoisyNetwork, IsTheMeanToTheBitWithoutADraw) {
    EXPECT_EQ(drive(noisy_, std::nullopt), drive(mean_, std::nullopt));
    EXPECT_EQ(drive(mean_, 4), drive(mean_, std::nullopt));
    EXPECT_EQ(drive(*noisy_.drawn(MotionDraw::mean), 4), drive(mean_, 4));
    EXPECT_EQ(mean_.memorySize(), sizeof(LearnedMotion::Memory));
}

TEST_P(NoisyNetwork, DrawsAnotherRunForEachSeedAndTheSameAgain) {
    EXPECT_EQ(drive(noisy_, 4), drive(noisy_, 4));
    EXPECT_NE(drive(noisy_, 4), drive(noisy_, 5));
    EXPECT_NE(drive(noisy_, 4), drive(mean_, 4));
}

/// Step by step from what the network and its members predict. Without a lag nothing but their outputs moves the robot.
TEST_P(NoisyNetwork, AddsTheNoiseOfWhatItPredicts) {
    MotionNetwork network = noisyEnsemble(GetParam());
    network.recovery = {};
    const auto motion = std::make_shared<const LearnedMotion>(network);
    const LearnedModel noisy(motion, "none of them", MotionDraw::noisy);
    const NoiseProcesses processes(*network.noise, 3, 0.1);
    const NoiseTraitReader reader(network);
    const std::vector<int> none{-1};
    std::vector<std::byte> memory(noisy.memorySize());
    std::vector<float> values(processes.values()), row(motion->inputs().width());
    Pose previous;
    for (int k = 0; k < 5; ++k) {
        MotionInput input{&history_, 1000 * ms + k * 100 * ms, {0.1, 0.05}};
        MotionStep mean;
        std::vector<MotionStep> members(3);
        motion->predictMembers({&input, 1}, none, {&mean, 1}, members);
        const Pose& at = mean.increment;
        std::vector<Pose> deviations;
        for (const auto& [increment, velocity] : members)
            deviations.push_back({increment.x - at.x, increment.y - at.y, increment.heading - at.heading});
        motion->inputs().read(input, -1, row.data());
        const NoiseTraits traits = reader.read(row.data(), at, k > 0 ? previous : at);
        previous = at;
        input.memory = memory;
        input.noise = keyAt(5 * k);
        processes.advance(input.key(0), k > 0, values);
        const Pose noise = processes.noise(values, traits, deviations);
        const MotionStep step = noisy.predictOne(input);
        EXPECT_NEAR(step.increment.x, at.x + noise.x, 1e-7);
        EXPECT_NEAR(step.increment.y, at.y + noise.y, 1e-7);
        EXPECT_NEAR(step.increment.heading, at.heading + noise.heading, 1e-7);
        EXPECT_NE(step.increment.x, at.x);
        EXPECT_EQ(step.velocity, mean.velocity) << "noise is of the way, not of the drive";
    }
}

TEST_P(NoisyNetwork, ATrackersMarkerIsShiftedByTheNoisyMotion) {
    const TrackerOffset tracker = motion_->network().identified.front().tracker;
    MotionNetwork network = noisyEnsemble(GetParam());
    network.identified.front().tracker = {};
    const LearnedModel axle(std::make_shared<const LearnedMotion>(network), "b", MotionDraw::noisy);
    const auto marker = drive(noisy_, 4, 1), body = drive(axle, 4, 1);
    EXPECT_EQ(marker[0].x, body[0].x);
    EXPECT_NEAR(marker[0].y, body[0].y + tracker.sideways(body[0]), 1e-15);
}

TEST_P(NoisyNetwork, GivesTheSameBitsAloneAndInABatch) {
    std::vector<MotionInput> inputs;
    for (int i = 0; i < 50; ++i) {
        inputs.push_back({&history_, (1000 + 10 * i) * ms, {0.01 * i, -0.02 * i}});
        inputs.back().noise = keyAt(i, static_cast<std::uint32_t>(i));
    }
    std::vector<MotionStep> steps(50);
    noisy_.predict(inputs, steps);
    for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(noisy_.predictOne(inputs[i]).increment, steps[i].increment);
}

TEST_P(NoisyNetwork, RemembersAllOfItsNoise) {
    std::vector<std::byte> memory(noisy_.memorySize());
    const auto next = [&](std::vector<std::byte>& remembered, int k) {
        MotionInput input{&history_, 1000 * ms + k * 100 * ms, {0.1, 0}, remembered};
        input.noise = keyAt(5 * k);
        return noisy_.predictOne(input).increment;
    };
    for (int k = 0; k < 3; ++k) next(memory, k);
    std::vector<std::byte> copy = memory, fresh(memory.size());
    EXPECT_EQ(next(memory, 3), next(copy, 3));
    EXPECT_EQ(memory, copy);
    EXPECT_NE(next(memory, 4), next(fresh, 4));
    EXPECT_EQ(explained(noisy_, memory).back().name, "noise_scale");
    EXPECT_GT(explained(noisy_, memory).back().value, 0);
}

TEST_P(NoisyNetwork, ItsFileKeepsEveryBit) {
    MotionNetwork network = noisyEnsemble(GetParam());
    network.noise->constant = MotionNoise{0.1, 0.2, 0.3};
    const auto read = parseNetwork(networkText(network), "n.net");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_TRUE(*read == network);
}

TEST(NoisyNetworkFile, NamesWhatDoesNotFit) {
    const std::string text = networkText(noisyEnsemble(Form::history));
    const auto error = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        EXPECT_NE(changed.find(from), std::string::npos) << from;
        const auto read = parseNetwork(changed.replace(changed.find(from), from.size(), to), "n.net");
        return read ? "no error" : read.error().message();
    };
    using testing::HasSubstr;
    EXPECT_THAT(error("axis = \"left\"", "axis = \"up\""), HasSubstr("motion.noise.processes[2].axis"));
    EXPECT_THAT(error("time_s = 0.5, moving", "time_s = -0.5, moving"), HasSubstr("motion.noise.processes[1].time_s"));
    EXPECT_THAT(error("distance = 0.2", "distance = -0.2"), HasSubstr("motion.noise.processes[1].distance"));
    EXPECT_THAT(error("distance = 0.2", "distanz = 0.2"), HasSubstr("motion.noise.processes[1].distanz"));
    EXPECT_THAT(error("scale = { weight = 0.4", "scale = { weight = nan"), HasSubstr("motion.noise.scale.weight"));
    EXPECT_THAT(error("rollouts = 1234\n", ""), HasSubstr("motion.noise.rollouts: is missing"));
    std::string many;
    for (int i = 0; i < 25; ++i) many += "  { axis = \"left\", time_s = 1.0 },\n";
    EXPECT_THAT(error("processes = [ # m or rad a period\n", "processes = [\n" + many),
                HasSubstr("motion.noise.processes: has 28 elements; expected at most 24"));
}

INSTANTIATE_TEST_SUITE_P(Forms, NoisyNetwork, testing::Values(Form::state, Form::history),
                         [](const auto& test) { return test.param == Form::state ? "state" : "history"; });

}  // namespace
}  // namespace mrose
