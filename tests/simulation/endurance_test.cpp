// A million ticks of anything: nothing becomes infinite, nothing escapes, nothing that is left alone gains energy.
#include <array>
#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "learning/parallel_for.h"
#include "simulation/small_world.h"
#include "support/shipped.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr double side = 4;

/// Drives and kicks at random.
class Wild final : public Controller {
public:
    void decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const override {
        const NoisePair u = uniformPair({11, observation.time, observation.robot, 0});
        decision.command = Command{3 * u.first - 1.5, 8 * u.second - 4};
        if (u.first > 0.6) decision.kicks.push_back({0, u.second});
    }
};

struct Kind {
    RobotType type;
    std::shared_ptr<const MotionModel> model;
};

/// Robots that ship, with horns and kickers, and people: with their own motion and with one that knows no limits.
std::vector<Kind> kindsOfRobots() {
    std::vector<Kind> kinds;
    for (const char* name : {"pioneer1", "nomad200", "create", "husky", "b21", "human"}) {
        const RobotDescription robot = shippedRobot(name);
        kinds.push_back({robot.type, motionOf(robot)});
        kinds.back().type.perception = {};
        kinds.back().type.perception.robots.present = kinds.back().type.perception.objects.present = false;
        kinds.push_back({kinds.back().type, ideal()});
    }
    for (Kind& kind : kinds) {
        if (kind.type.manipulators.empty()) kind.type.manipulators = {{.name = "kicker", .position = {0.2, 0}}};
        Manipulator& kicker = kind.type.manipulators[0];
        kicker.speed = 6;
        kicker.reach = 0.1;
        kicker.width = 0.5;
        kicker.recharge = kicker.deadTime = 0;
    }
    return kinds;
}

/// Four robots, balls and boxes in a room with a post, all of them drawn by the world's number.
Scenario roomOf(std::int64_t number, const std::vector<Kind>& kinds) {
    const auto draw = [&](std::uint32_t c) { return uniformNoise({12, number, 0, c}); };
    SmallWorld world(walledField(side, side, {draw(0), draw(1)}));
    world.parts().scene.randomFactor = draw(2);
    world.parts().scene.environment.floor.slidingFriction = 0.5 * draw(3);
    ShapePart post;
    post.centre = {side / 2, side / 2};
    post.radius = 0.1;
    world.parts().scene.environment.obstacles.push_back({"post", Shape::fromParts("post", {post}), {0.3, 0.9}});
    // On a grid of 3 x 3 places, without the middle one.
    const auto place = [&](std::uint32_t i) {
        const std::uint32_t cell = i < 4 ? i : i + 1;
        return Pose{0.7 + 1.3 * (cell % 3), 0.7 + 1.3 * (cell / 3), 2 * pi * draw(10 + i)};
    };
    std::uint32_t body = 0;
    for (; body < 4; ++body) {
        const Kind& kind = kinds[static_cast<std::size_t>(draw(20 + body) * static_cast<double>(kinds.size()))];
        world.robot(kind.type, place(body), std::make_shared<const Wild>(), kind.model, body);
    }
    for (; body < 8; ++body) {
        ObjectType type = body % 2 == 0 ? ballType() : boxType(0.3, 0.5 + 10 * draw(30 + body));
        if (body == 7) type.shape = shippedShape("box");
        type.surface = {draw(40 + body), draw(50 + body)};
        world.object(type, place(body), {6 * draw(60 + body) - 3, 6 * draw(70 + body) - 3, 20 * draw(80 + body) - 10});
    }
    return world.scenario();
}

double energyOf(const Scenario& scenario, const WorldState& state, std::size_t object) {
    const auto& body = scenario.contactType(state.robots.size() + object);
    const ObjectType& type = scenario.scene().typeOfObject(object);
    const ObjectState& o = state.objects[object];
    const Twist& v = o.velocity_W;
    const double rolling = type.rolls ? type.inertia * body.mass * dot(o.roll_W, o.roll_W) : 0;
    return (body.mass * (v.x * v.x + v.y * v.y) + body.inertia * v.rotation * v.rotation + rolling) / 2;
}

/// What is wrong with the tick that led from one state to the next; "" where nothing is.
std::string objectionTo(const Scenario& scenario, const WorldState& before, const WorldState& after,
                        const StepTrace& trace) {
    for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) {
        const Pose& pose = Scenario::poseOf(after, body);
        if (!(pose.x > 0 && pose.x < side && pose.y > 0 && pose.y < side && std::isfinite(pose.heading)))
            return "body " + std::to_string(body) + " is outside";
    }
    if (!trace.faults.empty()) return trace.faults[0].what;
    for (const RobotState& r : after.robots)
        if (!std::isfinite(r.velocity_B.x + r.velocity_B.y + r.velocity_B.rotation)) return "a robot's velocity";
    std::array<bool, 8> kicked{};
    for (const StepTrace::Kicked& kick : trace.kicks)
        if (kick.hit) kicked[kick.object] = true;
    for (std::size_t i = 0; i < after.objects.size(); ++i) {
        const double energy = energyOf(scenario, after, i);
        if (!std::isfinite(energy) || energy > 20'000) return "energy of object " + std::to_string(i);
        if (trace.touchedObjects[i] || kicked[i]) continue;
        if (energy > energyOf(scenario, before, i) * (1 + 1e-9))
            return "object " + std::to_string(i) + " gained energy";
    }
    return "";
}

TEST(Endurance, AMillionTicksOfAnythingStayFiniteAndInside) {
    const std::vector<Kind> kinds = kindsOfRobots();
    constexpr std::size_t worlds = 500, ticks = 2000;
    std::vector<std::string> wrong(worlds);
    std::atomic<std::size_t> touches = 0, kicks = 0;
    parallelFor(worlds, [&](std::size_t w) {
        const Scenario scenario = roomOf(static_cast<std::int64_t>(w), kinds);
        WorldState state = scenario.initialState(w), before;
        StepBuffers buffers;
        StepTrace trace;
        for (std::size_t k = 0; k < ticks && wrong[w].empty(); ++k) {
            before = state;
            step(scenario, state, buffers, {}, &trace);
            wrong[w] = objectionTo(scenario, before, state, trace);
            if (!wrong[w].empty()) wrong[w] += " after tick " + std::to_string(k);
            touches += trace.contacts.size();
            for (const StepTrace::Kicked& kick : trace.kicks) kicks += kick.hit ? 1 : 0;
        }
    });
    for (std::size_t w = 0; w < worlds; ++w) EXPECT_EQ(wrong[w], "") << "world " << w;
    EXPECT_GT(touches, worlds * ticks / 2);
    EXPECT_GT(kicks, 3 * worlds / 4);  // about one a world by chance, +-5 %
}

/// Without robots there is no source of energy: the sum of all never grows.
TEST(Endurance, BodiesWithoutRobotsNeverGainEnergy) {
    const std::vector<Kind> kinds = kindsOfRobots();
    parallelFor(100, [&](std::size_t w) {
        ScenarioParts parts = roomOf(static_cast<std::int64_t>(w), kinds).parts();
        parts.scene.robots.clear();
        parts.controllers.clear();
        const Scenario scenario(std::move(parts));
        WorldState state = scenario.initialState(w);
        StepBuffers buffers;
        const auto sum = [&] {
            double all = 0;
            for (std::size_t i = 0; i < state.objects.size(); ++i) all += energyOf(scenario, state, i);
            return all;
        };
        double before = sum();
        for (int k = 0; k < 500; ++k) {
            step(scenario, state, buffers);
            const double now = sum();
            ASSERT_LE(now, before * (1 + 2e-6) + 1e-9) << "world " << w << ", tick " << k;
            before = now;
        }
    });
}

}  // namespace
}  // namespace mrose
