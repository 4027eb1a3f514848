#include "behaviour/steering.h"

#include <numbers>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"
#include "support/observation_parts.h"

namespace mrose {
namespace {

constexpr DriveLimits limits{0.4, 1};

struct Drive {
    Pose end;
    double way = 0, time = 0;
    bool inLimits = true;
};

/// Follows the law to within a centimetre as an ideal vehicle.
Drive driveFrom(Pose pose, const Pose& goal, bool backwards) {
    Drive drive;
    constexpr double dt = 0.02;
    for (; drive.time < 60 && distance(position(pose), position(goal)) > 0.01; drive.time += dt) {
        const Command command = driveToPose(pose, goal, limits, backwards);
        drive.inLimits = drive.inLimits && std::abs(command.v) <= 0.4 && std::abs(command.w) <= 1 &&
                         (backwards ? command.v <= 0 : command.v >= 0);
        pose = pose * exp({dt * command.v, 0, dt * command.w});
        drive.way += dt * std::abs(command.v);
    }
    drive.end = pose;
    return drive;
}

TEST(Steering, LeadsToThePoseFromEverywhere) {
    for (std::int64_t i = 0; i < 300; ++i) {
        const Pose from = somewhere(61, i, 9, 7), goal = somewhere(62, i, 9, 7);
        const double straight = distance(position(from), position(goal));
        // Where it has room to turn first, the heading's error shrinks as the distance does.
        const double turned = straight > 1.5 ? 0.1 : std::numbers::pi;
        for (const bool backwards : {false, true}) {
            const Drive drive = driveFrom(from, goal, backwards);
            EXPECT_LT(drive.time, 60) << i;
            EXPECT_TRUE(drive.inLimits) << i;
            EXPECT_NEAR(wrapAngle(drive.end.heading - goal.heading), 0, turned) << i;
            EXPECT_LT(drive.way, 1.5 * straight + 1) << i;
        }
    }
}

TEST(Steering, MirroredProblemsHaveMirroredCommands) {
    const Command left = driveToPose({0, 0, 0.3}, {2, 0.7, 1.2}, limits, false);
    const Command right = driveToPose({0, 0, -0.3}, {2, -0.7, -1.2}, limits, false);
    EXPECT_NEAR(left.v, right.v, 1e-15);
    EXPECT_NEAR(left.w, -right.w, 1e-15);
    const Command back = driveToPose({0, 0, 0.3}, {-2, -0.7, 0.9}, limits, true);
    EXPECT_LT(back.v, 0);
}

TEST(Steering, TowardsAPointTurnsOnTheSpotWhereItLiesAside) {
    const Command ahead = driveTowards({2, 0}, limits);
    EXPECT_NEAR(ahead.v, limits.speed, 1e-15);
    EXPECT_NEAR(ahead.w, 0, 1e-15);
    EXPECT_EQ(driveTowards({-1, 0.5}, limits), (Command{0, limits.rotation}));
    EXPECT_EQ(driveTowards({-1, -0.5}, limits), (Command{0, -limits.rotation}));
    const Command aside = driveTowards({1, 0.2}, limits);
    EXPECT_GT(aside.v, 0.5 * limits.speed);
    EXPECT_GT(aside.w, 0);
}

SeenBody bodyAt(double x, double y) { return {0, {x, y}, 0}; }

TEST(Steering, GivesWayToTheNearestBodyAhead) {
    const MotionMemory still{};
    EXPECT_EQ(evade(std::vector<SeenBody>{bodyAt(-0.5, 0), bodyAt(0.6, 0.8), bodyAt(1.8, 0)}, still, 0.3).turn, 0);
    EXPECT_LT(evade(std::vector<SeenBody>{bodyAt(0.9, 0.2), bodyAt(1.2, -0.2)}, still, 0.3).turn, 0);
    EXPECT_GT(evade(std::vector<SeenBody>{bodyAt(1.2, 0.2), bodyAt(0.9, -0.2)}, still, 0.3).turn, 0);
    EXPECT_LT(evade(std::vector<SeenBody>{bodyAt(0.9, 0)}, still, 0.3).turn, 0);
    EXPECT_LT(evade(std::vector<SeenBody>{bodyAt(0.6, 0)}, still, 0.3).share, 0.5);
}

TEST(Steering, TurnsAsFarAsItTakesToPass) {
    for (const double y : {-0.5, -0.3, 0.0, 0.4}) {
        const Point body{1.1, y};
        const double turn = evade(std::vector<SeenBody>{bodyAt(body.x, body.y)}, MotionMemory{}, 0).turn;
        const Point after = Placement({0, 0, turn}).rotateBack(body);
        EXPECT_NEAR(std::abs(after.y), 0.65, 1e-12);
        EXPECT_GT(after.x, 0);
    }
}

TEST(Steering, TurnsFartherIfItIntendsTo) {
    const Evasion evasion = evade(std::vector<SeenBody>{bodyAt(1.1, 0.3)}, MotionMemory{}, 0);
    ASSERT_LT(evasion.turn, 0);
    const DriveLimits quick{0.4, 10};
    EXPECT_EQ(evading({0.4, -5}, evasion, quick).w, -5);
    const Command turned = evading({0.4, 5}, evasion, quick);
    EXPECT_LT(turned.w, 0);
    EXPECT_LE(turned.v, 0.4);
    EXPECT_EQ(evading({-0.4, 5}, evasion, quick), (Command{-0.4, 5}));
    EXPECT_EQ(evading({0.4, 5}, {}, quick), (Command{0.4, 5}));
}

/// A body that was seen 0.2 s ago is nearer by the way since, and by the way until the command takes effect.
TEST(Steering, TakesItsOwnMotionSinceTheSightingIntoAccount) {
    MotionMemory motion{};
    for (int i = 0; i < 4; ++i) {
        ObservationParts observation;
        observation.time = i * 100'000'000LL;
        observation.velocity = {0.5, 0};
        motion.observe(observation);
        motion.issue({0.5, 0});
    }
    const SeenBody seen{0, {1.4, 0.1}, 100'000'000};
    EXPECT_NEAR(evade(std::vector<SeenBody>{seen}, motion, 0.3).turn,
                evade(std::vector<SeenBody>{bodyAt(1.4 - 0.5 * (0.2 + 0.3), 0.1)}, MotionMemory{}, 0).turn, 1e-12);
}

TEST(Steering, ClearHeadingIsTheNearestFreeOneOnTheRightFirst) {
    const double step = std::numbers::pi / 12;
    // Free but for the headings within `half` of `middle`.
    const auto blocked = [](double middle, double half) {
        return [=](double heading) { return std::abs(heading - middle) <= half ? 0.2 : 1.0; };
    };
    EXPECT_EQ(clearHeading(0.4, 1, blocked(2, 0.1)), 0.4);
    EXPECT_NEAR(clearHeading(0, 1, blocked(0, 1.5 * step)), -2 * step, 1e-12);
    EXPECT_NEAR(clearHeading(0, 1, blocked(-step, 1.5 * step)), step, 1e-12) << "nearer on the left";
    // Nothing is free: where the way is longest.
    EXPECT_NEAR(clearHeading(0, 1, [&](double heading) { return 0.5 - std::abs(heading - 3 * step) / 10; }), 3 * step,
                1e-12);
}

}  // namespace
}  // namespace mrose
