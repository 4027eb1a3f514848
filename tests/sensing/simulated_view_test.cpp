// What learned sensors have before them among many, compared with looking at each body and all that may hide it, by
// clipping polygons instead of walking round them.
#include "sensing/simulated_view.h"

#include <cmath>
#include <numbers>

#include "sensing/perceiving.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

/// Random numbers of one scene, in turn.
class SceneDraws {
public:
    explicit SceneDraws(std::uint64_t scene) : scene_(scene) {}
    double between(double least, double most) {
        return least + (most - least) * uniformNoise({scene_, ++count_, 1, 0});
    }
    bool chance(double probability) { return between(0, 1) < probability; }

private:
    std::uint64_t scene_;
    std::int64_t count_ = 0;
};

using Described = std::pair<SimulatedView::Subject, SensedState>;

/// The part of a polygon where `normal` . p > `least`.
Polygon clipped(const Polygon& polygon, const Point& normal, double least) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = dot(normal, a) - least, db = dot(normal, b) - least;
        if (da > 0) kept.push_back(a);
        if ((da > 0) != (db > 0)) kept.push_back(a + (da / (da - db)) * (b - a));
    }
    return kept;
}

struct Hiding {
    double clearance = SensedState::clear;
    bool hidden = false;

    /// A piece, in the world; the line from `eye` to `subject`.
    void by(const ConvexPiece& piece, bool obstacle, bool wall, const Point& eye, const Point& subject) {
        const double range = distance(eye, subject);
        const Point along = (1 / range) * (subject - eye), left{-along.y, along.x};
        double least = 1e9, most = -1e9, width = 0;
        bool crosses = false, nearer = false;
        if (piece.isCircle()) {
            const Point centre = piece.corners[0] - eye;
            least = dot(left, centre) - piece.radius;
            most = dot(left, centre) + piece.radius;
            width = 2 * piece.radius;
            crosses = distanceToSegment(piece.corners[0], eye, subject) < piece.radius;
            nearer = length(centre) < range && dot(along, centre) > 0;
        } else {
            Polygon polygon(piece.corners.begin(), piece.corners.begin() + static_cast<std::ptrdiff_t>(piece.count));
            polygon = clipped(polygon, along, dot(along, eye));
            polygon = clipped(polygon, -1.0 * along, -dot(along, eye) - range);
            for (const Point& corner : polygon) {
                least = std::min(least, dot(left, corner - eye));
                most = std::max(most, dot(left, corner - eye));
            }
            nearer = !polygon.empty();
            width = most - least;
            crosses = nearer && least < 0 && most > 0;
        }
        hidden = hidden || (obstacle && crosses && (wall || width > 0.3));
        if (nearer) clearance = std::max(std::min(clearance, std::max(least, -most)), -SensedState::hidden);
    }
};

std::vector<Described> bruteForce(const Scenario& scenario, const WorldState& state, std::size_t robot,
                                  const View& limits, Nanoseconds time) {
    const Scene& scene = scenario.scene();
    const Nanoseconds ago = scene.timeOf(state.tick) - time;
    const std::int64_t lag = ago / scene.tickLength;
    const double share = static_cast<double>(ago % scene.tickLength) / static_cast<double>(scene.tickLength);
    const auto poseOf = [&](std::size_t body) {
        const Pose after = scenario.poseBefore(state, body, lag), before = scenario.poseBefore(state, body, lag + 1);
        return Pose{(1 - share) * after.x + share * before.x, (1 - share) * after.y + share * before.y,
                    (1 - share) * after.heading + share * before.heading};
    };
    const Pose eye = poseOf(robot);
    std::vector<Described> found;
    const std::vector<Landmark> landmarks = landmarksOf(scene.environment);
    const auto add = [&](SubjectKind kind, std::uint32_t index, const Point& place) {
        SensedState s;
        s.subject = kind;
        s.range = distance(position(eye), place);
        s.bearing = std::remainder(std::atan2(place.y - eye.y, place.x - eye.x) - eye.heading, 2 * std::numbers::pi);
        findEdges(s, limits);
        if (!limits.margin().holds(s.range, s.bearing)) return;
        found.push_back(
            {{kind, index, place - position(eye), s.range, s.bearing, limits.holds(s.range, s.bearing)}, s});
    };
    for (std::uint32_t i = 0; i < landmarks.size(); ++i) add(SubjectKind::landmark, i, landmarks[i].position);
    for (std::uint32_t i = 0; i < state.robots.size(); ++i)
        if (i != robot) add(SubjectKind::robot, i, position(poseOf(i)));
    std::vector<Described> described;
    for (Described all : found) {
        auto& [subject, s] = all;
        const bool landmark = subject.kind == SubjectKind::landmark;
        for (const auto& [other, of] : found) {
            if ((other.kind == subject.kind && other.index == subject.index) || !other.counts) continue;
            s.others += 1;
            const double angle = std::abs(std::remainder(other.bearing - s.bearing, 2 * std::numbers::pi));
            s.separation = std::min(s.separation, angle);
            if (other.range < s.range) s.nearerSeparation = std::min(s.nearerSeparation, angle);
        }
        Hiding hiding;
        const Point place = position(eye) + subject.offset;
        for (std::uint32_t i = 0; i < scene.environment.obstacles.size(); ++i) {
            const Obstacle& obstacle = scene.environment.obstacles[i];
            if (landmark && landmarks[subject.index].obstacle == i) continue;
            for (const ConvexPiece& piece : obstacle.shape.pieces)
                hiding.by(piece, true, obstacle.wall, position(eye), place);
        }
        for (std::size_t body = 0; body < scene.bodyCount(); ++body) {
            if (body == robot || (!landmark && body == subject.index)) continue;
            for (const ConvexPiece& piece : scene.shapeOf(body).pieces)
                hiding.by(placed(piece, Placement(poseOf(body))), false, false, position(eye), place);
        }
        s.clearance = hiding.clearance;
        if (!hiding.hidden) described.push_back(all);
    }
    return described;
}

struct Place {
    int robots, objects, landmarks, walls;
    double width, height;
};

Pose anywhere(const Place& place, SceneDraws& draws) {
    return {draws.between(-place.width, place.width) / 2, draws.between(-place.height, place.height) / 2,
            draws.between(-4, 4)};
}

Scenario randomPlace(const Place& place, SceneDraws& draws) {
    Environment environment;
    const auto stand = [&](const ShapePart& part, bool wall, const std::string& landmark) {
        environment.obstacles.push_back({"o", Shape::fromParts("o", {part}), {}, wall, landmark});
    };
    const auto rectangle = [&](double half, double thick) {
        const Placement at(anywhere(place, draws));
        ShapePart part;
        for (const Point& corner : {Point{-half, -thick}, Point{half, -thick}, Point{half, thick}, Point{-half, thick}})
            part.polygon.push_back(at.place(corner));
        return part;
    };
    const auto circle = [&](double radius) {
        ShapePart part;
        part.centre = position(anywhere(place, draws));
        part.radius = radius;
        return part;
    };
    for (int i = 0; i < place.walls; ++i)
        stand(rectangle(draws.between(0.02, 1), draws.between(0.01, 0.2)), draws.chance(0.3), "");
    for (int i = 0; i < place.landmarks; ++i)
        stand(draws.chance(0.7) ? circle(draws.between(0.03, 0.25)) : rectangle(0.1, 0.05), false, std::to_string(i));
    SmallWorld world(std::move(environment));
    for (int i = 0; i < place.robots; ++i)
        world.robot(draws.chance(0.5) ? discRobot(draws.between(0.1, 0.3)) : squareRobot(draws.between(0.1, 0.6)),
                    anywhere(place, draws), still(), ideal());
    for (int i = 0; i < place.objects; ++i)
        world.object(draws.chance(0.5) ? ballType() : boxType(), anywhere(place, draws));
    // Late sensors keep the past.
    world.parts().scene.robotTypes[0].perception.self.latency = 200'000'000;
    return world.scenario();
}

TEST(SimulatedView, IsWhatEachBodyAndObstacleMakesIt) {
    SensingBuffers buffers;
    std::size_t all = 0, covered = 0;
    const Place places[] = {{1, 0, 0, 0, 4, 4},     {8, 1, 15, 0, 6, 6},     {8, 1, 15, 10, 6, 6},
                            {30, 10, 20, 30, 8, 8}, {90, 20, 5, 3, 20, 9},   {12, 3, 100, 5, 15, 9},
                            {5, 0, 8, 90, 9, 9},    {80, 80, 80, 80, 18, 18}};
    for (std::uint64_t scene = 0; scene < 48; ++scene) {
        SCOPED_TRACE(scene);
        const Place& place = places[scene % std::size(places)];
        SceneDraws draws(scene);
        const Scenario scenario = randomPlace(place, draws);
        WorldState state = scenario.initialState();
        state.tick = 1000;
        for (RobotState& robot : state.robots) robot.pose = anywhere(place, draws);
        for (Pose& pose : state.past) pose = anywhere(place, draws);
        const View limits{draws.between(0.5, 6), draws.chance(0.2) ? 6.2 : draws.between(0.3, 3)};
        const Nanoseconds ago = draws.chance(0.3) ? 40'000'000 : static_cast<Nanoseconds>(draws.between(0, 1.5e8));
        buffers.forget();
        for (std::uint32_t robot = 0; robot < std::min<std::size_t>(state.robots.size(), 12); ++robot) {
            SensorView view{scenario.scene(), scenario.obstacles(), scenario.past(), state, robot, buffers, 3};
            view.measured = view.timeBefore(0) - ago;
            const auto expected = bruteForce(scenario, state, robot, limits, view.measured);
            std::vector<SensedState> states;
            std::vector<std::uint32_t> which;
            buffers.simulated.look(view, limits);
            buffers.simulated.describe(
                view, {}, [](const auto&) { return true; }, states, which);
            ASSERT_EQ(states.size(), expected.size());
            ASSERT_EQ(which.size(), expected.size());
            for (std::size_t i = 0; i < states.size(); ++i) {
                const SimulatedView::Subject& subject = buffers.simulated.subjects()[which[i]];
                const auto& [is, s] = expected[i];
                ASSERT_EQ(subject.kind, is.kind);
                ASSERT_EQ(subject.index, is.index);
                EXPECT_EQ(subject.counts, is.counts);
                EXPECT_NEAR(states[i].range, s.range, 1e-9);
                EXPECT_NEAR(states[i].bearing, s.bearing, 1e-9);
                EXPECT_NEAR(states[i].edge, s.edge, 1e-6);
                EXPECT_NEAR(states[i].nearEdge, s.nearEdge, 1e-6);
                EXPECT_NEAR(states[i].clearance, s.clearance, 1e-9);
                EXPECT_NEAR(states[i].separation, s.separation, 1e-9);
                EXPECT_NEAR(states[i].nearerSeparation, s.nearerSeparation, 1e-9);
                EXPECT_EQ(states[i].others, s.others);
                EXPECT_EQ(states[i].unknownRobots, 0);
                ++all;
                covered += s.clearance < SensedState::clear;
            }
        }
    }
    EXPECT_GT(all, 2000u);
    EXPECT_GT(covered, all / 5);
}

/// In a place like the logs', it says what LoggedView says.
TEST(SimulatedView, ClearanceOfDiscsIsThatOfTheLogs) {
    Environment environment;
    for (const Point& place : {Point{3, 0.1}, Point{2, 0.02}}) {
        ShapePart part;
        part.centre = place;
        part.radius = 0.05;
        environment.obstacles.push_back({"o", Shape::fromParts("o", {part}), {}, false, place.x == 3 ? "a" : "b"});
    }
    const Scenario scenario = SmallWorld(std::move(environment))
                                  .robot(discRobot(0.17), {}, still(), ideal())
                                  .robot(discRobot(0.17), {1, 0.3, 0}, still(), ideal())
                                  .scenario();
    const WorldState state = scenario.initialState();
    SensingBuffers buffers;
    const SensorView view{scenario.scene(), scenario.obstacles(), scenario.past(), state, 0, buffers, 3};
    std::vector<SensedState> states;
    std::vector<std::uint32_t> which;
    buffers.simulated.look(view, {9, 1.2});
    buffers.simulated.describe(
        view, {}, [](const auto&) { return true; }, states, which);
    ASSERT_EQ(states.size(), 3u);
    const double range = std::hypot(3, 0.1);
    EXPECT_NEAR(states[0].clearance, std::abs(2 * 0.1 - 0.02 * 3) / range - 0.05, 1e-12) << "by the other landmark";
    EXPECT_NEAR(states[1].clearance, (0.3 * 2 - 0.02) / std::hypot(2, 0.02) - 0.17, 1e-12) << "by the robot";
    EXPECT_EQ(states[2].clearance, SensedState::clear);
}

}  // namespace
}  // namespace mrose
