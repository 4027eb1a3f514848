#include "perception/learned_sensor.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"
#include "learning/reference_network.h"
#include "perception/some_sensor.h"
#include "world/noise.h"

namespace mrose {
namespace {

SensedState someState(int i) {
    const auto u = [&](int channel) { return uniformNoise({3, i, 0, static_cast<std::uint32_t>(channel)}); };
    SensedState state;
    state.range = 1 + 5 * u(0);
    state.bearing = u(1) - 0.5;
    state.velocity = {0.1 * u(2), u(3) - 0.5};
    state.subject = i % 3 == 0 ? SubjectKind::robot : SubjectKind::landmark;
    state.clearance = 0.5 * u(4) - 0.2;
    state.separation = 0.6 * u(5);
    state.others = i % 7;
    return state;
}

std::vector<SensedState> someStates(int count) {
    std::vector<SensedState> states;
    for (int i = 0; i < count; ++i) states.push_back(someState(i));
    return states;
}

std::vector<ReadingDraw> someDraws(int count) {
    std::vector<ReadingDraw> draws;
    for (int i = 0; i < count; ++i) {
        const NoisePair a = normalPair({4, i, 0, 0}), b = normalPair({4, i, 0, 1});
        draws.push_back({a.first, uniformNoise({4, i, 0, 2}), {a.second, b.first, b.second}});
    }
    return draws;
}

TEST(LearnedSensors, DistributionIsTheFormulaOfTheFile) {
    const SensorNetwork network = test::someCamera();
    const LearnedSensor sensor(network);
    const Mlp& mlp = std::get<Mlp>(network.learned.regressor);
    const std::vector<double> parameters(mlp.parameters.begin(), mlp.parameters.end());
    const SensorInputs inputs(network.learned.inputs, network.robots);
    for (int i = 0; i < 50; ++i) {
        const SensedState state = someState(i);
        std::vector<double> x(inputs.width());
        inputs.readRaw(state, 1, x.data());
        for (std::size_t k = 0; k < x.size(); ++k)
            x[k] = (x[k] - network.learned.inputs[k].mean) / network.learned.inputs[k].scale;
        std::vector<double> y = test::referenceOutputs(mlp.shape, parameters, x.data());
        for (std::size_t k = 0; k < y.size(); ++k)
            y[k] = network.learned.outputs[k].mean + network.learned.outputs[k].scale * y[k];
        ReadingDistribution found;
        sensor.distributions({&state, 1}, 1, {&found, 1});
        const ReadingDistribution expected = ReadingDistribution::of(network.form, y, network.gross);
        EXPECT_NEAR(found.threshold, expected.threshold, 1e-5);
        for (const ReadingError& error : {ReadingError{0, 0}, {0.2, 0.01}})
            EXPECT_NEAR(found.density(error), expected.density(error), 1e-3 * expected.density(error));
    }
}

TEST(LearnedSensors, SayTheSameAloneAndAmongOthers) {
    const LearnedSensor sensor(test::someCamera());
    const std::vector<SensedState> states = someStates(45);
    std::vector<ReadingDistribution> together(states.size());
    sensor.distributions(states, 0, together);
    for (std::size_t i = 0; i < states.size(); ++i) {
        ReadingDistribution alone;
        sensor.distributions({&states[i], 1}, 0, {&alone, 1});
        EXPECT_EQ(alone.threshold, together[i].threshold);
        for (int k = 0; k < 2; ++k) {
            EXPECT_EQ(alone.component[k].share, together[i].component[k].share);
            EXPECT_EQ(alone.component[k].mean, together[i].component[k].mean);
            EXPECT_EQ(alone.component[k].spread, together[i].component[k].spread);
        }
    }
}

/// Places and errors of what is reported.
struct Reports {
    Reports(const LearnedSensor& sensor, int robot, const std::vector<SensedState>& states,
            const std::vector<ReadingDraw>& draws) {
        std::vector<double> numbers;
        for (const ReadingDraw& draw : draws) numbers.push_back(draw.reported);
        sensor.reported(states, robot, numbers, which);
        std::vector<ReadingDraw> ofThese;
        for (const std::uint32_t i : which) ofThese.push_back(draws[i]);
        errors.resize(which.size());
        sensor.errors(states, which, robot, ofThese, errors);
    }
    std::vector<std::uint32_t> which;
    std::vector<ReadingError> errors;
};

TEST(LearnedSensors, ReportWhatTheirDistributionsSay) {
    for (const int members : {1, 3}) {
        const LearnedSensor sensor(test::someCamera(1, members));
        const std::vector<SensedState> states = someStates(45);
        const std::vector<ReadingDraw> draws = someDraws(45);
        std::vector<ReadingDistribution> distributions(states.size());
        sensor.distributions(states, 0, distributions);
        const Reports reports(sensor, 0, states, draws);
        std::size_t next = 0;
        for (std::uint32_t i = 0; i < states.size(); ++i) {
            if (!distributions[i].reports(draws[i])) continue;
            ASSERT_LT(next, reports.which.size());
            EXPECT_EQ(reports.which[next], i);
            EXPECT_EQ(reports.errors[next], distributions[i].error(draws[i]));
            ++next;
        }
        EXPECT_EQ(next, reports.which.size());
        EXPECT_GT(next, 0u);
        EXPECT_LT(next, states.size());
    }
}

TEST(LearnedSensors, AConstantOneReportsThatShareWithThatError) {
    const LearnedSensor sensor(
        test::constantCamera({normalQuantile(0.25), 0.1, -0.02, std::log(0.05), std::log(0.01)}));
    const std::vector<SensedState> states = someStates(4000);
    const std::vector<ReadingError> errors = Reports(sensor, -1, states, someDraws(4000)).errors;
    EXPECT_NEAR(static_cast<double>(errors.size()) / 4000, 0.25, 4 * std::sqrt(0.1875 / 4000));
    double sum = 0, squares = 0;
    for (const ReadingError& error : errors) {
        sum += error[1];
        squares += (error[0] - 0.1) * (error[0] - 0.1);
    }
    const double count = static_cast<double>(errors.size());
    EXPECT_NEAR(sum / count, -0.02, 4 * 0.01 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares / count), 0.05, 4 * 0.05 / std::sqrt(2 * count));
}

TEST(LearnedSensors, SeeInTheirViewAndItsMargin) {
    SensorNetwork network = test::someCamera();
    network.view = {5, 1};
    network.robotSubjects = false;
    const LearnedSensor sensor(network);
    SensedState state;
    state.range = 5.9;
    state.bearing = -0.74;
    EXPECT_TRUE(sensor.inView(state));
    state.bearing = -0.76;
    EXPECT_FALSE(sensor.inView(state));
    state.bearing = 0;
    state.range = 6.1;
    EXPECT_FALSE(sensor.inView(state));
    state.range = 2;
    state.subject = SubjectKind::robot;
    EXPECT_FALSE(sensor.inView(state)) << "it reports no robots";
    EXPECT_EQ(sensor.robotIndex("2"), 1);
    EXPECT_EQ(sensor.robotIndex("3"), -1);
}

}  // namespace
}  // namespace mrose
