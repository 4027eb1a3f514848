// What robots see among many, compared to the bit with looking at each body and at all that may hide it.
//
// Corner cases, each with a test here or in body_sight_test.cpp and line_of_sight_test.cpp: no other body, few and many
// (a grid of one cell and of more); a body in the eye's own place, the eye inside another body, all in one place;
// bodies in rows and columns, so that lines of sight run along the grid's; a body far from all others, seen and seeing;
// coordinates of a million metres; ranges without end, beyond all bodies and ending at a body; fields of view up to all
// round and down to a slit; sensors of different latency in one tick; another state with the same memory to work in.
#include <bit>
#include <numbers>

#include "geometry/elementary.h"
#include "sensing/body_sight.h"
#include "sensing/line_of_sight.h"
#include "sensing/perceiving.h"

namespace mrose {
namespace {

constexpr double wholeTurn = 2 * std::numbers::pi;
constexpr Nanoseconds tick = 20'000'000;

/// Random numbers of one scene, in turn.
class Draws {
public:
    explicit Draws(std::uint64_t scene) : scene_(scene) {}
    double between(double least, double most) {
        return least + (most - least) * uniformNoise({scene_, ++count_, 0, 0});
    }
    bool chance(double probability) { return between(0, 1) < probability; }
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(between(0, count)); }

private:
    std::uint64_t scene_;
    std::int64_t count_ = 0;
};

struct Eye {
    const BodySight& sight;
    std::size_t first, count;
    NoiseChannel channel;
};

bool isHidden(const Scenario& scenario, const WorldState& state, std::int64_t lag, std::size_t eye,
              std::size_t target) {
    const auto poseOf = [&](std::size_t body) { return scenario.poseBefore(state, body, lag); };
    const Point from = position(poseOf(eye)), to = position(poseOf(target));
    for (const ConvexPiece& piece : scenario.obstacles().pieces())
        if (crosses(piece, from, to)) return true;
    for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) {
        if (body == eye || body == target) continue;
        const Placement frame(poseOf(body));
        for (const ConvexPiece& piece : scenario.scene().shapeOf(body).pieces)
            if (crosses(piece, frame.placeBack(from), frame.placeBack(to))) return true;
    }
    return false;
}

std::vector<SeenBody> allPairs(const Scenario& scenario, const WorldState& state, std::uint32_t robot,
                               const Eye& sensor, double bias) {
    const BodySight& sight = sensor.sight;
    const std::int64_t lag = scenario.scene().ticksOf(sight.latency);
    const Placement frame(scenario.poseBefore(state, robot, lag));
    std::vector<SeenBody> seen;
    for (std::uint32_t i = 0; i < sensor.count && sight.present; ++i) {
        const std::size_t body = sensor.first + i;
        const auto key = [&](std::uint32_t part) {
            return NoiseKey{state.seed, state.tick, robot, channelOf(sensor.channel, part)};
        };
        const Point offset = position(scenario.poseBefore(state, body, lag)) - frame.origin;
        const Point at = frame.rotateBack(offset);
        if (body == robot || (sight.range > 0 && dot(offset, offset) > sight.range * sight.range)) continue;
        if (sight.fieldOfView < wholeTurn && at.x < cosTurns(sight.fieldOfView / (2 * wholeTurn)) * length(at))
            continue;
        if (sight.dropOut > 0 && uniformNoise(key(2 * i + 1)) < sight.dropOut) continue;
        if (sight.occlusion && isHidden(scenario, state, lag, robot, body)) continue;
        SeenBody is{i, at, scenario.scene().timeOf(state.tick - lag)};
        if (sight.bearingNoise != 0 || sight.rangeNoise != 0 || sight.rangeNoiseSlope != 0 || sight.bearingBias != 0) {
            const NoisePair draw = normalPair(key(2 * i));
            const double share = sight.rangeNoise + sight.rangeNoiseSlope * length(at);
            const double turns = (sight.bearingBias * bias + sight.bearingNoise * draw.first) / wholeTurn;
            const double range = std::max(0.0, 1 + share * draw.second);
            const Point turned{range * cosTurns(turns), range * sinTurns(turns)};
            is.position_B = {turned.x * at.x - turned.y * at.y, turned.y * at.x + turned.x * at.y};
        }
        seen.push_back(is);
    }
    return seen;
}

bool sameBits(const SeenBody& a, const SeenBody& b) {
    const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
    return a.index == b.index && a.measured == b.measured && bits(a.position_B.x) == bits(b.position_B.x) &&
           bits(a.position_B.y) == bits(b.position_B.y);
}

struct Counts {
    int seen = 0, robots = 0;
};

void expectSame(std::span<const SeenBody> seen, const std::vector<SeenBody>& expected, Counts& counts) {
    EXPECT_TRUE(std::equal(seen.begin(), seen.end(), expected.begin(), expected.end(), sameBits))
        << seen.size() << " are seen, and not " << expected.size();
    counts.seen += static_cast<int>(expected.size());
}

/// All robots of a state, one after the other, with the same memory to work in.
Counts expectAllPairs(const Scenario& scenario, WorldState state, SensingBuffers& buffers) {
    Counts counts;
    buffers.forget();
    Observation now;
    const std::size_t robots = state.robots.size();
    for (std::uint32_t i = 0; i < robots; ++i) {
        SCOPED_TRACE(i);
        observe(scenario, state, i, scenario.sensorMemory(state, i), buffers, now);
        const double bias = as<BodySensor::Memory>(scenario.sensorMemory(state, i, 1)).bearingBias;
        const Perception& perception = scenario.scene().typeOf(i).perception;
        const auto expected = [&](const Eye& sensor) { return allPairs(scenario, state, i, sensor, bias); };
        expectSame(now.robots(), expected({perception.robots, 0, robots, NoiseChannel::sightOfRobots}), counts);
        expectSame(now.objects(),
                   expected({perception.objects, robots, state.objects.size(), NoiseChannel::sightOfObjects}), counts);
        ++counts.robots;
    }
    return counts;
}

BodySight randomSight(Draws& draws) {
    BodySight sight;
    sight.present = !draws.chance(0.05);
    if (draws.chance(0.7)) {
        sight.bearingNoise = draws.between(0, 0.1);
        sight.rangeNoise = draws.between(0, 0.1);
        sight.rangeNoiseSlope = draws.chance(0.5) ? 0.02 : 0;
    }
    if (draws.chance(0.3)) sight.bearingBias = 0.03;
    if (draws.chance(0.7)) sight.fieldOfView = draws.chance(0.1) ? 0.02 : draws.between(0.2, wholeTurn);
    if (draws.chance(0.7)) sight.range = draws.chance(0.1) ? 1000 : draws.between(0.5, 8);
    sight.latency = draws.chance(0.5) ? tick * draws.below(8) : 0;
    if (draws.chance(0.4)) sight.dropOut = 0.2;
    sight.occlusion = draws.chance(0.7);
    return sight;
}

RobotType randomType(Draws& draws) {
    RobotType type = draws.chance(0.5) ? discRobot(draws.between(0.05, 0.4)) : squareRobot(draws.between(0.1, 0.8));
    type.perception.robots = randomSight(draws);
    type.perception.objects = randomSight(draws);
    return type;
}

struct Crowd {
    std::uint32_t robots, objects;
    double width, height;  ///< m
    Point middle = {};
    int walls = 6;
};

Pose randomPose(const Crowd& crowd, Draws& draws) {
    const double far = draws.chance(0.01) ? 40 : 1;
    return {crowd.middle.x + far * draws.between(-crowd.width, crowd.width) / 2,
            crowd.middle.y + far * draws.between(-crowd.height, crowd.height) / 2, draws.between(-4, 4)};
}

Scenario randomScenario(const Crowd& crowd, Draws& draws) {
    Environment environment;
    for (int i = 0; i < crowd.walls; ++i) {
        const Pose at = randomPose(crowd, draws);
        ShapePart wall;
        const double half = draws.between(0.2, 2);
        for (const Point& corner : {Point{-half, -0.05}, Point{half, -0.05}, Point{half, 0.05}, Point{-half, 0.05}})
            wall.polygon.push_back(Placement(at).place(corner));
        environment.obstacles.push_back({"wall", Shape::fromParts("wall", {wall}), {}});
    }
    SmallWorld world(std::move(environment));
    std::vector<RobotType> types;
    for (int i = 0; i < 6; ++i) types.push_back(randomType(draws));
    for (std::uint32_t i = 0; i < crowd.robots; ++i)
        world.robot(types[draws.below(6)], randomPose(crowd, draws), still(), ideal());
    for (std::uint32_t i = 0; i < crowd.objects; ++i)
        world.object(draws.chance(0.5) ? ballType() : boxType(), randomPose(crowd, draws));
    return world.scenario();
}

/// Bodies anywhere, now and in each of the ticks before.
WorldState randomState(const Scenario& scenario, const Crowd& crowd, Draws& draws) {
    WorldState state = scenario.initialState(draws.below(1000));
    state.tick = 5 * static_cast<std::int64_t>(draws.below(1000));
    for (RobotState& robot : state.robots) robot.pose = randomPose(crowd, draws);
    for (ObjectState& object : state.objects) object.pose = randomPose(crowd, draws);
    for (Pose& pose : state.past) pose = randomPose(crowd, draws);
    return state;
}

TEST(AllPairs, RandomCrowdsAreSeenTheSame) {
    SensingBuffers buffers;
    Counts all;
    const Crowd crowds[] = {{1, 0, 4, 4},     {1, 1, 4, 4},     {2, 0, 3, 3},   {8, 1, 9, 6},
                            {20, 4, 12, 9},   {22, 3, 5, 5},    {60, 30, 9, 9}, {60, 0, 200, 1},
                            {150, 30, 30, 6}, {300, 1, 40, 20}, {40, 300, 9, 9}};
    for (std::uint64_t scene = 0; scene < 44; ++scene) {
        SCOPED_TRACE(scene);
        const Crowd& crowd = crowds[scene % std::size(crowds)];
        Draws draws(scene);
        const Scenario scenario = randomScenario(crowd, draws);
        for (int i = 0; i < 2; ++i) {
            const Counts counts = expectAllPairs(scenario, randomState(scenario, crowd, draws), buffers);
            all.seen += counts.seen;
            all.robots += counts.robots;
        }
    }
    EXPECT_GT(all.robots, 4000);
    EXPECT_GT(all.seen, 20 * all.robots / 10);
}

/// Small ones beside and before large ones, which stick out of their cells and of what hides their middles.
TEST(AllPairs, OfVeryDifferentSizes) {
    SensingBuffers buffers;
    int seen = 0;
    for (std::uint64_t scene = 0; scene < 6; ++scene) {
        SCOPED_TRACE(scene);
        Draws draws(200 + scene);
        const double wide = scene % 2 == 0 ? 12 : 40;
        SmallWorld world;
        for (int i = 0; i < 160; ++i) {
            RobotType type = i % 8 == 0 ? squareRobot(3) : i % 2 == 0 ? discRobot(0.05) : squareRobot(0.2);
            type.perception.robots = {.occlusion = true};
            if (i % 3 != 0) type.perception.robots.fieldOfView = draws.between(0.3, wholeTurn);
            if (i % 5 == 0) type.perception.robots.range = draws.between(5, 30);
            type.perception.objects = {.fieldOfView = 4, .occlusion = true};
            world.robot(type, {draws.between(0, wide), draws.between(0, wide), draws.between(-4, 4)}, still(), ideal());
        }
        for (int i = 0; i < 70; ++i)
            world.object(ballType(), {draws.between(0, wide), draws.between(0, wide), draws.between(-4, 4)});
        const Scenario scenario = world.scenario();
        seen += expectAllPairs(scenario, scenario.initialState(), buffers).seen;
    }
    EXPECT_GT(seen, 500);
}

TEST(AllPairs, FarFromTheOriginToo) {
    SensingBuffers buffers;
    for (std::uint64_t scene = 0; scene < 4; ++scene) {
        Draws draws(100 + scene);
        const Crowd crowd{80, 5, 20, 10, {-1e6, 3e6}, 0};
        const Scenario scenario = randomScenario(crowd, draws);
        expectAllPairs(scenario, randomState(scenario, crowd, draws), buffers);
    }
}

/// Lines of sight run along rows and columns, through the middles of others and along edges.
TEST(AllPairs, InRowsAndColumns) {
    SensingBuffers buffers;
    for (const double range : {0.0, 3.0, 7.5}) {
        SmallWorld world;
        RobotType type = squareRobot(0.5);
        type.perception.robots =
            type.perception.objects = {.fieldOfView = std::numbers::pi / 2, .range = range, .occlusion = true};
        for (int i = 0; i < 100; ++i)
            world.robot(type, {1.5 * (i % 10), 1.5 * (i / 10), (i % 4) * std::numbers::pi / 2}, still(), ideal());
        world.object(ballType(), {0.75, 0.75, 0});
        const Scenario scenario = world.scenario();
        EXPECT_GT(expectAllPairs(scenario, scenario.initialState(), buffers).seen, 100);
    }
}

TEST(AllPairs, AllInOnePlaceOrInsideEachOther) {
    SensingBuffers buffers;
    for (const double spread : {0.0, 0.1, 0.6}) {
        Draws draws(7);
        const Crowd crowd{60, 40, spread, spread, {}, 0};
        const Scenario scenario = randomScenario(crowd, draws);
        WorldState state = scenario.initialState();
        for (RobotState& robot : state.robots) robot.pose.heading = draws.between(-4, 4);
        expectAllPairs(scenario, state, buffers);
    }
}

}  // namespace
}  // namespace mrose
