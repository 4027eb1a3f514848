#include "identification/familiar_driving.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "identification/driven_log.h"
#include "identification/recipes.h"
#include "logs/log_reader.h"
#include "logs/pose_grid.h"
#include "motion/driving_reader.h"
#include "support/test_data.h"
#include "support/units.h"

namespace mrose {
namespace {

MotionNetwork blueprintOf(MotionNetwork::Form form) {
    const ResponseTimes times{0.32, 0.2, 0.32, 0.1, 0.2, 0.1};
    const auto recipe = form == MotionNetwork::Form::state ? stateBlueprint : historyBlueprint;
    return recipe(RobotTraits(), {"reference"}, times);
}

SampleOptions onePhase() {
    SampleOptions options;
    options.phases = 1;
    return options;
}

struct Marked {
    std::size_t periods = 0, marked = 0;
    double share() const { return double(marked) / double(std::max<std::size_t>(1, periods)); }
};

/// Of the periods in which the commands that are described all fit.
template <class Fits>
Marked marked(const Log& log, const DrivingReader& reader, Fits fits) {
    Marked sum;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            const PoseGrid grid = poseGrid(trajectory);
            CommandHistory history;
            std::size_t issued = 0;
            for (std::size_t i = 0; i < grid.size(); ++i) {
                const auto& commands = trajectory.commands;
                for (; issued < commands.size() && commands[issued].time <= grid.time(i); ++issued)
                    history.issue(commands[issued].time, commands[issued].command);
                if (!grid.ok[i]) continue;
                const MotionInput input{&history, grid.time(i), grid.velocities[i]};
                bool all = true;
                for (Nanoseconds age = fromSeconds(reader.familiar().w.newest); age <= reader.lookBack();
                     age += 10 * ms)
                    all = all && fits(history.at(grid.time(i) - age));
                if (!all) continue;
                ++sum.periods;
                sum.marked += reader.isUnfamiliar(input) ? 1 : 0;
                EXPECT_EQ(reader.isUnfamiliar(input), reader.unfamiliar(input) > FamiliarDriving::bound);
            }
        }
    return sum;
}

class Familiar : public testing::TestWithParam<MotionNetwork::Form> {};

TEST_P(Familiar, WithoutFastTurnsMarksFastTurnsAndLittleElse) {
    constexpr double fastest = 0.6;
    const std::vector<Log> logs{drivenReference(fastest, 24, 1)};
    const auto familiar = familiarDriving(logs, blueprintOf(GetParam()), onePhase());
    ASSERT_TRUE(familiar);
    EXPECT_GT(familiar->periods, 5000);
    const DrivingReader reader(GetParam(), *familiar);
    const auto all = [](const Command&) { return true; };
    const Marked alike = marked(drivenReference(fastest, 24, 1000), reader, all);
    EXPECT_GT(alike.periods, 5000u);
    EXPECT_LT(alike.share(), 0.003);
    const Log wild = drivenReference(2, 60, 2000);
    const Marked fast = marked(wild, reader, [](const Command& c) { return std::abs(c.w) > 1.5 * fastest; });
    EXPECT_GT(fast.periods, 500u);
    EXPECT_GT(fast.share(), 0.96);
    const Marked slow = marked(wild, reader, [](const Command& c) { return std::abs(c.w) < fastest; });
    EXPECT_GT(slow.periods, 5000u);
    EXPECT_LT(slow.share(), 0.01) << "some of it comes out of fast turns";
}

TEST_P(Familiar, MarksCommandsThatGoBackAndForthFasterThanAnyThatWereLearnedFrom) {
    const std::vector<Log> logs{drivenReference(0.6, 12, 1)};
    const auto familiar = familiarDriving(logs, blueprintOf(GetParam()), onePhase());
    ASSERT_TRUE(familiar);
    const DrivingReader reader(GetParam(), *familiar);
    CommandHistory held, shaken;
    for (int i = 0; i < 20; ++i) {
        held.issue(i * 100 * ms, {0.2, 0});
        shaken.issue(i * 100 * ms, {0.2, i % 2 == 0 ? 0.55 : -0.55});
    }
    EXPECT_LT(reader.unfamiliar({&held, 2000 * ms, {0.19, 0}}), 0.6);
    EXPECT_GT(reader.unfamiliar({&shaken, 2000 * ms, {0.19, 0}}), FamiliarDriving::bound);
}

TEST_P(Familiar, HeldOutPeriodsExceedTheDistancesAsOftenAsTheyAreSaidTo) {
    const Log log = drivenReference(1, 24, 5);
    const auto familiar = familiarDriving({&log, 1}, blueprintOf(GetParam()), onePhase());
    ASSERT_TRUE(familiar);
    EXPECT_LE(familiar->prototypes.size(), FamiliarDriving::mostPrototypes);
    EXPECT_LT(familiar->distances[0], familiar->distances[1]);
    EXPECT_LT(familiar->distances[1], familiar->distances[2]);
    // Everything that was learned from lies near a prototype: nearer than what was held out.
    const DrivingReader reader(GetParam(), *familiar);
    EXPECT_EQ(marked(log, reader, [](const Command&) { return true; }).marked, 0u);
}

INSTANTIATE_TEST_SUITE_P(Forms, Familiar, testing::Values(MotionNetwork::Form::state, MotionNetwork::Form::history),
                         [](const auto& of) { return of.param == MotionNetwork::Form::state ? "state" : "history"; });

TEST(FamiliarDriving, TheNumberRisesEvenlyFromOneDistanceToTheNext) {
    FamiliarDriving familiar;
    familiar.v = {0, 0.4, 0.1};
    familiar.w = {0, 0.4, 1};
    familiar.prototypes = {{}};
    familiar.distances = {1, 2, 4};
    const DrivingReader reader(MotionNetwork::Form::state, familiar);
    const auto at = [&](double v, double w) { return reader.unfamiliar({CommandView(), 0, {v, w}}); };
    EXPECT_EQ(at(0, 0), 0);
    EXPECT_NEAR(at(0.05, 0), 0.15, 1e-12);
    EXPECT_NEAR(at(0, 1), 0.3, 1e-12);
    EXPECT_NEAR(at(0.15, 0), 0.45, 1e-12);
    EXPECT_NEAR(at(0, 3), 0.75, 1e-12);
    EXPECT_NEAR(at(0, 4), 0.9, 1e-12);
    EXPECT_LE(at(0, 4), FamiliarDriving::bound);
    EXPECT_NEAR(at(0, 5), 0.95, 1e-12);
    EXPECT_EQ(at(3, 4), 1);
}

/// Of form history: means over the halves, and the way of the commands beyond that from the first to the last.
TEST(FamiliarDriving, ReadsOlderAndNewerCommandsAndHowFarTheyGoBackAndForth) {
    FamiliarDriving channels;
    channels.v = {0.1, 0.5, 0.1};
    channels.w = {0.1, 0.5, 2};
    const DrivingReader reader(MotionNetwork::Form::history, channels);
    CommandHistory history;
    history.issue(500 * ms, {0.4, 1});   // 0.5 to 0.4 s before
    history.issue(600 * ms, {0.2, -1});  // 0.4 to 0.3 s
    history.issue(700 * ms, {0.1, 1});   // 0.3 to 0.1 s
    history.issue(900 * ms, {9, 9});     // is not read yet
    const FamiliarDriving::Driving driving = reader.driving({&history, 1000 * ms, {7, 7}});
    const double reversal = DrivingReader::reversalWeight * 4 / 2;  // -1 between two 1: 4 rad/s of way
    const FamiliarDriving::Driving expected{3, 0, 1, 0.5, 0, reversal};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(driving[i], expected[i], 1e-12) << i;
}

TEST(FamiliarDriving, NothingIsSaidWhereNothingCanBeHeldOut) {
    const Log log = drivenReference(1, 1, 5);
    EXPECT_FALSE(familiarDriving({&log, 1}, blueprintOf(MotionNetwork::Form::state), onePhase()));
}

TEST(FamiliarDriving, OtherRobotsOfADataSetAreSeldomMarked) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs; MROSE_DATA names their folder";
    auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset6");
    ASSERT_TRUE(log) << log.error().message();
    Log known = *log, others = std::move(*log);
    known.robots.erase(known.robots.begin(), known.robots.begin() + 2);
    others.robots.resize(2);
    const MotionNetwork blueprint =
        historyBlueprint(RobotTraits(), {"3", "4", "5"}, {0.17, 0.1, 0.17, 0.12, 0.1, 0.12});
    const auto familiar = familiarDriving({&known, 1}, blueprint, onePhase());
    ASSERT_TRUE(familiar);
    const DrivingReader reader(blueprint.form, *familiar);
    const Marked alike = marked(others, reader, [](const Command&) { return true; });
    EXPECT_GT(alike.periods, 10'000u);
    EXPECT_LT(alike.share(), 0.003);
    EXPECT_GT(reader.unfamiliar({CommandView({}, {0.06, 1.2}), 0, {0.06, 1.2}}), FamiliarDriving::bound);
}

}  // namespace
}  // namespace mrose
