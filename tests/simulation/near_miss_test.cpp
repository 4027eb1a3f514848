// Who touches and who does not, to the millimetre: sharp corners that pass each other are not deflected by a bit, and
// corners that meet are noticed.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/contact_measures.h"
#include "support/outlines.h"
#include "support/units.h"

namespace mrose {
namespace {

/// A square that stands on its corner, a pointed dart, a needle: their points are `tip` from the reference point, up
/// (+y) and down (-y).
struct Pointed {
    std::shared_ptr<const Shape> shape;
    double tip = 0;
};

std::vector<Pointed> pointedOutlines() {
    const double d = 0.2;
    return {
        {outlineOf("diamond", {{{d, 0}, {0, d}, {-d, 0}, {0, -d}}}), d},
        {outlineOf("splinters", {{{0, 0.3}, {-0.02, 0}, {0.02, 0}}, {{0, -0.3}, {0.02, 0}, {-0.02, 0}}}), 0.3},
        {outlineOf(
             "star",
             {{{0.3, 0}, {0.05, 0.05}, {0, 0.3}, {-0.05, 0.05}, {-0.3, 0}, {-0.05, -0.05}, {0, -0.3}, {0.05, -0.05}}}),
         0.3}};
}

bool sameMotion(const ObjectState& a, const ObjectState& b) {
    return std::memcmp(&a.pose, &b.pose, sizeof a.pose) == 0 &&
           std::memcmp(&a.velocity_W, &b.velocity_W, sizeof a.velocity_W) == 0;
}

/// What became of two bodies that came past each other.
struct Passing {
    bool touched = false, deflected = false;
    double deepest = 0;  ///< m
};

/// The same scene with both and with each alone.
Passing passing(const ObjectType& one, const Pose& start, const Twist& velocity, const ObjectType& other,
                const Pose& otherStart, const Twist& otherVelocity, int ticks) {
    const Scenario both =
        SmallWorld(onIce()).object(one, start, velocity).object(other, otherStart, otherVelocity).scenario();
    const Scenario first = SmallWorld(onIce()).object(one, start, velocity).scenario();
    const Scenario second = SmallWorld(onIce()).object(other, otherStart, otherVelocity).scenario();
    WorldState state = both.initialState(), alone = first.initialState(), otherAlone = second.initialState();
    StepBuffers buffers;
    StepTrace trace;
    Passing result;
    for (int k = 0; k < ticks; ++k) {
        step(both, state, buffers, {}, &trace);
        step(first, alone, buffers);
        step(second, otherAlone, buffers);
        result.touched = result.touched || !trace.contacts.empty();
        result.deepest = std::max(result.deepest, -gapBetween(both, state, 0, 1));
        result.deflected = result.deflected || !sameMotion(state.objects[0], alone.objects[0]) ||
                           !sameMotion(state.objects[1], otherAlone.objects[0]);
    }
    return result;
}

/// Point to point: the upper one comes along +x with its lower point, the lower one stands or comes the other way.
Passing pointsPassing(const Pointed& upper, const Pointed& lower, double gap, double speed, double against) {
    const double above = upper.tip + lower.tip + gap, from = 0.35 * (1 + against / speed) + 0.0037 * speed;
    const ObjectType one = slidingBody(upper.shape, 2, {0.3, 0.5}), other = slidingBody(lower.shape, 5, {0.3, 0.5});
    const int ticks = static_cast<int>(std::ceil(2 * from / (speed + against) / 0.02)) + 2;
    return passing(one, {-from, above, 0}, {speed, 0, 0}, other, {0, 0, 0}, {-against, 0, 0}, ticks);
}

TEST(NearMiss, CornersThatPassEachOtherAreNotDeflected) {
    for (const Pointed& upper : pointedOutlines())
        for (const Pointed& lower : pointedOutlines())
            for (const double gap : {0.0003, 0.0007, 0.001, 0.002, 0.004})
                for (const double speed : {0.1, 0.7, 3.0, 6.0})
                    for (const double against : {0.0, 1.5}) {
                        const Passing seen = pointsPassing(upper, lower, gap, speed, against);
                        EXPECT_FALSE(seen.touched || seen.deflected)
                            << upper.shape->name << " past " << lower.shape->name << ", gap " << gap << ", at " << speed
                            << " and " << against << " m/s";
                    }
}

TEST(NearMiss, CornersThatMeetAreNoticed) {
    for (const Pointed& upper : pointedOutlines())
        for (const Pointed& lower : pointedOutlines())
            for (const double overlap : {0.001, 0.002, 0.005, 0.02})
                for (const double speed : {0.1, 0.7, 3.0, 6.0})
                    for (const double against : {0.0, 1.5}) {
                        const Passing seen = pointsPassing(upper, lower, -overlap, speed, against);
                        EXPECT_TRUE(seen.touched && seen.deflected)
                            << upper.shape->name << " against " << lower.shape->name << ", by " << overlap << ", at "
                            << speed << " and " << against << " m/s";
                        EXPECT_LE(seen.deepest, 0.001) << upper.shape->name << " in " << lower.shape->name;
                    }
}

/// Straight at each other, point before point.
TEST(NearMiss, PointsThatMeetHeadOnAreNoticed) {
    for (const Pointed& left : pointedOutlines())
        for (const Pointed& right : pointedOutlines())
            for (const double aside : {0.0, 0.0005, -0.003})
                for (const double speed : {0.5, 3.0, 6.0}) {
                    const double from = (left.tip + right.tip) / 2 + 0.1 + 0.0037 * speed;
                    const Passing seen =
                        passing(slidingBody(left.shape, 2, {0.3, 0.5}), {-from, aside, -pi / 2}, {speed, 0, 0},
                                slidingBody(right.shape, 5, {0.3, 0.5}), {from, 0, pi / 2}, {-0.5 * speed, 0, 0}, 30);
                    EXPECT_TRUE(seen.touched && seen.deflected)
                        << left.shape->name << " against " << right.shape->name << ' ' << aside << ' ' << speed;
                    EXPECT_LE(seen.deepest, 0.001) << left.shape->name << " in " << right.shape->name;
                }
}

/// Along the side of a box and past its corners, and diagonally past one corner.
TEST(NearMiss, BallPastTheEndOfAnEdgeIsNotTouched) {
    const ObjectType box = boxType(0.4, 5), ball = ballType();
    for (const double gap : {0.0003, 0.001, 0.003})
        for (const double speed : {0.1, 1.0, 6.0, 12.0}) {
            const double beside = 0.2 + 0.11 + gap;
            const int ticks = static_cast<int>(std::ceil(1.2 / speed / 0.02)) + 1;
            const Passing along = passing(ball, {-0.6, beside, 0}, {speed, 0, 0}, box, {0, 0, 0}, {}, ticks);
            EXPECT_FALSE(along.touched || along.deflected) << gap << ' ' << speed;
            // Its way is at right angles to the corner's diagonal, so that the edges' lines are crossed.
            const double s = std::sqrt(0.5), corner = 0.2 + (0.11 + gap) * s;
            const Pose start{corner - 0.6 * s, corner + 0.6 * s, 0};
            const Passing round = passing(ball, start, {s * speed, -s * speed, 0}, box, {0, 0, 0}, {}, ticks);
            EXPECT_FALSE(round.touched || round.deflected) << gap << ' ' << speed;
            // And a little nearer it is.
            const double inside = 0.2 + (0.11 - 0.002) * s;
            const Pose nearer{inside - 0.6 * s, inside + 0.6 * s, 0};
            const Passing hit = passing(ball, nearer, {s * speed, -s * speed, 0}, box, {0, 0, 0}, {}, ticks);
            EXPECT_TRUE(hit.touched && hit.deflected) << speed;
            EXPECT_LE(hit.deepest, 0.001) << speed;
        }
}

/// Walls' corners are passed as near.
TEST(NearMiss, CornerPastACornerOfAWallIsNotDeflected) {
    for (const Pointed& thrown : pointedOutlines())
        for (const double gap : {0.0003, 0.001, 0.003})
            for (const double speed : {0.1, 1.0, 6.0}) {
                Environment place = onIce();
                addObstacle(place, "post", {{0, 0}, {-0.1, -0.3}, {0.1, -0.3}}, {0.3, 0.5});
                const ObjectType type = slidingBody(thrown.shape, 2, {0.3, 0.5});
                const Pose start{-0.5, thrown.tip + gap, 0};
                const Scenario with = SmallWorld(place).object(type, start, {speed, 0, 0}).scenario();
                const Scenario without = SmallWorld(onIce()).object(type, start, {speed, 0, 0}).scenario();
                WorldState state = with.initialState(), alone = without.initialState();
                for (int k = 0; k < 1 / speed / 0.02; ++k) {
                    run(with, state, 1);
                    run(without, alone, 1);
                    ASSERT_TRUE(sameMotion(state.objects[0], alone.objects[0])) << gap << ' ' << speed << ' ' << k;
                }
            }
}

/// Robots that drive past each other, corner by corner, at their models' speeds.
TEST(NearMiss, RobotsThatPassEachOtherDoAsIfAlone) {
    const Pointed diamond = pointedOutlines()[0];
    for (const double gap : {0.0005, 0.001, 0.003})
        for (const double speed : {0.2, 1.0, 3.0}) {
            const auto scenario = [&](bool first, bool second) {
                SmallWorld world;
                const auto ahead = std::make_shared<const Told>(Command{speed, 0});
                if (first) world.robot(robotOf(diamond.shape), {-1, 2 * diamond.tip + gap, 0}, ahead, ideal());
                if (second) world.robot(robotOf(diamond.shape), {1, 0, pi}, ahead, ideal());
                return world.scenario();
            };
            const Scenario both = scenario(true, true), one = scenario(true, false), other = scenario(false, true);
            WorldState state = both.initialState(), alone = one.initialState(), otherAlone = other.initialState();
            double nearest = 1;
            for (int k = 0; k < 2 / speed / 0.02; ++k) {
                run(both, state, 1);
                run(one, alone, 1);
                run(other, otherAlone, 1);
                nearest = std::min(nearest, gapBetween(both, state, 0, 1));
                ASSERT_EQ(state.robots[0].pose, alone.robots[0].pose) << gap << ' ' << speed << ", tick " << k;
                ASSERT_EQ(state.robots[1].pose, otherAlone.robots[0].pose) << gap << ' ' << speed << ", tick " << k;
            }
            EXPECT_LT(nearest, 0.03 * speed + gap);
        }
}

}  // namespace
}  // namespace mrose
