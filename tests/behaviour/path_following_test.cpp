#include "behaviour/path_following.h"

#include <gtest/gtest.h>

#include "behaviour/coming_path.h"
#include "motion/kinematic.h"

namespace mrose {
namespace {

const std::vector<Point> corner{{0, 0}, {2, 0}, {2, 1}};

TEST(PathFollowing, ProgressIsTheNearestPointOfTheWayAhead) {
    EXPECT_DOUBLE_EQ(progressAlong(corner, {0.7, 0.2}, 0), 0.7);
    EXPECT_DOUBLE_EQ(progressAlong(corner, {0.7, 0.2}, 0.9), 0.9);
    EXPECT_DOUBLE_EQ(progressAlong(corner, {2.3, 0.5}, 1.8), 2.5);
    EXPECT_DOUBLE_EQ(progressAlong(corner, {1.9, 5}, 1.8, 0.5), 2.3);
    EXPECT_DOUBLE_EQ(lengthOf(corner), 3);
    EXPECT_EQ(pointAt(corner, 2.25), (Point{2, 0.25}));
    EXPECT_EQ(pointAt(corner, 9), (Point{2, 1}));
    EXPECT_EQ(pointsAfter(corner, 1.5), (std::vector<Point>{{2, 0}, {2, 1}}));
    EXPECT_EQ(pointsAfter(corner, 3), (std::vector<Point>{{2, 1}}));
}

TEST(PathFollowing, ADriveThatAnswersAtOnceStaysNearTheWayAndEndsAtItsEnd) {
    Pose pose{0, 0.1, 1.5};
    double progress = 0, off = 0;
    for (int i = 0; i < 400; ++i) {
        progress = progressAlong(corner, position(pose), progress);
        const Command command = followPath(corner, pose, progress, 3, {0.4, 1});
        EXPECT_LE(std::abs(command.v), 0.4);
        pose = pose * exp({0.05 * command.v, 0, 0.05 * command.w});
        off = std::max(off, distance(position(pose), pointAt(corner, progress)));
    }
    EXPECT_LT(off, 0.2);
    EXPECT_LT(distance(position(pose), {2, 1}), 0.03);
}

TEST(PathFollowing, ItStopsWhereItIsToWait) {
    Pose pose{0, 0, 0};
    double progress = 0;
    for (int i = 0; i < 400; ++i) {
        progress = progressAlong(corner, position(pose), progress);
        const Command command = followPath(corner, pose, progress, 1.2, {0.4, 1});
        pose = pose * exp({0.05 * command.v, 0, 0.05 * command.w});
    }
    EXPECT_NEAR(pose.x, 1.2, 0.03);
    EXPECT_NEAR(pose.y, 0, 0.03);
}

TEST(ComingPath, ComesOutOfItsMessageAsItWentIn) {
    ComingPath path{};
    path.x = 1;
    path.heading = 0.5F;
    path.speed = 0.4F;
    path.holdAt = 0.5F;
    path.holdFor = 2;
    path.count = 2;
    path.points[0] = {2, 0};
    path.points[1] = {2, 1};
    const RadioMessage sent = RadioMessage::of(path, ComingPath::kind);
    ReceivedMessage message{.kind = sent.kind, .size = sent.size, .bytes = sent.bytes};
    const auto got = comingPath(message);
    ASSERT_TRUE(got);
    EXPECT_EQ(std::memcmp(&*got, &path, sizeof path), 0);
    // It turns back by half a radian, drives a metre, stands for two seconds, and is as old as its message.
    const TimedPath timed = got->timed(-1, 1);
    EXPECT_NEAR(timed.at(-1).x, 1, 1e-6);
    EXPECT_NEAR(timed.at(-0.5 + 1.25).x, 1.5, 1e-6);
    EXPECT_NEAR(timed.at(-0.5 + 3.2).x, 1.5, 1e-6);
    EXPECT_NEAR(timed.at(-0.5 + 4.5).x, 2, 1e-6);
    message.kind = 7;
    EXPECT_FALSE(comingPath(message));
    message.kind = ComingPath::kind;
    message.size = 64;
    EXPECT_FALSE(comingPath(message));
}

}  // namespace
}  // namespace mrose
