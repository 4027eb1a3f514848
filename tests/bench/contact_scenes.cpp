#include "bench/contact_scenes.h"

#include <cmath>

#include "simulation/small_world.h"
#include "support/outlines.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose::bench {
namespace {

std::shared_ptr<const Controller> drive(double v, double w = 0) { return std::make_shared<const Told>(Command{v, w}); }

}  // namespace

Scenario corneredRobots() {
    SmallWorld world(walledField(6, 6));
    for (int i = 0; i < 12; ++i)
        world.robot(i % 2 == 0 ? squareRobot() : discRobot(), {1.0 + 0.6 * (i % 4), 1.0 + 0.6 * (i / 4), -0.75 * pi},
                    drive(1, 0.05 * (i % 3 - 1)), ideal());
    return world.scenario();
}

Scenario boxPile() {
    SmallWorld world(walledField(6, 6));
    for (int i = 0; i < 6; ++i)
        world.robot(i % 2 == 0 ? squareRobot() : discRobot(),
                    {2.6 - 0.5 * (i % 3 - 1) + 0.4 * (i / 3), 2.6 + 0.5 * (i % 3 - 1) + 0.4 * (i / 3), -0.75 * pi},
                    drive(0.5), ideal());
    for (int i = 0; i < 20; ++i)
        world.object(boxType(0.3, 1 + i % 4), {0.3 + 0.36 * (i % 5), 0.3 + 0.36 * (i / 5), 0.1 * (i % 3)});
    return world.scenario();
}

Scenario pressedBall(double speed) {
    SmallWorld world;
    world.robot(squareRobot(), {-0.8, 0, 0}, drive(speed), ideal());
    world.robot(squareRobot(), {0.8, 0, pi}, drive(speed), ideal());
    world.object(ballType(), {0, 0.003, 0});
    return world.scenario();
}

Scenario elasticBall() {
    SmallWorld world(onIce(walledField(2, 1.5, {0, 1})));
    world.object(rollingBody(0.11, 0.43, {0, 1}), {0.7, 0.6, 0}, {3.17, 1.73, 2});
    return world.scenario();
}

Scenario boxAtWall(bool pressed) {
    SmallWorld world(walledField(4, 4));
    if (pressed) world.robot(squareRobot(), {2, 2.05, 0}, drive(0.4), ideal());
    world.object(boxType(0.3), {3.7, 2, 0.05}, pressed ? Twist{} : Twist{1, 0, 0});
    return world.scenario();
}

Scenario openCollision(std::int64_t number, double restitution) {
    const auto draw = [&](std::uint32_t c) { return uniformNoise({51, number, 0, c}); };
    const auto& outlines = trickyOutlines();
    const auto any = [&](std::uint32_t c) {
        return outlines[static_cast<std::size_t>(draw(c) * static_cast<double>(outlines.size()))];
    };
    const Surface surface{restitution == 1 ? 0 : draw(0), restitution};
    SmallWorld world(onIce());
    world.object(slidingBody(any(1), 0.5 + 20 * draw(2), surface), {-0.7, 0.1 * draw(3), 2 * pi * draw(4)},
                 {1 + 4 * draw(5), 0, 3 * draw(6)});
    world.object(slidingBody(any(7), 0.5 + 20 * draw(8), surface), {0.1, 0, 2 * pi * draw(9)},
                 {-draw(10), 0, draw(11)});
    return world.scenario();
}

Scenario lonelyBall(double speed, double slidingFriction, double rollingDeceleration) {
    SmallWorld world;
    FloorSurface& floor = world.parts().scene.environment.floor;
    floor.slidingFriction = slidingFriction;
    floor.rollingDeceleration = rollingDeceleration;
    world.object(ballType(), {}, {speed, 0, 0});
    return world.scenario();
}

Scenario thrownBall(const Twist& velocity, double friction, double restitution) {
    SmallWorld world(onIce(walledField(4, 40, {friction, 0})));
    world.object(rollingBody(0.11, 0.43, {friction, restitution}), {3, 20, 0}, velocity);
    return world.scenario();
}

}  // namespace mrose::bench
