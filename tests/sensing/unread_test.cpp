// Readings that no controller reads: whoever traces a tick may ask for them, and nothing else changes.
#include <gtest/gtest.h>

#include "condition/condition.h"
#include "experiment/run.h"
#include "quantities/moment.h"
#include "sensing/laser.h"
#include "sensing/ranging.h"
#include "sensing/wheel_encoders.h"

namespace mrose {
namespace {

constexpr Nanoseconds slow = 300'000'000, unreadLatency = 40'000'000;

class Reads final : public Controller {
public:
    explicit Reads(Attention attention) : attention_(std::move(attention)) {}
    Attention attention() const override { return attention_; }
    void decide(const Observation&, std::span<std::byte>, Decision& decision) const override {
        decision.command = Command{0.3, 0.2};
    }

private:
    Attention attention_;
};

SensorPointer noisyLaser() {
    Laser::Options options;
    options.beams = 19;
    options.first = -1.5;
    options.step = 3.0 / 18;
    options.errors.range = 12;
    options.errors.noise = 0.05;
    options.latency = unreadLatency;
    return std::make_shared<const Laser>(SensorTraits{"laser", slow}, options);
}

/// A robot that drives through a field, with a slow laser and encoders, of which its controller reads some.
Scenario readingOnly(const Attention& attention) {
    RobotType type = discRobot(0.2);
    type.sensors = {noisyLaser(),
                    std::make_shared<const WheelEncoders>(SensorTraits{"wheels", 0}, WheelEncoders::Options{})};
    return SmallWorld(walledField(8, 6))
        .robot(type, {2, 3, 0}, std::make_shared<const Reads>(attention), ideal())
        .robot(discRobot(0.3), {5, 3, 0}, std::make_shared<const Told>(Command{0.2, 0.1}), ideal())
        .scenario();
}

void expectSameReading(const Observation& one, const Observation& other, const ReadingName& name) {
    const Reading *const a = one.find(name), *const b = other.find(name);
    ASSERT_EQ(a == nullptr, b == nullptr);
    if (a == nullptr) return;
    EXPECT_EQ(a->measured, b->measured);
    ASSERT_EQ(a->count, b->count);
    EXPECT_EQ(std::memcmp(one.recordsOf(*a), other.recordsOf(*b), a->count * a->type->size), 0);
}

TEST(Unread, AreTheReadingsOfAControllerThatReadsAll) {
    for (const std::string& read : {std::string(), std::string("laser"), std::string("wheels")}) {
        const Scenario attentive = readingOnly({}), scenario = readingOnly(Attention::only({read}));
        WorldState all = attentive.initialState(3), state = scenario.initialState(3), plain = state;
        StepBuffers buffers;
        StepTrace full, trace, without;
        trace.asksUnread = true;
        int scans = 0;
        for (int k = 0; k < 200; ++k) {
            step(attentive, all, buffers, {}, &full);
            step(scenario, state, buffers, {}, &trace);
            step(scenario, plain, buffers, {}, &without);
            ASSERT_EQ(hashOf(state), hashOf(plain)) << "asking changes nothing";
            ASSERT_EQ(hashOf(state), hashOf(all));
            EXPECT_TRUE(without.robots[0].unread.readings().empty());
            EXPECT_TRUE(trace.robots[1].unread.readings().empty()) << "it has no sensors of its own";
            if (!trace.robots[0].decided) {
                EXPECT_TRUE(trace.robots[0].unread.readings().empty());
                continue;
            }
            EXPECT_EQ(trace.robots[0].observation, without.robots[0].observation);
            for (const char* const name : {"laser", "wheels"}) {
                const StepTrace::Robot& robot = trace.robots[0];
                EXPECT_EQ(robot.unread.find(name) != nullptr && read == name, false);
                expectSameReading(read == name ? robot.observation : robot.unread, full.robots[0].observation, name);
            }
            scans += full.robots[0].observation.find("laser") != nullptr ? 1 : 0;
        }
        EXPECT_GE(scans, 10);
    }
}

TEST(Unread, ARobotThatIsCommandedFromOutsideHasAll) {
    const Scenario scenario = readingOnly({});
    WorldState state = scenario.initialState(3);
    StepBuffers buffers;
    StepTrace trace;
    trace.asksUnread = true;
    const RobotDecision told{0, {}};
    step(scenario, state, buffers, {{&told, 1}}, &trace);
    EXPECT_FALSE(trace.robots[0].observed);
    EXPECT_EQ(trace.robots[0].unread.records<RangeEcho>("laser").size(), 0u) << "the first is still on its way";
    EXPECT_EQ(trace.robots[0].unread.records<WheelTicks>("wheels").size(), 1u);
}

TEST(Unread, ASlowSensorsReadingIsKnownUntilTheNext) {
    const Scenario scenario = readingOnly(Attention::ofItself());
    WorldState state = scenario.initialState(3);
    StepBuffers buffers;
    StepTrace trace;
    trace.asksUnread = true;
    std::vector<RobotInsight> insights(2);
    int known = 0;
    for (int k = 0; k < 200; ++k) {
        const std::vector<std::byte> before = state.memory;
        step(scenario, state, buffers, {}, &trace);
        noteInsights(scenario, trace, state.tick, before, insights);
        const Moment moment{&scenario, &state, &trace, insights};
        const Nanoseconds decided = scenario.scene().timeOf(insights[0].tick);
        const Nanoseconds newest = (decided - unreadLatency) / slow * slow;
        for (const NewestReading& one : newestReadings(moment, 0)) {
            if (one.sensor->name() != "laser") continue;
            EXPECT_EQ(one.reading->measured, decided < unreadLatency ? -slow : newest) << state.tick;
            EXPECT_EQ(one.records<RangeEcho>().size(), 19u);
            ++known;
        }
    }
    EXPECT_GE(known, 190);
}

/// The sensor is on the robot, so that it can be asked for, whoever drives it.
TEST(Unread, ConditionsMayAskForThem) {
    const Scenario scenario = readingOnly(Attention::ofItself());
    auto condition = compileCondition("robot[1].laser.nearest < 1", scenario, "condition", nullptr);
    ASSERT_TRUE(condition) << condition.error().message();
    RunOptions options;
    options.duration = 20 * nanosecondsPerSecond;
    options.until = &*condition;
    const auto result = run(scenario, scenario.initialState(3), options);
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->end, RunEnd::condition);
    EXPECT_GT(result->state.tick, 50);
}

}  // namespace
}  // namespace mrose
