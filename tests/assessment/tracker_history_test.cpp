#include "assessment/tracker_history.h"

#include <gtest/gtest.h>

#include "assessment/named_model.h"
#include "assessment/test_models.h"
#include "support/units.h"

namespace mrose {
namespace {

Command wanders(double t) { return {0.2 + 0.1 * std::sin(t), 0.6 * std::sin(0.7 * t)}; }

/// The same drive, tracked by a marker that lies so; from `knocked` on otherwise.
Trajectory trackedBy(const TrackerOffset& offset, Nanoseconds knocked = 1'000'000 * second,
                     const TrackerOffset& after = {}) {
    Trajectory trajectory = obedientTrajectory(3 * second, 300 * second, wanders);
    for (StampedPose& pose : trajectory.poses) {
        const TrackerOffset& now = pose.time < knocked ? offset : after;
        pose.pose = pose.pose * Pose{now.ahead, 0, now.rotated};
    }
    return trajectory;
}

const HeldCommandModel obedient;  ///< whose marker is on the axle

TEST(TrackerHistory, IsFoundWhileTheRobotDrives) {
    const TrackerOffset real{-0.04, 0.03};
    const TrackerHistory point(trackedBy(real), obedient);
    EXPECT_TRUE(point.at(3 * second).none()) << "nothing was seen yet";
    EXPECT_FALSE(point.at(4 * second).none());
    for (const Nanoseconds time : {20 * second, 100 * second, 303 * second, 999 * second}) {
        EXPECT_NEAR(point.at(time).offset().ahead, real.ahead, 1e-3);
        EXPECT_NEAR(point.at(time).offset().rotated, real.rotated, 1e-3);
    }
}

TEST(TrackerHistory, FollowsAMarkerThatIsKnocked) {
    const TrackerOffset before{-0.04, 0.03}, after{0.02, -0.4};
    const TrackerHistory point(trackedBy(before, 100 * second, after), obedient);
    EXPECT_NEAR(point.at(99 * second).offset().rotated, before.rotated, 1e-3);
    EXPECT_NEAR(point.at(290 * second).offset().rotated, after.rotated, 0.03)
        << "the heading jumped by 25 deg, which is left out";
}

/// By 40 mrad, in a second or all at once.
TEST(TrackerHistory, CountsWhatWasSeenBeforeForLessWhereTheHeadingTurnsAtOnce) {
    const TrackerOffset before{-0.04, 0.01}, after{-0.04, 0.05};
    const auto turnedWithin = [&](Nanoseconds lasts) {
        Trajectory trajectory = trackedBy(before);
        for (StampedPose& stamped : trajectory.poses)
            stamped.pose.heading += (after.rotated - before.rotated) *
                                    std::clamp(toSeconds(stamped.time - 100 * second) / toSeconds(lasts), 0.0, 1.0);
        return TrackerHistory(trajectory, obedient);
    };
    const TrackerHistory slowly = turnedWithin(second), atOnce = turnedWithin(1);
    const auto share = [&](const TrackerHistory& point, Nanoseconds time) {
        return (after.rotated - point.at(time).offset().rotated) / (after.rotated - before.rotated);
    };
    // Of what is remembered after T s exp(-T/60) is of before; where that counts 0.3, so much of the rest.
    const double old = std::exp(-1), recent = 1 - old;
    EXPECT_NEAR(share(slowly, 160 * second), old, 0.05) << "what is a minute old counts 1/e";
    EXPECT_NEAR(share(atOnce, 160 * second), 0.3 * old / (0.3 * old + recent), 0.05);
    EXPECT_NEAR(share(atOnce, 99 * second), 1, 0.03);
}

/// What is learned of the marker next is believed sooner from the instant on at which the step is known.
TEST(TrackerHistory, KnowsOfAStepOnceItIsSeen) {
    Trajectory trajectory = trackedBy({-0.04, 0.03});
    for (StampedPose& stamped : trajectory.poses)
        if (stamped.time >= 100 * second) stamped.pose.heading += 0.04;
    const TrackerHistory point(trajectory, obedient);
    const TrackerOffset doubted{0, 0.5};
    const double unaware = point.at(100 * second + 99 * ms).offset(doubted).rotated,
                 aware = point.at(100 * second + 100 * ms).offset(doubted).rotated;
    EXPECT_GT(aware, unaware + 1e-4) << "less evidence against what was thought before";
    EXPECT_EQ(point.at(100 * second + 99 * ms).offset().rotated, point.at(100 * second).offset().rotated);
}

/// At instants just before and after those at which a step becomes known, of trackers that are fast and slow.
TEST(TrackerHistory, ReadsNoTruthAfterTheInstant) {
    for (const Nanoseconds between : {20 * ms, 160 * ms}) {
        Trajectory trajectory = trackedBy({-0.04, 0.03});
        std::erase_if(trajectory.poses, [&](const StampedPose& pose) { return pose.time % between != 0; });
        for (Nanoseconds time = 49 * second; time < 50 * second; time += 10 * ms + 3) {
            Trajectory garbled = trajectory, jumping = trajectory, ending = trajectory;
            for (StampedPose& pose : garbled.poses)
                if (pose.time > time) pose.pose = {-pose.pose.y, 1.01 * pose.pose.x, 0.99 * pose.pose.heading};
            for (StampedPose& pose : jumping.poses)
                if (pose.time > time) pose.pose.x += 5;
            std::erase_if(ending.poses,
                          [&](const StampedPose& pose) { return pose.time > time && pose.time < time + 5 * second; });
            const TrackerOffset offset = TrackerHistory(trajectory, obedient).at(time).offset();
            EXPECT_EQ(TrackerHistory(garbled, obedient).at(time).offset(), offset) << time;
            EXPECT_EQ(TrackerHistory(jumping, obedient).at(time).offset(), offset) << time;
            EXPECT_EQ(TrackerHistory(ending, obedient).at(time).offset(), offset) << time;
            EXPECT_NE(TrackerHistory(garbled, obedient).at(time + 2 * second).offset(), offset);
            const TrackerOffset doubted{0, 0.5};  // and so does how much it counts
            EXPECT_EQ(TrackerHistory(garbled, obedient).at(time).offset(doubted),
                      TrackerHistory(trajectory, obedient).at(time).offset(doubted));
        }
    }
}

TEST(TrackerHistory, LeavesOutGapsAndJumps) {
    const TrackerOffset real{-0.04, 0.03};
    Trajectory trajectory = trackedBy(real);
    std::erase_if(trajectory.poses, [](const StampedPose& pose) { return pose.time % (10 * second) < 4 * second; });
    for (StampedPose& pose : trajectory.poses)
        if (pose.time > 155 * second && pose.time < 156 * second) pose.pose.x += 2, pose.pose.y -= 1;
    const TrackerOffset found = TrackerHistory(trajectory, obedient).at(158 * second).offset();
    EXPECT_NEAR(found.ahead, real.ahead, 1e-3);
    EXPECT_NEAR(found.rotated, real.rotated, 1e-3);
}

/// Its tyres scrub in bends, so that it slides outwards.
class SlidingModel final : public HeldCommandModel {
    MotionStep step(const MotionInput& input) const override {
        MotionStep step = HeldCommandModel::step(input);
        step.increment.y -= 0.3 * step.velocity.v * step.velocity.v * step.increment.heading;
        return step;
    }
};

/// Where the robot slides, its marker lies ahead of the axle for all that a model knows which does not slide.
TEST(TrackerHistory, TellsTheMarkerFromWhatTheModelKnows) {
    const SlidingModel sliding;
    const TrackerOffset real{-0.04, 0.03};
    Trajectory trajectory = trackedBy({});
    const RolloutStart start{&trajectory, 3 * second, {}, StampedVelocity{3 * second, {}}, 2990};
    const auto driven = rollOut(sliding, {&start, 1});
    ASSERT_TRUE(driven) << driven.error().message();
    trajectory.poses.clear();
    for (std::size_t k = 0; k < driven->front().size(); ++k)
        trajectory.poses.push_back({start.time + static_cast<Nanoseconds>(k + 1) * 100 * ms,
                                    driven->front()[k] * Pose{real.ahead, 0, real.rotated}});
    const TrackerOffset known = TrackerHistory(trajectory, sliding).at(200 * second).offset(),
                        unknown = TrackerHistory(trajectory, obedient).at(200 * second).offset();
    EXPECT_NEAR(known.ahead, real.ahead, 1e-3);
    EXPECT_NEAR(known.rotated, real.rotated, 1e-3);
    EXPECT_LT(unknown.ahead, real.ahead - 5e-3);
}

TEST(TrackerHistory, SaysNothingWithoutTruthOrCommands) {
    Trajectory trajectory = trackedBy({});
    trajectory.commands.clear();
    EXPECT_TRUE(TrackerHistory(trajectory, obedient).at(100 * second).none());
    EXPECT_TRUE(TrackerHistory(Trajectory{}, obedient).at(0).none());
}

TEST(TrackerHistory, OfManyRobotsIsOfTheModelOfEach) {
    const SlidingModel sliding;
    Log log = logOf({trackedBy({-0.04, 0.03})});
    for (const char* const robot : {"other", "unknown"}) {
        log.robots.push_back(log.robots.front());
        log.robots.back().robot = robot;
    }
    const NamedModel named{"named", [&](const std::string& robot) -> const MotionModel* {
                               return robot == "unknown" ? nullptr : robot == "other" ? &sliding : &obedient;
                           }};
    std::vector<RolloutStart> starts;
    std::vector<std::size_t> robots{2, 1, 0, 1};
    for (const std::size_t robot : robots) starts.push_back({&log.robots[robot].trajectories[0], 50 * second});
    TrackerHistories histories;
    fillTracked(named, log, starts, robots, histories);
    EXPECT_TRUE(starts[0].tracked.none());
    for (std::size_t i = 1; i < robots.size(); ++i)
        EXPECT_EQ(starts[i].tracked.offset(),
                  TrackerHistory(*starts[i].trajectory, *named.forRobot(log.robots[robots[i]].robot))
                      .at(50 * second)
                      .offset());
    EXPECT_NE(starts[1].tracked.offset(), starts[2].tracked.offset());
}

TEST(TrackerHistory, OfManyStartsIsThatOfEach) {
    const Trajectory one = trackedBy({-0.04, 0.03}), other = trackedBy({0.01, -0.02});
    std::vector<RolloutStart> starts;
    for (int i = 0; i < 6; ++i) starts.push_back({i % 2 == 0 ? &one : &other, (20 + 7 * i) * second});
    fillTracked(obedient, starts);
    for (const RolloutStart& start : starts)
        EXPECT_EQ(start.tracked.offset(), TrackerHistory(*start.trajectory, obedient).at(start.time).offset());
}

}  // namespace
}  // namespace mrose
