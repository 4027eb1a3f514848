// Where a body may be put, against closed forms.
#include "debug/placement.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debug/debugger.h"
#include "support/scenes.h"

namespace mrose {
namespace {

using testing::HasSubstr;

class PlacementTest : public testing::Test {
protected:
    PlacementTest() {
        ScenarioParts parts = fieldScenario({.robots = 3}).parts();
        for (Obstacle& obstacle : parts.scene.environment.obstacles) obstacle.wall = true;
        auto scenario = std::make_shared<const Scenario>(std::move(parts));
        frame.state = scenario->initialState(7);
        frame.scenario = std::move(scenario);
    }
    /// Beside a robot, in the direction of its x axis.
    Pose beside(std::size_t robot, double metres) const {
        Pose pose = frame.poseOf(robot);
        pose.x += metres;
        return pose;
    }
    FieldFrame frame;
};

TEST_F(PlacementTest, SaysWhatIsInTheWay) {
    EXPECT_EQ(hindranceAt(frame, 0, frame.poseOf(0)), "");
    EXPECT_EQ(hindranceAt(frame, 0, frame.poseOf(1)), "on " + frame.nameOf(1));
    EXPECT_EQ(hindranceAt(frame, 0, {100, 100, 0}), "outside the field");
}

TEST_F(PlacementTest, FreePlaceIsTheNearestOne) {
    const Pose there = beside(1, 0.05);
    const auto place = freePlaceNear(frame, 0, there);
    ASSERT_TRUE(place);
    EXPECT_EQ(hindranceAt(frame, 0, *place), "");
    const double aside = distance(position(*place), position(there));
    EXPECT_GT(aside, 0.01);
    // No place that is nearer by more than a ring is free.
    for (double radius = 0; radius < aside - 0.025; radius += 0.01)
        for (int i = 0; i < 360; ++i) {
            const double angle = i * std::acos(-1) / 180;
            const Pose nearer{there.x + radius * std::cos(angle), there.y + radius * std::sin(angle), there.heading};
            EXPECT_NE(hindranceAt(frame, 0, nearer), "") << radius << ' ' << i;
        }
    EXPECT_FALSE(freePlaceNear(frame, 0, {100, 100, 0}));
}

TEST_F(PlacementTest, BodiesArePutBesideWhatIsInTheWayWithWords) {
    const auto free = putBody(frame, 0, beside(0, 0.01));
    ASSERT_TRUE(free);
    EXPECT_EQ(free->note, "");
    const auto aside = putBody(frame, 0, frame.poseOf(1));
    ASSERT_TRUE(aside);
    EXPECT_THAT(aside->note, HasSubstr("it would have stood on " + frame.nameOf(1)));
    WorldState state = frame.state;
    aside->change(*frame.scenario, state);
    frame.state = state;
    EXPECT_EQ(hindranceAt(frame, 0, frame.poseOf(0)), "");
    const auto none = putBody(frame, 0, {100, 100, 0});
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message(), HasSubstr("stays where it was: there it would stand outside the field"));
}

}  // namespace
}  // namespace mrose
