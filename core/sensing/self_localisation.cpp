#include "sensing/self_localisation.h"

#include <cmath>

#include "motion/portable_math.h"

namespace mrose {
namespace {

constexpr NoiseChannel channel = NoiseChannel::selfLocalisation;

/// The counters of a period's draws.
enum Part : std::uint32_t { positionNoise, headings, positionBias, chances, jump };

/// What is left of a bias after a period, and what the period adds, in standard deviations.
struct Drift {
    double kept = 0, added = 1;

    double operator()(double bias, double deviation, double draw) const {
        return kept * bias + added * deviation * draw;
    }
};

/// A bias of exactly zero has not begun: no draw leads there.
Drift driftOf(const Observer& observer, bool begun) {
    if (!begun) return {};
    const double kept = decay(observer.scenario.periodOf(observer.robot).seconds / observer.perception().self.biasTime);
    return {kept, std::sqrt(1 - kept * kept)};
}

}  // namespace

void driftBiases(const Observer& observer, SensorMemory& memory) {
    const Perception& perception = observer.perception();
    const Pose& deviation = perception.self.bias;
    if (deviation != Pose{}) {
        const Drift drift = driftOf(observer, memory.bias != Pose{});
        const NoisePair position = normalPair(observer.key(channel, positionBias));
        const double heading = deviation.heading == 0 ? 0 : normalPair(observer.key(channel, headings)).second;
        memory.bias = {drift(memory.bias.x, deviation.x, position.first),
                       drift(memory.bias.y, deviation.y, position.second),
                       drift(memory.bias.heading, deviation.heading, heading)};
    }
    if (perception.objects.bearingBias != 0 || perception.robots.bearingBias != 0)
        memory.bearingBias = driftOf(observer, memory.bearingBias != 0)(
            memory.bearingBias, 1, normalNoise(observer.key(NoiseChannel::bearingBias)));
}

void localise(const Observer& observer, SensorMemory& memory) {
    const SelfLocalisation& sensor = observer.perception().self;
    const NoisePair chance =
        sensor.dropOut > 0 || sensor.jump > 0 ? uniformPair(observer.key(channel, chances)) : NoisePair{1, 1};
    if (chance.first < sensor.dropOut) return;
    const std::int64_t lag = observer.lagOf(sensor.latency);
    Pose measured = observer.poseBefore(observer.robot, lag);
    measured.x += memory.bias.x;
    measured.y += memory.bias.y;
    measured.heading += memory.bias.heading;
    const auto displace = [&](double deviationX, double deviationY, Part part) {
        if (deviationX == 0 && deviationY == 0) return;
        const NoisePair draw = normalPair(observer.key(channel, part));
        measured.x += deviationX * draw.first;
        measured.y += deviationY * draw.second;
    };
    displace(sensor.noise.x, sensor.noise.y, positionNoise);
    if (sensor.noise.heading != 0)
        measured.heading += sensor.noise.heading * normalPair(observer.key(channel, headings)).first;
    if (chance.second < sensor.jump) displace(sensor.jumpDistance, sensor.jumpDistance, jump);
    memory.self = measured;
    memory.selfMeasured = observer.timeBefore(lag);
    memory.localised = 1;
}

}  // namespace mrose
