#include "sensing/line_of_sight.h"

#include <numbers>
#include <set>

#include "sensing/perceiving.h"

namespace mrose {
namespace {

double draw(std::int64_t which, std::uint32_t part, double least, double most) {
    return least + (most - least) * uniformNoise({31, which, part, 0});
}

ShapePart part(Polygon polygon) {
    ShapePart result;
    result.polygon = std::move(polygon);
    return result;
}

bool holds(const ConvexPiece& piece, const Point& point) {
    return piece.isCircle() ? distance(piece.corners[0], point) < piece.radius
                            : contains(std::span(piece.corners).first(piece.count), point);
}

/// Point by point along the line.
bool crossesBySamples(const ConvexPiece& piece, const Point& from, const Point& to) {
    constexpr int samples = 4000;
    for (int i = 0; i <= samples; ++i)
        if (holds(piece, from + (static_cast<double>(i) / samples) * (to - from))) return true;
    return false;
}

ConvexPiece randomPiece(std::int64_t which) {
    const Point centre{draw(which, 0, -1, 1), draw(which, 1, -1, 1)};
    const double reach = draw(which, 2, 0.05, 0.8);
    const int corners = static_cast<int>(draw(which, 3, 2, 9));
    if (corners == 2) return ConvexPiece::circle(centre, reach);
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = (i + draw(which, 4, 0, 1)) * 2 * std::numbers::pi / corners;
        polygon.push_back(centre + reach * Point{std::cos(angle), std::sin(angle)});
    }
    return ConvexPiece::polygon(polygon).value();
}

TEST(LineOfSight, CrossesWhatSamplesAlongTheLineMeet) {
    int crossed = 0, grazed = 0;
    for (std::int64_t i = 0; i < 3000; ++i) {
        const ConvexPiece piece = randomPiece(i);
        const Point from{draw(i, 10, -2, 2), draw(i, 11, -2, 2)}, to{draw(i, 12, -2, 2), draw(i, 13, -2, 2)};
        const bool exact = crosses(piece, from, to), sampled = crossesBySamples(piece, from, to);
        EXPECT_EQ(exact, crosses(piece, to, from)) << i;
        EXPECT_TRUE(exact || !sampled) << i;
        crossed += exact ? 1 : 0;
        grazed += exact && !sampled ? 1 : 0;
    }
    EXPECT_GT(crossed, 500);
    // Samples are up to 1.4 mm apart, and shorter cuts are rare.
    EXPECT_LE(grazed, 3);
}

TEST(LineOfSight, ParallelToAnEdgeIsDecidedByTheSide) {
    const ConvexPiece box = *ConvexPiece::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    EXPECT_TRUE(crosses(box, {-1, 0.5}, {2, 0.5}));
    EXPECT_FALSE(crosses(box, {-1, 1.5}, {2, 1.5}));
    EXPECT_FALSE(crosses(box, {-1, -1e-9}, {2, -1e-9}));
    EXPECT_TRUE(crosses(box, {0.2, 0.2}, {0.3, 0.3}));
    EXPECT_FALSE(crosses(box, {-1, 0.5}, {-0.1, 0.5}));
    EXPECT_FALSE(crosses(box, {1.1, 0.5}, {2, 0.5}));
}

/// A place full of posts, slanted walls, robots of several pieces, and balls.
Scenario crowd() {
    Environment environment = walledField(12, 9);
    const auto obstacle = [&](ShapePart shape) {
        environment.obstacles.push_back({"obstacle", Shape::fromParts("obstacle", {std::move(shape)}), {}});
    };
    for (std::int64_t i = 0; i < 8; ++i) {
        const Point at{draw(i, 20, 1, 11), draw(i, 21, 1, 8)};
        const Point along{draw(i, 22, -1, 1), draw(i, 23, -1, 1)};
        const Point across = (0.06 / length(along)) * Point{-along.y, along.x};
        obstacle(part({at, at + along, at + along + across, at + across}));
    }
    SmallWorld world(std::move(environment));
    RobotType type = seeing({.occlusion = true});
    type.shape = std::make_shared<const Shape>(
        Shape::fromParts("guide", {part({{-0.2, -0.15}, {0.15, -0.15}, {0.15, 0.15}, {-0.2, 0.15}}),
                                   part({{0.1, 0.1}, {0.3, 0.2}, {0.1, 0.2}})}));
    for (std::int64_t i = 0; i < 30; ++i)
        world.robot(type, {draw(i, 30, 0.5, 11.5), draw(i, 31, 0.5, 8.5), draw(i, 32, -3, 3)}, still(), ideal());
    for (std::int64_t i = 0; i < 20; ++i) world.object(ballType(), {draw(i, 40, 0.2, 11.8), draw(i, 41, 0.2, 8.8), 0});
    return world.scenario();
}

bool hiddenBySamples(const Scenario& scenario, const WorldState& state, std::size_t eye, std::size_t target) {
    const Point from = position(Scenario::poseOf(state, eye)), to = position(Scenario::poseOf(state, target));
    for (const ConvexPiece& piece : scenario.obstacles().pieces())
        if (crossesBySamples(piece, from, to)) return true;
    for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) {
        if (body == eye || body == target) continue;
        for (const ConvexPiece& piece : scenario.scene().shapeOf(body).pieces)
            if (crossesBySamples(placed(piece, Placement(Scenario::poseOf(state, body))), from, to)) return true;
    }
    return false;
}

TEST(LineOfSight, HidesWhatSamplesAlongTheLineMeetInACrowd) {
    const Scenario scenario = crowd();
    const std::size_t robots = scenario.scene().robots.size();
    int visible = 0, hidden = 0, wrong = 0;
    for (std::uint32_t robot = 0; robot < robots; robot += 3) {
        SensorWatch watch(scenario, 1, robot);
        const Observation& now = watch.next();
        std::set<std::size_t> seen;
        for (const SeenBody& body : now.robots()) seen.insert(body.index);
        for (const SeenBody& body : now.objects()) seen.insert(robots + body.index);
        for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) {
            if (body == robot) continue;
            const bool sampled = hiddenBySamples(scenario, watch.state(), robot, body);
            (sampled ? hidden : visible) += 1;
            EXPECT_TRUE(!sampled || !seen.count(body)) << robot << " sees through to " << body;
            wrong += !sampled && !seen.count(body) ? 1 : 0;
        }
    }
    EXPECT_GT(visible, 50);
    EXPECT_GT(hidden, 200);
    EXPECT_LE(wrong, 1);  // a cut shorter than the samples' spacing
}

TEST(LineOfSight, HidesByWhereBodiesWereThen) {
    BodySight sight{.occlusion = true};
    sight.latency = 100'000'000;
    const Scenario scenario = SmallWorld()
                                  .robot(seeing(sight), {}, still(), ideal())
                                  .robot(discRobot(), {1, 0, 0}, still(), ideal())
                                  .object(ballType(), {2, 0, 0})
                                  .scenario();
    WorldState state = scenario.initialState();
    Observation now;
    state.robots[1].pose.y = 1;  // it has just moved out of the way
    perceive(scenario, state, 0, now);
    EXPECT_TRUE(now.objects().empty());
    run(scenario, state, 5);
    state.robots[1].pose.y = 0;  // and back
    perceive(scenario, state, 0, now);
    EXPECT_EQ(now.objects().size(), 1u);
}

TEST(LineOfSight, WithoutOcclusionItSeesThroughEverything) {
    SmallWorld world(walledField(4, 4));
    const Scenario scenario = world.robot(seeing({}), {2, 2, 0}, still(), ideal())
                                  .robot(discRobot(), {3, 2, 0}, still(), ideal())
                                  .object(ballType(), {6, 2, 0})
                                  .scenario();
    EXPECT_EQ(SensorWatch(scenario, 1).next().objects().size(), 1u);
}

}  // namespace
}  // namespace mrose
