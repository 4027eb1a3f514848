#include "sensing/learned_localiser.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"
#include "learning/reference_network.h"
#include "perception/some_sensor.h"
#include "sensing/perceiving.h"
#include "simulation/small_world.h"
#include "world/state_bytes.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

constexpr Nanoseconds localiserMillisecond = 1'000'000;

/// Looks every 0.1 s, 0.08 s late.
SensorNetwork localisation(const std::vector<double>& outputs = {}) {
    SensorNetwork network = test::constantLocalisation(outputs);
    network.period = 100 * localiserMillisecond;
    network.latency = 80 * localiserMillisecond;
    return network;
}

SensorNetwork someLocalisation() {
    SensorNetwork network = localisation();
    Mlp mlp = test::normalNetwork({static_cast<int>(network.learned.inputs.size()), 7, network.form.outputs()}, 3);
    for (float& parameter : mlp.parameters) parameter *= 0.3f;
    network.learned.regressor = std::move(mlp);
    for (NetworkVariable& output : network.learned.outputs) output.scale = 0.1;
    network.learned.outputs[0].mean = 1;
    for (ReadingNoise& noise : network.noise) noise = {0, 0.5, 1.5, 0, 1};
    return network;
}

Scenario localised(const SensorNetwork& network, std::shared_ptr<const Controller> controller, Nanoseconds period = 0,
                   const std::optional<Nanoseconds>& latency = std::nullopt) {
    RobotType type = discRobot(0.2);
    type.sensors = {std::make_shared<const LearnedLocaliser>(std::make_shared<const LearnedSensor>(network),
                                                             SensorTraits{"place", period},
                                                             LearnedLocaliser::Options{"1", latency})};
    return SmallWorld()
        .robot(type, {1, 2, 0.5}, std::move(controller),
               std::make_shared<const KinematicModel>(KinematicParameters{}, 100 * localiserMillisecond))
        .scenario();
}

std::shared_ptr<const Controller> driving() { return std::make_shared<const Told>(Command{0.3, 0.4}); }

struct Reported {
    Nanoseconds arrived = 0, measured = 0;
    Pose error;  ///< in the robot's frame
};

std::vector<Reported> reportsOf(const Scenario& scenario, int ticks, std::uint64_t seed) {
    std::vector<Reported> reports;
    std::vector<Pose> poses;
    WorldState state = scenario.initialState(seed);
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < ticks; ++k) {
        poses.push_back(state.robots[0].pose);
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].observed) continue;
        const Observation& seen = trace.robots[0].observation;
        for (const Reading& reading : seen.readings()) {
            if (reading.name != "place") continue;
            const auto tick =
                static_cast<std::size_t>(std::max<Nanoseconds>(reading.measured, 0) / (20 * localiserMillisecond));
            const Pose pose = seen.records<Pose>(&reading)[0];
            reports.push_back({seen.time, reading.measured, relative(poses[tick], pose)});
        }
    }
    return reports;
}

TEST(LearnedLocalisers, ErrByTheDistributionInTheRobotsFrame) {
    const std::vector<double> outputs{5, 0.10, -0.05, 0.02, std::log(0.04), std::log(0.02), std::log(0.01)};
    const auto reports = reportsOf(localised(localisation(outputs), driving()), 10'000, 4);
    ASSERT_NEAR(static_cast<double>(reports.size()), 2000, 2);
    StandardNormals x, y, heading;
    for (const Reported& one : reports) {
        EXPECT_EQ(one.arrived - one.measured,
                  80 * localiserMillisecond +
                      20 * localiserMillisecond *
                          ((one.arrived - one.measured - 80 * localiserMillisecond) / (20 * localiserMillisecond)));
        x.add((one.error.x - 0.10) / 0.04);
        y.add((one.error.y + 0.05) / 0.02);
        heading.add((one.error.heading - 0.02) / 0.01);
    }
    x.expectStandard("x");
    y.expectStandard("y");
    heading.expectStandard("heading");
}

TEST(LearnedLocalisers, ReportByTheirClockWhatWasTheirLatencyAgo) {
    const std::vector<double> outputs{5, 0, 0, 0, -11, -11, -11};
    const auto reports = reportsOf(localised(localisation(outputs), driving(), 60 * localiserMillisecond), 500, 4);
    ASSERT_GT(reports.size(), 150u);
    for (std::size_t i = 1; i < reports.size(); ++i) {
        EXPECT_EQ(reports[i].measured - reports[i - 1].measured, 60 * localiserMillisecond);
        EXPECT_GE(reports[i].arrived - reports[i].measured, 80 * localiserMillisecond);
        EXPECT_NEAR(reports[i].error.x, 0, 1e-3);
    }
}

/// One that is never wrong by more than a picometre.
SensorNetwork exactLocalisation() {
    SensorNetwork network = localisation({8, 0, 0, 0, 0, 0, 0});
    network.gross = {1, {1e-12, 1e-12, 1e-12}};
    return network;
}

/// Neither their period nor, here, their latency are whole numbers of ticks. Straight on, and on the spot, a robot is
/// between two ticks where it is evenly between both.
TEST(LearnedLocalisers, ReportWhatWasTrueTheirLatencyAgoToTheNanosecond) {
    for (const Command& command : {Command{0.3, 0}, Command{0, 0.4}})
        for (const Nanoseconds latency : {0, 33, 80, 117})
            for (const Nanoseconds period : {0, 73, 236}) {
                SensorNetwork network = exactLocalisation();
                network.period = 0;  // with none it measures for each control instant
                const Scenario scenario = localised(network, std::make_shared<const Told>(command),
                                                    period * localiserMillisecond, latency * localiserMillisecond);
                WorldState state = scenario.initialState(4);
                state.robots[0].velocity_B = {command.v, 0, command.w};  // at its speed from the start on
                StepBuffers buffers;
                StepTrace trace;
                int reported = 0;
                Nanoseconds before = -1;
                for (int k = 0; k < 500; ++k) {
                    const Nanoseconds now = scenario.scene().timeOf(state.tick);
                    step(scenario, state, buffers, {}, &trace);
                    if (!trace.robots[0].observed) continue;
                    const Observation& seen = trace.robots[0].observation;
                    for (const Reading& reading : seen.readings()) {
                        if (reading.name != "place") continue;
                        if (period == 0) {
                            ASSERT_EQ(reading.measured, now - latency * localiserMillisecond);
                        } else {
                            ASSERT_EQ(reading.measured % (period * localiserMillisecond), 0);
                            ASSERT_GE(now, reading.measured + latency * localiserMillisecond);
                            ASSERT_LT(now, reading.measured + (latency + 120) * localiserMillisecond);
                            if (reported > 0) {
                                ASSERT_EQ(reading.measured - before, period * localiserMillisecond);
                            }
                        }
                        before = reading.measured;
                        ++reported;
                        const double driven = std::max(0.0, toSeconds(reading.measured));
                        const Pose pose = seen.records<Pose>(&reading)[0];
                        EXPECT_NEAR(pose.x, 1 + command.v * driven * std::cos(0.5), 1e-9);
                        EXPECT_NEAR(pose.y, 2 + command.v * driven * std::sin(0.5), 1e-9);
                        EXPECT_NEAR(pose.heading, 0.5 + command.w * driven, 1e-9) << latency << ' ' << period;
                    }
                }
                EXPECT_GT(reported, 10'000 / std::max<Nanoseconds>(period, 100) - 3);
            }
}

/// It reports where it drives faster than 0.15 m/s.
TEST(LearnedLocalisers, KnowTheirRobotsVelocity) {
    SensorNetwork network = localisation({0, 0, 0, 0, 0, 0, 0});
    const std::vector<NetworkVariable>& inputs = network.learned.inputs;
    const auto speed =
        static_cast<std::size_t>(std::ranges::find(inputs, "speed", &NetworkVariable::name) - inputs.begin());
    test::reportAbove(network, speed, 0.15);
    const auto driving =
        std::make_shared<const Told>(std::vector<StampedCommand>{{0, {0.3, 0}}, {4'000 * localiserMillisecond, {}}});
    for (const Nanoseconds latency : {0, 33, 117}) {
        const auto reports = reportsOf(localised(network, driving, 0, latency * localiserMillisecond), 400, 4);
        EXPECT_NEAR(static_cast<double>(reports.size()), 40, 2);
        for (const Reported& one : reports) EXPECT_LT(one.measured, 4'050 * localiserMillisecond);
    }
}

TEST(LearnedLocalisers, SlowPartsLastAndMissingReportsComeInBursts) {
    SensorNetwork network = localisation({1, 0, 0, 0, 0, 0, 0});
    network.noise[0] = network.noise[1] = {0, 0.6, 1.2, 0, 1};
    const auto reports = reportsOf(localised(network, driving()), 40'000, 4);
    const double share = static_cast<double>(reports.size()) / 8000;
    EXPECT_NEAR(share, normalProbability(1), 0.05);
    double missing = 0, missingTwice = 0, products = 0, alone = 0, pairs = 0;
    for (std::size_t i = 1; i < reports.size(); ++i) {
        const auto gap = (reports[i].measured - reports[i - 1].measured) / (100 * localiserMillisecond);
        if (gap > 1) missing += static_cast<double>(gap - 1), missingTwice += static_cast<double>(gap - 2);
        if (gap != 1) continue;
        products += reports[i].error.x * reports[i - 1].error.x;
        alone += reports[i].error.y * reports[i - 1].error.y;
        ++pairs;
    }
    EXPECT_NEAR(products / pairs, 0.6 * std::exp(-0.1 / 1.2), 0.08);
    EXPECT_NEAR(alone / pairs, 0, 0.06);
    EXPECT_GT(missingTwice / missing, 0.3) << "by chance it were 0.16";
}

TEST(LearnedLocalisers, GoOnToTheSameBitsFromEveryTick) {
    const Scenario scenario = localised(someLocalisation(), driving(), 60 * localiserMillisecond);
    WorldState state = scenario.initialState(9);
    StepBuffers buffers, others;
    for (int k = 0; k < 200; ++k) {
        auto restored = parseState(stateBytes(state), "saved");
        ASSERT_TRUE(restored);
        StepTrace trace, again;
        step(scenario, state, buffers, {}, &trace);
        step(scenario, *restored, others, {}, &again);
        ASSERT_EQ(hashOf(state), hashOf(*restored)) << k;
        if (!trace.robots[0].observed) continue;
        ASSERT_EQ(trace.robots[0].observation, again.robots[0].observation) << k;
    }
}

/// Reads nothing.
class Blind final : public Controller {
public:
    Attention attention() const override { return Attention::only({}); }
    void decide(const Observation&, std::span<std::byte>, Decision& decision) const override {
        decision.command = Command{0.3, 0.4};
    }
};

TEST(LearnedLocalisers, GoOnTheSameWhetherTheyAreReadOrNot) {
    const Scenario read = localised(someLocalisation(), driving()),
                   unread = localised(someLocalisation(), std::make_shared<const Blind>());
    WorldState a = read.initialState(9), b = unread.initialState(9);
    run(read, a, 200);
    run(unread, b, 200);
    EXPECT_EQ(hashOf(a), hashOf(b));
}

}  // namespace
}  // namespace mrose
