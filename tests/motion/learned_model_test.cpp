#include "motion/learned_model.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

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

class LearnedModelOfBothForms : public testing::TestWithParam<MotionNetwork::Form> {};

TEST_P(LearnedModelOfBothForms, PredictsWhatItsFileDefines) {
    const MotionNetwork network = arbitraryNetwork(GetParam());
    const auto motion = std::make_shared<const LearnedMotion>(network);
    for (const auto& [name, index] : {std::pair{"a", 0}, {"b", 1}, {"unknown", -1}}) {
        const LearnedModel model(motion, name);
        const CommandHistory history = someHistory(3);
        MotionInput input{&history, 400 * ms, {0.21, -0.4}};
        LearnedMotion::Memory memory{{0.2, -0.1}, 1};
        if (index == 0) input.memory = std::as_writable_bytes(std::span(&memory, 1));
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
    std::vector<MotionStep> batch(inputs.size());
    model.predict(inputs, batch);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const MotionStep alone = model.predictOne(inputs[i]);
        EXPECT_EQ(alone.increment, batch[i].increment) << i;
        EXPECT_EQ(alone.velocity, batch[i].velocity) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, LearnedModelOfBothForms,
                         testing::Values(MotionNetwork::Form::state, MotionNetwork::Form::history),
                         [](const auto& instance) {
                             return instance.param == MotionNetwork::Form::state ? "State" : "History";
                         });

}  // namespace
}  // namespace mrose
