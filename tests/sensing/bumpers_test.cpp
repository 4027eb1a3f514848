#include "sensing/bumpers.h"

#include <gtest/gtest.h>

#include "sensing/ranging.h"

namespace mrose {
namespace {

using std::numbers::pi;
constexpr Nanoseconds bumperMillisecond = 1'000'000;

/// Four quarters, the first ahead.
std::shared_ptr<const Bumpers> quarters(Nanoseconds period = 0) {
    std::vector<Bumpers::Segment> segments;
    for (int i = 0; i < 4; ++i) segments.push_back({-pi / 4 + i * pi / 2, pi / 2});
    return std::make_shared<const Bumpers>(SensorTraits{"bumper", period}, segments);
}

RobotType bumping(Nanoseconds period = 0) {
    RobotType type = discRobot(0.2);
    type.sensors = {quarters(period)};
    return type;
}

std::shared_ptr<const MotionModel> every100ms() {
    return std::make_shared<const KinematicModel>(KinematicParameters{}, 100 * bumperMillisecond);
}

struct Felt {
    std::vector<std::vector<BumperContact>> readings;
    std::vector<std::vector<int>> touched;  ///< by tick, the quarters in which the trace has contacts of robot 0
    std::vector<std::int64_t> ticks;        ///< at which the readings were given
};

Felt felt(const Scenario& scenario, int ticks) {
    Felt felt;
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < ticks; ++k) {
        const std::int64_t now = state.tick;
        step(scenario, state, buffers, {}, &trace);
        auto& quartersNow = felt.touched.emplace_back();
        for (const ContactReport& report : trace.contacts) {
            if (report.bodyA != 0 && report.bodyB != 0) continue;
            const Point at = Placement(state.robots[0].pose).placeBack(report.position);
            quartersNow.push_back(static_cast<int>(std::floor(wrapAngle(direction(at) + pi / 4 - pi) / (pi / 2) + 2)));
        }
        if (!trace.robots[0].observed) continue;
        const auto records = trace.robots[0].observation.records<BumperContact>("bumper");
        felt.readings.emplace_back(records.begin(), records.end());
        felt.ticks.push_back(now);
    }
    return felt;
}

TEST(Bumpers, OneIsPressedForATouchAndNoneWithout) {
    const Scenario scenario =
        SmallWorld(wallAhead(1))
            .robot(bumping(), {0, 0, 0}, std::make_shared<const Told>(Command{0.5, 0}), every100ms())
            .scenario();
    const Felt f = felt(scenario, 200);
    int pressed = 0;
    for (std::size_t i = 1; i < f.readings.size(); ++i) {
        bool touchedSince = false;
        for (std::int64_t tick = f.ticks[i - 1]; tick < f.ticks[i]; ++tick)
            touchedSince = touchedSince || !f.touched[static_cast<std::size_t>(tick)].empty();
        EXPECT_EQ(f.readings[i][0].pressed, touchedSince ? 1U : 0U) << i;
        for (const std::size_t other : {1, 2, 3}) EXPECT_EQ(f.readings[i][other].pressed, 0U);
        pressed += touchedSince ? 1 : 0;
    }
    EXPECT_GT(pressed, 20);
    EXPECT_EQ(f.readings.back()[0].touches, 1U) << "it leans on the wall all the time";
    EXPECT_NEAR(f.readings.back()[1].bearing, pi / 2, 1e-12);
}

/// A ball that bounces off between two control instants is felt at the next one, on its side, and once.
TEST(Bumpers, ATouchBetweenControlInstantsIsFelt) {
    for (const double bearing : {0.0, pi / 2, pi, -pi / 2}) {
        const Point from = 0.5 * towards(bearing), speed = -2.0 * towards(bearing);
        const Scenario scenario =
            SmallWorld()
                .robot(bumping(), {0, 0, 0}, std::make_shared<const Told>(Command{}), every100ms(), 3)
                .object(ballType(), {from.x, from.y, 0}, {speed.x, speed.y, 0})
                .scenario();
        const Felt f = felt(scenario, 100);
        int presses = 0;
        const auto quarter = static_cast<std::size_t>(std::lround(bearing / (pi / 2)) + 4) % 4;
        for (const auto& reading : f.readings)
            for (std::size_t i = 0; i < 4; ++i) {
                presses += reading[i].pressed != 0 ? 1 : 0;
                EXPECT_TRUE(i == quarter || reading[i].pressed == 0) << bearing;
            }
        EXPECT_EQ(presses, 1) << bearing;
        EXPECT_EQ(f.readings.back()[quarter].touches, 1U);
    }
}

/// What the trace says of contacts, with robots that jostle.
TEST(Bumpers, ArePressedWhereTheContactsOfTheTicksAre) {
    for (const Nanoseconds period : {Nanoseconds{0}, 20 * bumperMillisecond}) {
        SmallWorld world(walledField(2.2, 2.2));
        for (int i = 0; i < 6; ++i)
            world.robot(i == 0 ? bumping(period) : discRobot(0.2), {0.4 + 0.6 * (i % 3), 0.5 + 0.9 * (i / 3), 1.0 * i},
                        std::make_shared<const RandomCommands>(0.2, 0.8, 2), every100ms(), i % 5);
        const Felt f = felt(world.scenario(), 1500);
        int pressed = 0;
        for (std::size_t i = 1; i < f.readings.size() && period == 0; ++i) {
            std::array<bool, 4> expected{};
            for (std::int64_t tick = f.ticks[i - 1]; tick < f.ticks[i]; ++tick)
                for (const int quarter : f.touched[static_cast<std::size_t>(tick)])
                    expected[static_cast<std::size_t>((quarter + 4) % 4)] = true;
            int felt = 0, touched = 0;
            for (std::size_t quarter = 0; quarter < 4; ++quarter) {
                felt += f.readings[i][quarter].pressed != 0 ? 1 : 0;
                touched += expected[quarter] ? 1 : 0;
                pressed += expected[quarter] ? 1 : 0;
            }
            EXPECT_EQ(felt, touched) << i;
        }
        EXPECT_TRUE(period != 0 || pressed > 50);
        EXPECT_GT(f.readings.back()[0].touches, 3U);
    }
}

TEST(Bumpers, AClockOfTheirOwnTellsEachTick) {
    const Scenario scenario = SmallWorld(wallAhead(0.5))
                                  .robot(bumping(20 * bumperMillisecond), {0, 0, 0},
                                         std::make_shared<const Told>(Command{0.5, 0}), every100ms())
                                  .scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    std::vector<bool> touched(1, false);  // at each tick's end
    int pressed = 0;
    for (int k = 0; k < 100; ++k) {
        step(scenario, state, buffers, {}, &trace);
        touched.push_back(!trace.contacts.empty());
        if (!trace.robots[0].observed) continue;
        const Observation& seen = trace.robots[0].observation;
        for (const Reading& reading : seen.readings()) {
            if (reading.name != ReadingName("bumper") || reading.measured < 0) continue;
            const auto tick = static_cast<std::size_t>(reading.measured / (20 * bumperMillisecond));
            EXPECT_EQ(seen.records<BumperContact>(&reading)[0].pressed != 0, touched[tick]) << tick;
            pressed += touched[tick] ? 1 : 0;
        }
    }
    EXPECT_GT(pressed, 20);
}

TEST(Bumpers, RepeatTheirReadingsFromEveryTick) {
    SmallWorld world(walledField(1.5, 1.5));
    for (int i = 0; i < 3; ++i)
        world.robot(bumping(i == 0 ? 0 : 40 * bumperMillisecond), {0.4 + 0.5 * (i % 2), 0.4 + 0.5 * (i / 2), 1.0 * i},
                    std::make_shared<const RandomCommands>(0.2, 0.8, 2), every100ms(), i);
    const Scenario scenario = world.scenario();
    expectSameFromEveryTick(scenario, 300);
    WorldState state = scenario.initialState();
    std::size_t most = 0;
    for (int k = 0; k < 300; ++k) {
        run(scenario, state, 1);
        most = std::max(most, state.touches.size());
    }
    EXPECT_GT(most, 0u);
    EXPECT_LT(most, 60u) << "old ones are forgotten";
}

TEST(Bumpers, OthersKeepNoTouches) {
    SmallWorld world(walledField(1.5, 1.5));
    for (int i = 0; i < 3; ++i)
        world.robot(discRobot(0.2), {0.4 + 0.5 * (i % 2), 0.4 + 0.5 * (i / 2), 1.0 * i},
                    std::make_shared<const RandomCommands>(0.2, 0.8, 2), every100ms(), i);
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 300);
    EXPECT_TRUE(state.touches.empty());
}

}  // namespace
}  // namespace mrose
