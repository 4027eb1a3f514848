// A motion model with memory, noise and a spread of its own, as somebody would add one: all of it is in this file.
#include <cmath>

#include <gtest/gtest.h>

#include "motion/noisy_model.h"
#include "quantities/value_key.h"
#include "scenario/carry_over.h"
#include "scenario/saved_state.h"
#include "simulation/small_world.h"
#include "support/units.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

/// Drives as it is told, slower the less its battery holds, on a floor whose grip drifts.
class TiringDrive final : public MotionModel {
public:
    struct Memory {
        double charge = 0;  ///< 1: full
        double slip = 0;    ///< share of the way; drifts
    };
    static constexpr double range = 10;  // m

    explicit TiringDrive(double drift) : drift_(drift) {}

    Nanoseconds period() const override { return 100 * ms; }
    Nanoseconds lookBack() const override { return 0; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    void start(std::span<std::byte> memory) const override { as<Memory>(memory) = {1, 0}; }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override {
        entries.add("charge", as<Memory>(memory).charge);
        entries.add("slip", as<Memory>(memory).slip);
    }
    bool sameAs(const MotionModel& other) const override {
        const auto* tiring = dynamic_cast<const TiringDrive*>(&other);
        return tiring != nullptr && tiring->drift_ == drift_;
    }
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override {
        for (std::size_t i = 0; i < inputs.size(); ++i) steps[i] = step(inputs[i]);
    }
    void predictWithSpread(std::span<const MotionInput> inputs, std::span<MotionStep> steps,
                           std::span<MotionSpread> spreads) const override {
        predict(inputs, steps);
        for (std::size_t i = 0; i < inputs.size(); ++i) spreads[i] = {{drift_ * steps[i].increment.x, 0, 0}, {}};
    }

private:
    MotionStep step(const MotionInput& input) const {
        Memory fresh{1, 0};
        Memory& memory = input.memory.empty() ? fresh : as<Memory>(input.memory);
        if (input.noise) memory.slip = 0.9 * memory.slip + drift_ * normalNoise(input.key(0));
        const Command told = input.commands.at(input.start);
        const double v = told.v * memory.charge, way = 0.1 * v * (1 - memory.slip);
        memory.charge = std::max(0.0, memory.charge - std::abs(0.1 * v) / range);
        return {exp(Twist{way, 0, 0.1 * told.w}), {v, told.w}};
    }

    double drift_;
};

Scenario driven(double drift, const MotionNoise& noise = {}) {
    SmallWorld world;
    const auto model = withNoise(std::make_shared<const TiringDrive>(drift), noise);
    const auto told = std::make_shared<const Told>(Command{0.5, 0});
    world.robot(discRobot(), {}, told, model).robot(discRobot(), {0, 5, 0}, told, model, 2);
    return world.scenario();
}

TEST(ToyMotionModel, DrivesInAScenarioAndRemembers) {
    const Scenario scenario = driven(0);
    WorldState state = scenario.initialState();
    double charge = 1, way = 0;
    for (int period = 0; period < 300; ++period) {
        way += 0.1 * 0.5 * charge;
        charge -= 0.1 * 0.5 * charge / TiringDrive::range;
        run(scenario, state, 5);
        ASSERT_NEAR(state.robots[0].pose.x, way, 1e-9) << period;
    }
    EXPECT_NEAR(way, TiringDrive::range * (1 - std::pow(1 - 0.005, 300)), 1e-9) << "in closed form";
}

TEST(ToyMotionModel, IsExplainedInTheCatalogue) {
    const Scenario scenario = driven(0.02);
    WorldState state = scenario.initialState();
    const auto charge = boundValue(scenario, {"motion", "1", "charge"});
    ASSERT_TRUE(charge) << charge.error().message();
    EXPECT_EQ(pathOf(scenario, *charge), "robot[\"1\"].motion[\"charge\"]");
    EXPECT_EQ(numberOf(charge->value({&scenario, &state})), 1);
    run(scenario, state, 500);
    EXPECT_EQ(numberOf(charge->value({&scenario, &state})),
              as<TiringDrive::Memory>(scenario.motionMemory(std::as_const(state), 0)).charge);
    EXPECT_LT(numberOf(charge->value({&scenario, &state})), 0.7);
}

TEST(ToyMotionModel, IsRewoundWithWhatItDrew) {
    const Scenario scenario = driven(0.02, {0.02, 0.02, 0.02});
    WorldState state = scenario.initialState();
    run(scenario, state, 123);
    const WorldState kept = state;
    run(scenario, state, 200);
    WorldState again = kept, other = kept;
    run(scenario, again, 200);
    EXPECT_EQ(stateBytes(again), stateBytes(state));
    other.seed = 99;
    run(scenario, other, 200);
    EXPECT_NE(other.robots[0].pose.x, state.robots[0].pose.x);
    EXPECT_NE(other.robots[0].pose.x, other.robots[1].pose.x);
}

TEST(ToyMotionModel, IsSavedAndCarriedOver) {
    const Scenario scenario = driven(0.02), alike = driven(0.02), other = driven(0.05);
    WorldState state = scenario.initialState();
    run(scenario, state, 123);
    EXPECT_EQ(carriedOver(scenario, state, alike).motion, state.motion);
    EXPECT_EQ(carriedOver(scenario, state, other).motion, other.initialState().motion) << "another one begins anew";
    const auto read = parseSavedState(savedStateText(savedState(scenario, state)), "toy.state");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(restored(*read, alike, state.seed).motion, state.motion);
}

/// What a robot file adds is drawn apart from what the model draws: the two are not correlated.
TEST(ToyMotionModel, NoiseAroundItIsDrawnApart) {
    const std::shared_ptr<const MotionModel> plain = std::make_shared<const TiringDrive>(0.1),
                                             noisy = withNoise(plain, {0.1, 0, 0});
    CommandHistory history;
    history.issue(0, {0.5, 0});
    double product = 0, squares = 0;
    constexpr std::uint64_t seeds = 4000;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        MotionInput input{&history, 0, {}};
        input.noise = NoiseKey{seed, 5, 0, channelOf(NoiseChannel::motion)};
        const double own = plain->predictOne(input).increment.x, both = noisy->predictOne(input).increment.x;
        product += (own - 0.05) * (both - own);
        squares += (own - 0.05) * (own - 0.05);
    }
    EXPECT_NEAR(product / squares, 0, 4.5 / std::sqrt(double{seeds}));
}

TEST(ToyMotionModel, SaysHowUnsureItIsAndGivesItsMeanWithoutAKey) {
    const auto model = withNoise(std::make_shared<const TiringDrive>(0.02), {0.1, 0.1, 0.1});
    CommandHistory history;
    history.issue(0, {0.5, 0});
    const MotionInput input{&history, 0, {}};
    std::vector<MotionStep> steps(1);
    std::vector<MotionSpread> spreads(1);
    model->predictWithSpread({&input, 1}, steps, spreads);
    EXPECT_EQ(steps[0].increment.x, 0.05);
    EXPECT_NEAR(spreads[0].increment.x, 0.001, 1e-15);
}

}  // namespace
}  // namespace mrose
