#include "sensing/body_sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/elementary.h"
#include "sensing/drift.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_view.h"
#include "sensing/visible_bodies.h"

namespace mrose {
namespace {

/// Bodies of one kind by their numbers in the world.
struct Kind : BodyRange {
    NoiseChannel channel;
    std::uint32_t of;  ///< tells kinds of bodies apart where sensors share a channel

    /// For a draw of the two that belong to a body. Each body has draws of its own, so that no other one changes what
    /// is seen of it.
    NoiseKey key(const SensorView& view, std::uint32_t body, std::uint32_t draw) const {
        return channel == NoiseChannel::sensor ? view.key(4 * body + of + draw + 2)
                                               : view.key(channel, 2 * body + draw);
    }
};

constexpr double wholeTurn = 2 * std::numbers::pi;

void addNoise(const SensorView& view, const BodySight& sight, const Kind& kind, double bearingBias, SeenBody& body) {
    const bool noisy = sight.bearingNoise != 0 || sight.rangeNoise != 0 || sight.rangeNoiseSlope != 0;
    const NoisePair draw = noisy ? normalPair(kind.key(view, body.index, 0)) : NoisePair{};
    const double share = sight.rangeNoise + sight.rangeNoiseSlope * length(body.position_B);
    const double bearing = sight.bearingBias * bearingBias + sight.bearingNoise * draw.first;
    const double range = std::max(0.0, 1 + share * draw.second), turns = bearing / wholeTurn;
    const double c = range * cosTurns(turns), s = range * sinTurns(turns);
    body.position_B = {c * body.position_B.x - s * body.position_B.y, s * body.position_B.x + c * body.position_B.y};
}

void see(const SensorView& view, const BodySight& sight, const Kind& kind, double bearingBias,
         std::vector<SeenBody>& seen) {
    if (kind.count == 0) return;
    visibleBodies(view, sight, kind, seen);
    if (sight.dropOut > 0)
        std::erase_if(
            seen, [&](const SeenBody& body) { return uniformNoise(kind.key(view, body.index, 1)) < sight.dropOut; });
    if (sight.bearingNoise == 0 && sight.rangeNoise == 0 && sight.rangeNoiseSlope == 0 && sight.bearingBias == 0)
        return;
    for (SeenBody& body : seen) addNoise(view, sight, kind, bearingBias, body);
}

}  // namespace

BodySensor::BodySensor(const BodySight& robots, const BodySight& objects, double biasTime,
                       std::optional<SensorTraits> traits)
    : robots_(robots),
      objects_(objects),
      biasTime_(biasTime),
      traits_(std::move(traits)),
      robotsReading_(traits_ ? ReadingName(traits_->name + ".robots") : robotsReading),
      objectsReading_(traits_ ? ReadingName(traits_->name + ".objects") : objectsReading) {}

std::vector<ReadingKind> BodySensor::gives() const {
    return {{robotsReading_, &recordType<SeenBody>()}, {objectsReading_, &recordType<SeenBody>()}};
}

bool BodySensor::sound(std::span<const std::byte> memory) const {
    return std::abs(as<Memory>(memory).bearingBias) <= 1e9;
}

void BodySensor::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    if (robots_.bearingBias == 0 && objects_.bearingBias == 0) return;
    const double bias = as<Memory>(memory).bearingBias;
    entries.add("robots_bearing_bias", robots_.bearingBias * bias, "rad");
    entries.add("objects_bearing_bias", objects_.bearingBias * bias, "rad");
}

void BodySensor::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    double& bias = as<Memory>(memory).bearingBias;
    if (objects_.bearingBias != 0 || robots_.bearingBias != 0)
        bias = Drift(bias != 0, view.sinceLast, biasTime_)(
            bias, 1, normalNoise(traits_ ? view.key(1) : view.key(NoiseChannel::bearingBias, 0)));
    const std::size_t robots = view.state.robots.size(), objects = view.state.objects.size();
    const auto give = [&](std::size_t reading, const BodySight& sight, const ReadingName& name, Kind kind) {
        if (!view.wants(reading)) return;
        if (traits_) kind.channel = NoiseChannel::sensor;
        std::vector<SeenBody>& seen = view.buffers.seen;
        seen.clear();
        if (sight.present) see(view, sight, kind, bias, seen);
        out.add(name, view.timeBefore(view.lagOf(sight.latency)), std::span<const SeenBody>(seen));
    };
    give(0, robots_, robotsReading_, {{0, robots}, NoiseChannel::sightOfRobots, 0});
    give(1, objects_, objectsReading_, {{robots, objects}, NoiseChannel::sightOfObjects, 2});
}

BodySight readSightField(TomlTable& table) {
    BodySight sight;
    sight.present = table.booleanOr("present", sight.present);
    sight.fieldOfView = angleOr(table, "field_of_view_deg", sight.fieldOfView, {1, 360});
    sight.direction = angleOr(table, "direction_deg", sight.direction, {-180, 180});
    sight.range = table.numberOr("range_m", sight.range, {0, 10000});
    sight.latency = durationOr(table, "latency_s", sight.latency, latencies);
    sight.occlusion = table.booleanOr("occlusion", sight.occlusion);
    return sight;
}

BodySight readBodySight(TomlTable& table) {
    BodySight sight = readSightField(table);
    sight.bearingNoise = angleOr(table, "bearing_noise_deg", 0, degreesOff);
    sight.rangeNoise = table.numberOr("range_noise", sight.rangeNoise, {0, 10});
    sight.rangeNoiseSlope = table.numberOr("range_noise_per_m", sight.rangeNoiseSlope, {0, 10});
    sight.bearingBias = angleOr(table, "bearing_bias_deg", 0, degreesOff);
    sight.dropOut = table.numberOr("drop_out", sight.dropOut, probability);
    return sight;
}

}  // namespace mrose
