// What sensors of ranges cost: the benchmarks' scene (support/scenes.h) with a scanner of 180 beams over 180 degrees, 8
// m, on each robot. Beside it, as the peer of the ratio, as many ray casts in a world of Box2D with the same bodies in
// the same places. Each round measures both, scan by scan of the same states.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <box2d/box2d.h>

#include "bench/timing.h"
#include "sensing/infrared_ring.h"
#include "sensing/laser.h"
#include "sensing/line_camera.h"
#include "sensing/sensor_view.h"
#include "sensing/sonar_ring.h"
#include "simulation/step.h"
#include "support/scenes.h"

namespace mrose::bench {
namespace {

constexpr std::size_t beams = 180;
constexpr double farthest = 8;

/// The same bodies in Box2D.
class Peer {
public:
    Peer(const Scenario& scenario, const WorldState& state) {
        const b2BodyDef still;
        b2Body* const ground = world_.CreateBody(&still);
        for (const Obstacle& obstacle : scenario.scene().environment.obstacles) addFixtures(*ground, obstacle.shape);
        for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) {
            const Pose& pose = poseOf(state, body);
            b2BodyDef definition;
            definition.type = b2_dynamicBody;
            definition.position = {static_cast<float>(pose.x), static_cast<float>(pose.y)};
            definition.angle = static_cast<float>(pose.heading);
            bodies_.push_back(world_.CreateBody(&definition));
            addFixtures(*bodies_.back(), scenario.scene().shapeOf(body));
        }
    }

    double scan(std::size_t robot) const {
        struct Closest : b2RayCastCallback {
            const b2Body* self = nullptr;
            float fraction = 1;
            float ReportFixture(b2Fixture* fixture, const b2Vec2& /*point*/, const b2Vec2& /*normal*/,
                                float at) override {
                if (fixture->GetBody() == self) return -1;
                fraction = at;
                return at;
            }
        } closest;
        closest.self = bodies_[robot];
        const b2Vec2 from = bodies_[robot]->GetPosition();
        double first = 0;
        for (std::size_t beam = 0; beam < beams; ++beam) {
            const float angle = bodies_[robot]->GetAngle() - b2_pi / 2 + b2_pi * static_cast<float>(beam) / (beams - 1);
            closest.fraction = 1;
            world_.RayCast(&closest, from, from + farthest * b2Vec2(std::cos(angle), std::sin(angle)));
            if (beam == 0) first = farthest * closest.fraction;
        }
        return first;
    }

private:
    static void addFixtures(b2Body& body, const Shape& shape) {
        for (const ConvexPiece& piece : shape.pieces) {
            b2FixtureDef definition;
            definition.density = 1;
            b2PolygonShape polygon;
            b2CircleShape circle;
            definition.shape = &polygon;
            if (piece.isCircle()) {
                circle.m_p = {static_cast<float>(piece.corners[0].x), static_cast<float>(piece.corners[0].y)};
                circle.m_radius = static_cast<float>(piece.radius);
                definition.shape = &circle;
            } else {
                std::vector<b2Vec2> corners;
                for (std::size_t i = 0; i < piece.count; ++i)
                    corners.emplace_back(static_cast<float>(piece.corners[i].x),
                                         static_cast<float>(piece.corners[i].y));
                polygon.Set(corners.data(), static_cast<int>(corners.size()));
            }
            body.CreateFixture(&definition);
        }
    }

    b2World world_{b2Vec2(0, 0)};
    std::vector<b2Body*> bodies_;
};

/// The first beam's range, so that both do what they are asked for.
double scanned(const Sensor& sensor, const Scenario& scenario, const WorldState& state, std::size_t robot,
               SensingBuffers& buffers, Observation& out) {
    static const ReadingName name = "scan";
    SensorView view{
        scenario.scene(), scenario.obstacles(), scenario.past(), state, static_cast<std::uint32_t>(robot), buffers, 3};
    view.measured = view.timeBefore(0);
    out.clearReadings();
    sensor.sense(view, {}, out);
    const auto echoes = out.records<RangeEcho>(name);
    return echoes.empty() ? 0 : std::min(farthest, echoes[0].range);
}

struct Measured {
    double ours = 0, peer = 0;  ///< s for each scan
    double difference = 0;      ///< m, mean of the ranges
};

/// As in a run: robots that observe at one tick share what they know of it, a fifth of them at each.
Measured measure(std::uint32_t robots, const Sensor& sensor) {
    FieldOptions options;
    options.robots = robots;
    options.heavy = false;
    const Scenario scenario = fieldScenario(options);
    WorldState state = scenario.initialState(1);
    StepBuffers stepping;
    for (int i = 0; i < 500; ++i) step(scenario, state, stepping);
    SensingBuffers buffers;
    Observation out;
    std::vector<double> ours, peers;
    double difference = 0, scans = 0;
    for (int round = 0; round < 25; ++round) {
        for (int i = 0; i < 25; ++i) step(scenario, state, stepping);
        const Peer peer(scenario, state);
        const auto visit = [&](auto scan) {
            const std::size_t repetitions = robots <= 100 ? 100 : 2;
            double sum = 0;
            const double start = processorTime();
            for (std::size_t k = 0; k < repetitions; ++k)
                for (std::size_t phase = 0; phase < 5; ++phase) {
                    buffers.forget();
                    for (std::size_t robot = phase; robot < robots; robot += 5) sum += scan(robot);
                }
            const double count = static_cast<double>(repetitions * robots);
            return std::pair((processorTime() - start) / count, sum / count);
        };
        const auto own = visit([&](std::size_t r) { return scanned(sensor, scenario, state, r, buffers, out); });
        const auto other = visit([&](std::size_t r) { return peer.scan(r); });
        ours.push_back(own.first);
        peers.push_back(other.first);
        difference += std::abs(own.second - other.second);
        ++scans;
    }
    return {median(ours), median(peers), difference / scans};
}

Laser::Options scanner() {
    Laser::Options options;
    options.first = -std::numbers::pi / 2;
    options.beams = beams;
    options.step = std::numbers::pi / (beams - 1);
    options.errors.range = farthest;
    return options;
}

void compareScans() {
    Laser::Options noisy = scanner();
    noisy.errors.noise = 0.01;
    noisy.errors.dropOut = 0.01;
    const Laser exact({"scan"}, scanner()), erring({"scan"}, noisy);
    std::printf("Scans of %zu beams, 8 m, without noise / with\n", beams);
    double first = 0;
    for (const std::uint32_t robots : {8U, 100U, 1000U}) {
        const Measured m = measure(robots, exact), withNoise = measure(robots, erring);
        first = first == 0 ? m.ours : first;
        std::printf(
            "  %5u robots: %5.1f / %5.1f ns a beam, Box2D's ray casts %6.1f: 1/%.1f / 1/%.1f of them; %.2f times those "
            "of 8 robots (first beams %.1g m apart)\n",
            robots, 1e9 * m.ours / beams, 1e9 * withNoise.ours / beams, 1e9 * m.peer / beams, m.peer / m.ours,
            withNoise.peer / withNoise.ours, m.ours / first, m.difference);
    }
}

void timeRings() {
    std::vector<Pose> ring;
    for (int i = 0; i < 24; ++i) ring.push_back({0, 0, i * std::numbers::pi / 12});
    SonarRing::Options sonar;
    sonar.sonars = ring;
    sonar.cone = std::numbers::pi / 6;
    sonar.reflection = 0.4;
    sonar.errors.range = 3;
    InfraredRing::Options infrared;
    infrared.elements = ring;
    infrared.beam = 0.17;
    infrared.range = 0.8;
    infrared.reference = 0.1;
    std::printf("Rings of 24 on eight robots: sonars of 3 m %.0f ns each, infrared of 0.8 m %.0f ns each\n",
                1e9 * measure(8, SonarRing({"ring"}, sonar)).ours / 24,
                1e9 * measure(8, InfraredRing({"ring"}, infrared)).ours / 24);
}

void timeRows() {
    LineCamera::Options exact;
    exact.width = 320;
    exact.view = 0.85;
    exact.range = 10;
    exact.blobClasses = {ColourClass::ball, ColourClass::robot};
    LineCamera::Options blurred = exact, down = exact;
    blurred.edgeNoise = 0.5;
    blurred.misclassification = 0.01;
    down.floor = 2;
    const auto timeOf = [](const LineCamera::Options& options) {
        return 1e9 * measure(8, LineCamera({"scan"}, options)).ours / static_cast<double>(options.width);
    };
    std::printf("Line cameras of 320 pixels on eight robots: %.1f ns a pixel, blurred %.1f, meeting the floor %.1f\n",
                timeOf(exact), timeOf(blurred), timeOf(down));
}

}  // namespace
}  // namespace mrose::bench

int main() {
    mrose::bench::compareScans();
    mrose::bench::timeRings();
    mrose::bench::timeRows();
    return 0;
}
