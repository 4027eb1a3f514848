#include "assessment/reality.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assessment/played_scenarios.h"
#include "assessment/test_models.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

Command leftTurn(double /*t*/) { return {0.2, 0.5}; }

/// A circle at 50 poses a second from 100 s to 120 s, without poses between 106 s and 107 s.
Log circleWithGap() {
    Log log = logOf({obedientTrajectory(100 * second, 20 * second, leftTurn)});
    std::erase_if(log.robots[0].trajectories[0].poses,
                  [](const StampedPose& pose) { return pose.time > 106 * second && pose.time < 107 * second; });
    return log;
}

/// Where it is `t` seconds from its start.
Pose onCircle(double t) { return Pose{1, -2, 0.3} * exp({0.2 * t, 0, 0.5 * t}); }

class RealityOfALog : public testing::Test {
protected:
    RealityOfALog() : log(std::make_shared<const Log>(circleWithGap())) {
        const auto world = LogWorld::create(playersOf(*log, std::make_shared<const HeldCommandModel>()), log);
        EXPECT_TRUE(world) << world.error().message();
        reality = realityOf(*world, 0, 3 * second);
    }
    const Reality::Robot& robot() const { return reality.robots.at(0); }

    std::shared_ptr<const Log> log;
    Reality reality;
};

TEST_F(RealityOfALog, ItsClockBeginsAtTheStart) {
    EXPECT_EQ(reality.start, 3 * second);
    EXPECT_EQ(robot().origin, 103 * second);
    EXPECT_EQ(robot().realName, "r");
    EXPECT_EQ(reality.robotNamed("simulated r"), &robot());
    EXPECT_EQ(reality.robotNamed("r"), nullptr);
    const Trajectory& trajectory = log->robots[0].trajectories[0];
    for (const Nanoseconds now : {Nanoseconds{0}, second / 3, 2 * second + 7, 10 * second}) {
        const auto pose = robot().poseAt(now);
        ASSERT_TRUE(pose) << now;
        EXPECT_EQ(*pose, truthAt(trajectory.poses, 103 * second + now));
        const Pose expected = onCircle(3 + toSeconds(now));
        EXPECT_NEAR(pose->x, expected.x, 1e-4);  // a line fitted to an arc
        EXPECT_NEAR(pose->y, expected.y, 1e-4);
        EXPECT_NEAR(wrapAngle(pose->heading - expected.heading), 0, 1e-9);
    }
}

TEST_F(RealityOfALog, SpeedIsTheSlopeOfThePoses) {
    const auto velocity = robot().velocityAt(1'234'567'890);
    ASSERT_TRUE(velocity);
    EXPECT_NEAR(velocity->v, 0.2, 1e-4);
    EXPECT_NEAR(velocity->w, 0.5, 1e-9);
    EXPECT_FALSE(robot().velocityAt(3'500'000'000));
}

TEST_F(RealityOfALog, IsUnknownInGapsAndBeyondTheEnds) {
    for (const double now : {-3.01, 3.01, 3.5, 3.99, 17.01}) EXPECT_FALSE(robot().poseAt(fromSeconds(now))) << now;
    for (const double now : {-3.0, 0.0, 3.0, 4.001, 17.0}) EXPECT_TRUE(robot().poseAt(fromSeconds(now))) << now;
    using Stretch = Reality::Robot::Stretch;
    EXPECT_EQ(robot().unknownBetween(-5 * second, 20 * second),
              (std::vector<Stretch>{{-5 * second, -3 * second}, {3 * second, 4 * second}, {17 * second, 20 * second}}));
    EXPECT_EQ(robot().unknownBetween(3 * second + 1, 3 * second + 9),
              (std::vector<Stretch>{{3 * second + 1, 3 * second + 9}}));
    EXPECT_TRUE(robot().unknownBetween(4 * second, 17 * second).empty());
    // As poseAt has it, at every hundredth of a second.
    const auto stretches = robot().unknownBetween(-5 * second, 20 * second);
    for (Nanoseconds now = -5 * second + second / 200; now < 20 * second; now += second / 100) {
        bool known = true;
        for (const Stretch& stretch : stretches) known = known && (now <= stretch.from || now >= stretch.to);
        EXPECT_EQ(robot().poseAt(now).has_value(), known) << now;
    }
}

TEST_F(RealityOfALog, MeasuredPosesBetweenTwoInstantsIncludeBoth) {
    const auto some = robot().posesBetween(second, second + second / 10);
    ASSERT_EQ(some.size(), 6u);
    EXPECT_EQ(some.front().time, 104 * second);
    EXPECT_EQ(some.back().time, 104 * second + second / 10);
    EXPECT_EQ(robot().posesBetween(3 * second, 4 * second).size(), 2u) << "the gap's edges";
    EXPECT_TRUE(robot().posesBetween(3 * second + 1, 4 * second - 1).empty());
    EXPECT_EQ(robot().posesBetween(-100 * second, 100 * second).size(), log->robots[0].trajectories[0].poses.size());
    EXPECT_TRUE(robot().posesBetween(18 * second, 19 * second).empty());
}

TEST_F(RealityOfALog, ModelsHoldTheirPosesForAStepAndEnd) {
    Reality::ModelRollout model{"m", second / 10, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}};
    EXPECT_FALSE(model.poseAt(0, -1));
    EXPECT_EQ(model.poseAt(0, 0)->x, 0);
    EXPECT_EQ(model.poseAt(0, second / 10 - 1)->x, 0);
    EXPECT_EQ(model.poseAt(0, second / 10)->x, 1);
    EXPECT_EQ(model.poseAt(0, 3 * second / 10 - 1)->x, 2);
    EXPECT_FALSE(model.poseAt(0, 3 * second / 10));
    EXPECT_FALSE(model.poseAt(1, 0)) << "it has none of that robot";
    // Held against the truth of its own instant, not of now.
    const auto error = reality.modelError(model, 0, 2 * second / 10 - 1);
    ASSERT_TRUE(error);
    const Pose real = *robot().poseAt(second / 10);
    EXPECT_DOUBLE_EQ(error->position, std::hypot(1 - real.x, real.y));
    EXPECT_FALSE(reality.modelError(model, 0, second));
}

TEST(PoseError, IsAbsoluteAndTheHeadingGoesRound) {
    constexpr double pi = std::numbers::pi;
    const PoseError error = poseError({1, 2, pi - 0.1 + 4 * pi}, {4, -2, -pi + 0.2});
    EXPECT_DOUBLE_EQ(error.position, 5);
    EXPECT_NEAR(error.heading, 0.3, 1e-12);
    EXPECT_NEAR(poseError({0, 0, 0.2}, {0, 0, -0.3}).heading, 0.5, 1e-12);
}

}  // namespace
}  // namespace mrose
