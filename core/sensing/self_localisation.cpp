#include "sensing/self_localisation.h"

#include "sensing/drift.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

/// The counters of a measurement's draws.
enum Part : std::uint32_t { positionNoise, headings, positionBias, chances, jump };

/// { x_m, y_m, heading_deg }, standard deviations.
Pose deviation(TomlTable table) {
    const Pose pose{table.numberOr("x_m", 0, metresOff), table.numberOr("y_m", 0, metresOff),
                    angleOr(table, "heading_deg", 0, degreesOff)};
    table.rejectUnknown();
    return pose;
}

}  // namespace

bool SelfLocaliser::sound(std::span<const std::byte> memory) const {
    const auto& m = as<Memory>(memory);
    constexpr double farthest = 1e9;
    for (const double number : {m.bias.x, m.bias.y, m.bias.heading, m.self.x, m.self.y, m.self.heading})
        if (!(std::abs(number) <= farthest)) return false;
    return m.measured >= -latestTime && m.measured <= latestTime;
}

void SelfLocaliser::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    const auto& m = as<Memory>(memory);
    if (options_.bias == Pose{}) return;
    entries.add("bias_x", m.bias.x, "m");
    entries.add("bias_y", m.bias.y, "m");
    entries.add("bias_heading", m.bias.heading, "rad");
}

NoiseKey SelfLocaliser::keyOf(const SensorView& view, std::uint32_t part) const {
    return traits_ ? view.key(part) : view.key(NoiseChannel::selfLocalisation, part);
}

void SelfLocaliser::driftBias(const SensorView& view, double heading, Memory& memory) const {
    const Pose& spread = options_.bias;
    if (spread == Pose{}) return;
    const Drift drift(memory.bias != Pose{}, view.sinceLast, options_.biasTime);
    const NoisePair draw = normalPair(keyOf(view, positionBias));
    memory.bias = {drift(memory.bias.x, spread.x, draw.first), drift(memory.bias.y, spread.y, draw.second),
                   drift(memory.bias.heading, spread.heading, heading)};
}

void SelfLocaliser::measure(const SensorView& view, double heading, Memory& memory) const {
    const NoisePair chance =
        options_.dropOut > 0 || options_.jump > 0 ? uniformPair(keyOf(view, chances)) : NoisePair{1, 1};
    if (chance.first < options_.dropOut) return;
    const std::int64_t lag = view.lagOf(options_.latency);
    Pose measured = view.poseBefore(view.robot, lag);
    measured.x += memory.bias.x;
    measured.y += memory.bias.y;
    measured.heading += memory.bias.heading;
    const auto displace = [&](double deviationX, double deviationY, Part part) {
        if (deviationX == 0 && deviationY == 0) return;
        const NoisePair draw = normalPair(keyOf(view, part));
        measured.x += deviationX * draw.first;
        measured.y += deviationY * draw.second;
    };
    displace(options_.noise.x, options_.noise.y, positionNoise);
    if (options_.noise.heading != 0) measured.heading += options_.noise.heading * heading;
    if (chance.second < options_.jump) displace(options_.jumpDistance, options_.jumpDistance, jump);
    memory.self = measured;
    memory.measured = view.timeBefore(lag);
    memory.localised = 1;
}

void SelfLocaliser::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    auto& own = as<Memory>(memory);
    const bool turned = options_.noise.heading != 0 || options_.bias.heading != 0;
    const NoisePair heading = turned ? normalPair(keyOf(view, headings)) : NoisePair{};
    driftBias(view, heading.second, own);
    measure(view, heading.first, own);
    if (view.wants(0) && own.localised != 0) out.add(reading_, own.measured, own.self);
}

SelfLocalisation readSelfLocalisation(TomlTable& table) {
    SelfLocalisation self;
    self.noise = deviation(table.tableOrEmpty("noise"));
    self.bias = deviation(table.tableOrEmpty("bias"));
    self.biasTime = table.numberOr("bias_time_s", self.biasTime, {0.001, 1e6});
    self.latency = durationOr(table, "latency_s", self.latency, latencies);
    self.dropOut = table.numberOr("drop_out", self.dropOut, probability);
    self.jump = table.numberOr("jump", self.jump, probability);
    self.jumpDistance = table.numberOr("jump_distance_m", self.jumpDistance, metresOff);
    return self;
}

}  // namespace mrose
