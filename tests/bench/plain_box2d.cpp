#include "bench/plain_box2d.h"

#include <cmath>
#include <vector>

#include <box2d/box2d.h>

#include "world/noise.h"

namespace mrose::bench {

struct PlainBox2d::World {
    b2World world{b2Vec2(0, 0)};
    std::vector<b2Body*> robots;
    bool heavy = true;
    std::uint64_t seed = 0;
    std::int64_t commands = 0;

    void addWalls(float width, float height) {
        const b2BodyDef definition;
        b2Body* const ground = world.CreateBody(&definition);
        const auto wall = [&](float x, float y, float halfWidth, float halfHeight) {
            b2PolygonShape shape;
            shape.SetAsBox(halfWidth, halfHeight, b2Vec2(x, y), 0);
            ground->CreateFixture(&shape, 0);
        };
        constexpr float t = 0.1F;
        wall(width / 2, -t, width / 2 + 2 * t, t);
        wall(width / 2, height + t, width / 2 + 2 * t, t);
        wall(-t, height / 2, t, height / 2);
        wall(width + t, height / 2, t, height / 2);
    }

    b2Body* addBody(float x, float y, float angle, const b2Shape& shape, float density, float friction,
                    float restitution, float damping) {
        b2BodyDef definition;
        definition.type = b2_dynamicBody;
        definition.position = {x, y};
        definition.angle = angle;
        definition.linearDamping = definition.angularDamping = damping;
        b2Body* const body = world.CreateBody(&definition);
        b2FixtureDef fixture;
        fixture.shape = &shape;
        fixture.density = density;
        fixture.friction = friction;
        fixture.restitution = restitution;
        body->CreateFixture(&fixture);
        return body;
    }
};

PlainBox2d::PlainBox2d(std::uint32_t robots, bool heavy, std::uint64_t seed) : world_(std::make_unique<World>()) {
    World& w = *world_;
    w.heavy = heavy;
    w.seed = seed;
    const auto height = static_cast<float>(std::sqrt(robots * 6.25 / 2)), width = 2 * height;
    w.addWalls(width, height);
    const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(2.0 * robots)));
    const std::uint32_t rows = (robots + columns - 1) / columns;
    b2PolygonShape square;
    square.SetAsBox(0.225F, 0.225F);
    for (std::uint32_t i = 0; i < robots; ++i) {
        const float x = width * (static_cast<float>(i % columns) + 0.5F) / static_cast<float>(columns);
        const float y = height * (static_cast<float>(i / columns) + 0.5F) / static_cast<float>(rows);
        const auto angle = static_cast<float>(b2_pi * (2 * uniformNoise({seed, -1, i, 0}) - 1));
        w.robots.push_back(w.addBody(x, y, angle, square, 100, 0.3F, 0.1F, 0));
    }
    b2CircleShape ball;
    ball.m_radius = 0.11F;
    w.addBody(width / 2, height / 2, 0, ball, 12, 0.2F, 0.6F, 0.3F);
}

PlainBox2d::~PlainBox2d() = default;
PlainBox2d::PlainBox2d(PlainBox2d&&) noexcept = default;

void PlainBox2d::run() {
    World& w = *world_;
    for (std::uint32_t i = 0; i < w.robots.size(); ++i) {
        const NoisePair u = uniformPair({w.seed, w.commands, i, 0});
        const auto v = static_cast<float>(w.heavy ? u.first : 2 * u.first - 1);
        w.robots[i]->SetLinearVelocity(v * w.robots[i]->GetWorldVector(b2Vec2(1, 0)));
        w.robots[i]->SetAngularVelocity(static_cast<float>((w.heavy ? 4 : 2) * (2 * u.second - 1)));
    }
    ++w.commands;
    for (int i = 0; i < 6; ++i) w.world.Step(1 / 60.0F, 8, 3);
}

int PlainBox2d::contacts() const {
    int touching = 0;
    for (const b2Contact* c = world_->world.GetContactList(); c != nullptr; c = c->GetNext())
        touching += c->IsTouching() ? 1 : 0;
    return touching;
}

}  // namespace mrose::bench
