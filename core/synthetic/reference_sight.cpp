#include "synthetic/reference_sight.h"

#include <algorithm>
#include <cmath>

#include "geometry/elementary.h"
#include "sensing/sensor_view.h"
#include "sensing/visible_bodies.h"
#include "synthetic/sensor_noise.h"

namespace mrose {
namespace {

enum SightDraw : std::uint32_t { drawRecognition, drawColumn, drawHeight, drawConfusion, sightDraws };

constexpr double leastPixels = 4;  // pixels

}  // namespace

/// Bodies of one kind, and whose draws are whose.
struct ReferenceSight::Bodies : BodyRange {
    NoiseChannel channel;
    bool robots;

    NoiseKey key(const SensorView& view, const SeenBody& body, SightDraw draw) const {
        return view.key(channel, sightDraws * body.index + draw);
    }
    double height(const SensorView& view, const SeenBody& body, const ReferenceSightParameters& parameters) const {
        return robots ? parameters.robotHeight : 2 * view.scene.shapeOf(first + body.index).reach;
    }
};

std::vector<ReadingKind> ReferenceSight::gives() const {
    return {{robotsReading, &recordType<SeenBody>()}, {objectsReading, &recordType<SeenBody>()}};
}

void ReferenceSight::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    entries.add("synthetic", "reference camera");
    entries.add("glare", static_cast<double>(as<Memory>(memory).glare));
}

void ReferenceSight::see(const SensorView& view, const BodySight& sight, const Bodies& bodies,
                         std::vector<SeenBody>& seen) const {
    visibleBodies(view, sight, bodies, seen);
    const double half = sight.fieldOfView / 2;
    std::erase_if(seen, [&](SeenBody& body) {
        const double range = length(body.position_B);
        const double bearing = wrapAngle(direction(body.position_B) - sight.direction);
        if (bearing > p_.blindFrom && bearing < p_.blindTo) return true;
        const double far = (range - p_.halfSeen) / p_.halfSeenWidth;
        if (uniformNoise(bodies.key(view, body, drawRecognition)) >= 1 / (1 + exponential(far))) return true;
        const NoisePair chance = uniformPair(bodies.key(view, body, drawConfusion));
        double reportedRange = p_.nearest + chance.second * (p_.farthest - p_.nearest);
        double reportedBearing = half * (2 * chance.first / p_.confused - 1);
        if (chance.first >= p_.confused) {
            const double share = bearing / half;
            const double at = p_.pixelsPerRadian * bearing + p_.lens * share * share * share +
                              p_.columnNoise * laplaceNoise(bodies.key(view, body, drawColumn));
            const double high = p_.pixelsPerRadian * bodies.height(view, body, p_);
            const double seenHigh = (1 + p_.blooming) * high / std::max(range, 0.3) +
                                    p_.heightNoise * laplaceNoise(bodies.key(view, body, drawHeight));
            const double inPicture = p_.column * nearestWhole(at / p_.column) / p_.pixelsPerRadian;
            const double byHeight = high / std::max(nearestWhole(seenHigh), leastPixels);
            reportedBearing = bearing + scale_ * (inPicture - bearing);
            reportedRange = std::max(0.0, range + scale_ * (byHeight - std::max(range, 0.3)));
        }
        body.position_B = reportedRange * towards(sight.direction + reportedBearing);
        return false;
    });
}

void ReferenceSight::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    std::uint64_t& glare = as<Memory>(memory).glare;
    const double chance = uniformNoise(view.key(NoiseChannel::bearingBias, 0));
    const double lasts = decay(view.sinceLast / p_.burstLength), begins = view.sinceLast * p_.burstRate;
    glare = chance < (glare != 0 ? lasts : begins) ? 1 : 0;
    const std::size_t robots = view.state.robots.size(), objects = view.state.objects.size();
    const auto give = [&](std::size_t reading, const BodySight& sight, const ReadingName& name, const Bodies& bodies) {
        if (!view.wants(reading)) return;
        std::vector<SeenBody>& seen = view.buffers.seen;
        seen.clear();
        if (sight.present && glare == 0 && bodies.count > 0) see(view, sight, bodies, seen);
        out.add(name, view.timeBefore(view.lagOf(sight.latency)), std::span<const SeenBody>(seen));
    };
    give(0, robots_, robotsReading, {{0, robots}, NoiseChannel::sightOfRobots, true});
    give(1, objects_, objectsReading, {{robots, objects}, NoiseChannel::sightOfObjects, false});
}

}  // namespace mrose
