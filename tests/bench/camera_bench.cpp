// What a learned camera costs: eight Creates that drive among the fifteen landmarks of the MRCLAM arena, all with the
// camera that ships. Beside it, as the peer of the ratio, the ideal camera (kind "camera") with the same view and
// occlusion, which sees robots alone. Each looks at the same instants of the same run.
#include <algorithm>
#include <cstdio>

#include "bench/timing.h"
#include "perception/learned_sensor.h"
#include "scenario/description_file.h"
#include "sensing/body_sight.h"
#include "sensing/learned_camera.h"
#include "sensing/sensor_view.h"
#include "simulation/step.h"
#include "support/scenes.h"

namespace mrose {
namespace {

constexpr std::uint32_t robots = 8;
constexpr int seconds = 60, repetitions = 31, rounds = 20;
// So many looks are in the cache, as the one world is that is stepped: those of a second and a half in each 20 s.
constexpr Nanoseconds every = 20 * nanosecondsPerSecond, first = 10 * nanosecondsPerSecond,
                      last = first + 3 * nanosecondsPerSecond / 2;

Scenario arena(const SensorPointer& camera) {
    DiskDescriptions source({MROSE_SOURCE_DIR, {}, ""});
    const auto environment = loadDescription("mrose:resources/environments/mrclam_arena.toml", source);
    const auto create = loadDescription("mrose:resources/robots/create.toml", source);
    if (!environment || !create) {
        std::fputs((environment ? create : environment).error().message().c_str(), stderr);
        std::exit(1);
    }
    ScenarioParts parts;
    parts.scene.environment = std::get<Environment>(*environment);
    const auto& description = std::get<RobotDescription>(*create);
    parts.scene.robotTypes = {description.type};
    parts.scene.robotTypes[0].sensors = {camera};
    for (std::uint32_t i = 0; i < robots; ++i) {
        const std::string name = std::to_string(i % 5 + 1);
        parts.scene.models.push_back(std::make_shared<const LearnedModel>(description.motion, name));
        SceneRobot robot{name, 0, i, i % 5, {0.5 + 1.2 * (i % 4), -2.0 + 3.0 * (i / 4), 0.8 * i}};
        robot.motionRobot = name;
        parts.scene.robots.push_back(robot);
        parts.controllers.push_back(std::make_shared<const RandomCommands>(0, 0.3, 0.7));
    }
    return Scenario(std::move(parts));
}

/// An instant at which a robot's camera looks.
struct Instant {
    WorldState state;
    std::uint32_t robot;
    Nanoseconds measured;
};

std::vector<Instant> instantsOf(const Scenario& scenario, const LearnedCamera& camera) {
    std::vector<Instant> instants;
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    for (int tick = 0; tick < 50 * seconds; ++tick) {
        WorldState before = state;
        step(scenario, state, buffers, {}, &trace);
        for (std::uint32_t i = 0; i < robots; ++i)
            for (const Reading& reading : trace.robots[i].observation.readings())
                if (trace.robots[i].observed && reading.name == camera.gives()[0].name &&
                    reading.measured % every >= first && reading.measured % every < last)
                    instants.push_back({before, i, reading.measured});
    }
    return instants;
}

std::size_t subjectsOf(const Scenario& scenario, const LearnedSensor& sensor, const std::vector<Instant>& instants) {
    SensingBuffers buffers;
    std::size_t count = 0;
    for (const Instant& instant : instants) {
        buffers.forget();
        SensorView view{
            scenario.scene(), scenario.obstacles(), scenario.past(), instant.state, instant.robot, buffers, 3};
        view.measured = instant.measured;
        buffers.simulated.look(view, sensor.network().view);
        for (const SimulatedView::Subject& subject : buffers.simulated.subjects()) {
            SensedState state;
            state.subject = subject.kind;
            state.range = subject.range;
            state.bearing = subject.bearing;
            count += sensor.inView(state);
        }
    }
    return count;
}

/// Median time of all instants' looks, s; `reported`: how many bodies.
double timeOf(const Scenario& scenario, const Sensor& sensor, const std::vector<Instant>& instants,
              std::size_t& reported) {
    SensingBuffers buffers;
    Observation out;
    std::vector<std::vector<std::byte>> memories(robots, std::vector<std::byte>(paddedMemory(sensor.memorySize())));
    std::vector<double> times;
    for (int i = 0; i < repetitions; ++i) {
        reported = 0;
        for (std::vector<std::byte>& memory : memories) std::ranges::fill(memory, std::byte{});
        const double begin = bench::processorTime();
        for (int round = 0; round < rounds; ++round)
            for (const Instant& instant : instants) {
                buffers.forget();
                SensorView view{
                    scenario.scene(), scenario.obstacles(), scenario.past(), instant.state, instant.robot, buffers, 3};
                view.measured = instant.measured;
                view.sinceLast = 0.236;
                out.clearReadings();
                sensor.sense(view, std::span(memories[instant.robot]).first(sensor.memorySize()), out);
                for (const Reading& reading : out.readings()) reported += reading.count;
            }
        times.push_back((bench::processorTime() - begin) / rounds);
    }
    return bench::median(times);
}

int measure(const char* file) {
    const auto network = loadSensor(file);
    if (!network) return std::fprintf(stderr, "%s\n", network.error().message().c_str()), 1;
    const auto learned = std::make_shared<const LearnedSensor>(*network);
    const auto camera = std::make_shared<const LearnedCamera>(learned, SensorTraits{"camera"});
    const Scenario scenario = arena(camera);
    const std::vector<Instant> instants = instantsOf(scenario, *camera);
    const std::size_t subjects = subjectsOf(scenario, *learned, instants);
    BodySight sight = *camera->sight();
    sight.bearingNoise = 0.01;
    sight.rangeNoise = 0.03;
    const BodySensor ideal(sight, sight, 1, SensorTraits{"ideal"});
    std::size_t reported = 0, seen = 0;
    const double ours = timeOf(scenario, *camera, instants, reported), peer = timeOf(scenario, ideal, instants, seen);
    const auto looks = static_cast<double>(instants.size()), all = static_cast<double>(subjects);
    std::printf("%zu looks, %.2f subjects in view each, of which %.2f are reported\n", instants.size(), all / looks,
                static_cast<double>(reported) / looks / rounds);
    std::printf("learned camera: %.0f ns a subject in view, %.0f ns a look\n", 1e9 * ours / all, 1e9 * ours / looks);
    std::printf("ideal camera:   %.0f ns a look, at which it sees %.2f robots; the learned one's is %.2f times that\n",
                1e9 * peer / looks, static_cast<double>(seen) / looks / rounds, ours / peer);
    return 0;
}

}  // namespace
}  // namespace mrose

int main(int argc, char** argv) {
    return mrose::measure(argc > 1 ? argv[1] : MROSE_SOURCE_DIR "/nets/create_camera.net");
}
