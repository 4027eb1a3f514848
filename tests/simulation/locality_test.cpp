// Bodies that no chain of touches joins do not change each other's motion by a bit: whatever else is there, near or
// far, and whatever numbers they have.
#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#include <gtest/gtest.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "learning/parallel_for.h"
#include "simulation/small_world.h"
#include "support/contact_measures.h"
#include "support/outlines.h"
#include "support/units.h"
#include "world/noise.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

struct BodyMotion {
    Pose pose;
    Twist velocity;  ///< of robots in their frame
    Point roll;
};
static_assert(sizeof(BodyMotion) == 8 * sizeof(double), "compared byte by byte");

BodyMotion motionNow(const WorldState& state, std::size_t body) {
    const std::size_t robots = state.robots.size();
    if (body < robots) return {state.robots[body].pose, state.robots[body].velocity_B, {}};
    const ObjectState& object = state.objects[body - robots];
    return {object.pose, object.velocity_W, object.roll_W};
}

/// What bodies did in a run, tick by tick, and who touched whom.
struct History {
    std::vector<std::vector<BodyMotion>> ticks;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> touches;  ///< the lower number first; noBody last
    int contacts = 0;

    int touched(std::uint32_t a, std::uint32_t b) const {
        const auto found = touches.find({std::min(a, b), std::max(a, b)});
        return found == touches.end() ? 0 : found->second;
    }
};

History historyOf(const Scenario& scenario, int ticks) {
    History history;
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < ticks; ++k) {
        step(scenario, state, buffers, {}, &trace);
        auto& now = history.ticks.emplace_back();
        for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) now.push_back(motionNow(state, body));
        for (const ContactReport& c : trace.contacts)
            ++history.touches[{std::min(c.bodyA, c.bodyB), std::max(c.bodyA, c.bodyB)}];
        history.contacts += static_cast<int>(trace.contacts.size());
    }
    return history;
}

/// The first tick at which a body's motion differs by a bit from another one's in another run; -1: none.
int firstTickApart(const History& a, std::size_t bodyA, const History& b, std::size_t bodyB) {
    for (std::size_t k = 0; k < a.ticks.size(); ++k)
        if (std::memcmp(&a.ticks[k][bodyA], &b.ticks[k][bodyB], sizeof(BodyMotion)) != 0) return static_cast<int>(k);
    return -1;
}

/// A body at its start, told a speed if it is a robot and thrown otherwise.
struct Placed {
    std::shared_ptr<const Shape> shape;
    double mass = 1;
    Surface surface;
    Pose start;
    Twist velocity_W;
    Command command;
};

void addRobot(SmallWorld& world, const Placed& p) {
    world.robot(robotOf(p.shape, p.mass, p.surface), p.start, std::make_shared<const Told>(p.command), ideal());
}

void addObject(SmallWorld& world, const Placed& p) {
    world.object(slidingBody(p.shape, p.mass, p.surface), p.start, p.velocity_W);
}

Scenario worldOf(const std::vector<Placed>& bodies, bool robots, const Environment& environment = onIce()) {
    SmallWorld world(environment);
    for (const Placed& p : bodies) robots ? addRobot(world, p) : addObject(world, p);
    return world.scenario();
}

/// Two bodies of tricky outlines that run into each other about the origin.
std::vector<Placed> collidingPair(std::int64_t number) {
    const auto draw = [&](std::uint32_t c) { return uniformNoise({21, number, 0, c}); };
    const auto evenly = [&](std::uint32_t c) { return 2 * draw(c) - 1; };
    std::vector<Placed> pair;
    for (std::uint32_t i = 0; i < 2; ++i) {
        const auto& outlines = trickyOutlines();
        const std::uint32_t c = 20 * i;
        const double sense = i == 0 ? 1 : -1;
        Placed p;
        p.shape = outlines[static_cast<std::size_t>(draw(c) * static_cast<double>(outlines.size()))];
        p.mass = 1 + 9 * draw(c + 1);
        p.surface = {draw(c + 2), draw(c + 3)};
        p.start = {-0.5 * sense, 0.1 * evenly(c + 4), (i == 0 ? 0 : pi) + 0.3 * evenly(c + 5)};
        p.velocity_W = {0.4 * sense, 0.02 * evenly(c + 6), evenly(c + 7)};
        p.command = {0.25, 0.1 * evenly(c + 8)};
        pair.push_back(std::move(p));
    }
    return pair;
}

TEST(Locality, ABallFarAwayDoesNotMatterToRobotsThatCollide) {
    Environment place = onIce();
    for (const double x : {50.0, 52.0})
        addObstacle(place, "wall", {{x, -2}, {x + 0.1, -2}, {x + 0.1, 2}, {x, 2}}, {0, 1});
    int compared = 0;
    for (std::int64_t number = 0; number < 16; ++number) {
        const std::vector<Placed> pair = collidingPair(number);
        const auto scenario = [&](bool withBall) {
            SmallWorld world(place);
            world.parts().scene.randomFactor = 0.3;  // their numbers are the same in both
            for (const Placed& p : pair) addRobot(world, p);
            if (withBall) world.object(rollingBody(0.11, 0.43, {0.2, 1}), {51, 0.1, 0}, {9, 0.02, 3});
            return world.scenario();
        };
        const History alone = historyOf(scenario(false), 300), with = historyOf(scenario(true), 300);
        if (alone.touched(0, 1) == 0) continue;
        ++compared;
        EXPECT_GT(with.touched(2, noBody), 15) << number;
        for (std::size_t body : {0, 1}) EXPECT_EQ(firstTickApart(alone, body, with, body), -1) << number;
    }
    EXPECT_GE(compared, 12);
}

/// The least gap between the pairs of two runs in one tick, the second moved by `up` in y.
double nearestTo(const Scenario& one, const History& first, const Scenario& other, const History& second, double up) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < first.ticks.size(); ++k)
        for (std::size_t a = 0; a < 2; ++a)
            for (std::size_t b = 0; b < 2; ++b) {
                Pose there = second.ticks[k][b].pose;
                there.y += up;
                for (const ConvexPiece& x : one.scene().shapeOf(a).pieces)
                    for (const ConvexPiece& y : other.scene().shapeOf(b).pieces)
                        least = std::min(
                            least, distance(placed(x, Placement(first.ticks[k][a].pose)), placed(y, Placement(there))));
            }
    return least;
}

/// How far up the second pair must be for the pairs to come just so near to each other.
double offsetForGap(const std::vector<Placed>& lower, const std::vector<Placed>& upper, bool robots, double gap) {
    const Scenario one = worldOf(lower, robots), other = worldOf(upper, robots);
    const History first = historyOf(one, 120), second = historyOf(other, 120);
    double up = 2;
    for (int i = 0; i < 20; ++i) up -= nearestTo(one, first, other, second, up) - gap;  // never nearer than that
    return up;
}

/// Near, but never in touch: a pair that collides beside another one does as if it were alone.
void expectPairsApart(bool robots) {
    int compared = 0;
    for (std::int64_t number = 0; number < 20; ++number) {
        const std::vector<Placed> lower = collidingPair(2 * number);
        std::vector<Placed> upper = collidingPair(2 * number + 1);
        const double up = offsetForGap(lower, upper, robots, 0.0125);
        for (Placed& p : upper) p.start.y += up;
        const Scenario one = worldOf(lower, robots), other = worldOf(upper, robots);
        const History first = historyOf(one, 120), second = historyOf(other, 120);
        const double gap = nearestTo(one, first, other, second, 0);
        if (gap < 0.01 || gap > 0.03 || first.contacts == 0 || second.contacts == 0) continue;
        ++compared;
        SCOPED_TRACE(number);
        for (const auto& order : {std::array{0U, 1U, 2U, 3U}, {2U, 0U, 3U, 1U}}) {
            std::vector<Placed> both(4);
            for (std::size_t i = 0; i < 4; ++i) both[order[i]] = i < 2 ? lower[i] : upper[i - 2];
            const History together = historyOf(worldOf(both, robots), 120);
            const auto [a, b, c, d] = order;
            EXPECT_GT(together.touched(a, b), 0);
            EXPECT_GT(together.touched(c, d), 0);
            EXPECT_EQ(together.touched(a, b) + together.touched(c, d), together.contacts)
                << "the pairs touch each other";
            for (std::size_t i : {0, 1}) {
                EXPECT_EQ(firstTickApart(together, order[i], first, i), -1) << "lower " << i;
                EXPECT_EQ(firstTickApart(together, order[i + 2], second, i), -1) << "upper " << i;
            }
        }
    }
    EXPECT_GE(compared, 14);
}

TEST(Locality, RobotsThatCollideBesideOthersDoAsIfAlone) { expectPairsApart(true); }
TEST(Locality, ObjectsThatCollideBesideOthersDoAsIfAlone) { expectPairsApart(false); }

/// Four bodies thrown together in a corner of the walled field.
std::vector<Placed> corneredFour(std::int64_t number) {
    std::vector<Placed> four = collidingPair(3 * number);
    for (const Placed& p : collidingPair(3 * number + 1)) four.push_back(p);
    for (std::size_t i = 0; i < four.size(); ++i) {
        Placed& p = four[i];
        p.start.x = 0.5 + 0.8 * static_cast<double>(i % 2);
        p.start.y = 0.5 + 0.8 * static_cast<double>(i / 2);
        p.start.heading = -0.75 * pi + 0.2 * static_cast<double>(i);
        p.velocity_W = {-1.5, -1.2, 1};
        p.command = {0.5, 0.05};
    }
    return four;
}

/// Others elsewhere in that field: two that collide again and again between the walls of a far corner.
std::vector<Placed> others(std::size_t count) {
    std::vector<Placed> list;
    for (std::size_t i = 0; i < count; ++i) {
        const double along = 0.8 * static_cast<double>(i);
        list.push_back(
            {trickyOutlines()[5 + i % 2], 2, {0.3, 0.8}, {17 + along, 18, 0.3}, {1 - along, 1, 2}, {0.4, 0.6}});
    }
    return list;
}

/// With `inserted[i]` others before the i-th of the four, and the rest after them; where the four are then.
std::vector<Placed> withOthers(const std::vector<Placed>& four, const std::vector<std::size_t>& inserted,
                               std::vector<std::size_t>& places) {
    std::vector<Placed> all, rest = others(4);
    places.clear();
    const auto take = [&](std::size_t count) {
        for (; count > 0; --count) {
            all.push_back(rest.front());
            rest.erase(rest.begin());
        }
    };
    for (std::size_t i = 0; i < four.size(); ++i) {
        take(inserted[i]);
        places.push_back(all.size());
        all.push_back(four[i]);
    }
    take(rest.size());
    return all;
}

void expectAnyNumbers(bool robots) {
    const Environment field = onIce(walledField(20, 20, {0.3, 0.5}));
    const std::vector<std::vector<std::size_t>> orders{
        {0, 0, 0, 0}, {4, 0, 0, 0}, {0, 2, 0, 2}, {1, 1, 1, 1}, {0, 0, 4, 0}};
    for (std::int64_t number = 0; number < 6; ++number) {
        const std::vector<Placed> four = corneredFour(number);
        const History alone = historyOf(worldOf(four, robots, field), 150);
        EXPECT_GE(alone.touches.size(), 4u);
        EXPECT_GT(alone.contacts, robots ? 100 : 10);
        for (const auto& inserted : orders) {
            std::vector<std::size_t> places;
            const std::vector<Placed> all = withOthers(four, inserted, places);
            const History listed = historyOf(worldOf(all, robots, field), 150);
            EXPECT_GT(listed.contacts, alone.contacts) << "the others touch, too";
            for (std::size_t i = 0; i < four.size(); ++i)
                EXPECT_EQ(firstTickApart(alone, i, listed, places[i]), -1)
                    << number << ": body " << i << " as number " << places[i];
        }
    }
}

TEST(Locality, NumbersOfObjectsDoNotMatter) { expectAnyNumbers(false); }
TEST(Locality, NumbersOfRobotsDoNotMatter) { expectAnyNumbers(true); }

/// Robots are numbered before objects: more of them shift the objects' numbers.
TEST(Locality, RobotsElsewhereDoNotMatterToObjectsThatCollide) {
    const Environment field = onIce(walledField(20, 20, {0.3, 0.5}));
    for (std::int64_t number = 0; number < 6; ++number) {
        const std::vector<Placed> four = corneredFour(number);
        SmallWorld world(field);
        for (const Placed& p : others(3)) addRobot(world, p);
        for (const Placed& p : four) addObject(world, p);
        const History alone = historyOf(worldOf(four, false, field), 150), listed = historyOf(world.scenario(), 150);
        for (std::size_t i = 0; i < four.size(); ++i)
            EXPECT_EQ(firstTickApart(alone, i, listed, i + 3), -1) << number << ": body " << i;
    }
}

/// Trials share the threads' buffers, in whatever order they come.
TEST(Locality, TrialsEndInTheSameStatesOnOneThreadAndOnEight) {
    SmallWorld world(walledField(2.6, 2.6));
    world.parts().scene.randomFactor = 0.4;
    const auto wild = std::make_shared<const RandomCommands>(0, 1.5, 4);
    for (int i = 0; i < 9; ++i) {
        const Pose start{0.45 + 0.85 * (i % 3), 0.45 + 0.85 * (i / 3), 1.0 * i};
        const auto& outline = trickyOutlines()[static_cast<std::size_t>(i) % trickyOutlines().size()];
        if (i < 5)
            world.robot(robotOf(outline), start, wild, ideal(), i % 5);
        else
            world.object(slidingBody(outline, 2, {0.3, 0.5}), start, {2, 1, 0.5});
    }
    const Scenario scenario = world.scenario();
    const auto finals = [&](int threads) {
        std::vector<StateHash> hashes(24);
        tbb::enumerable_thread_specific<StepBuffers> buffers;
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        tbb::task_arena(threads).execute([&] {
            parallelFor(hashes.size(), [&](std::size_t trial) {
                WorldState state = scenario.initialState(trial + 1);
                for (int k = 0; k < 200; ++k) step(scenario, state, buffers.local());
                hashes[trial] = hashOf(state);
            });
        });
        return hashes;
    };
    const std::vector<StateHash> one = finals(1);
    EXPECT_NE(one[0], one[1]);
    EXPECT_EQ(one, finals(8));
    EXPECT_GT(historyOf(scenario, 200).contacts, 200);
}

}  // namespace
}  // namespace mrose
