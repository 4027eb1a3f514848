#include "sensing/body_sight.h"

#include <algorithm>
#include <numbers>

#include "motion/portable_math.h"
#include "sensing/line_of_sight.h"

namespace mrose {
namespace {

/// Bodies of one kind by their numbers in the world.
struct Kind {
    std::size_t first, count;
    NoiseChannel channel;
};

constexpr double wholeTurn = 2 * std::numbers::pi;

/// Those within range and field of view, exactly.
void collect(const Observer& observer, const BodySight& sight, const Kind& kind, std::vector<SeenBody>& seen) {
    const std::int64_t lag = observer.lagOf(sight.latency);
    const Nanoseconds measured = observer.timeBefore(lag);
    const Placement frame(observer.poseBefore(observer.robot, lag));
    const double farthest = sight.range * sight.range;
    const bool allRound = sight.fieldOfView >= wholeTurn;
    const double edge = allRound ? -1 : cosTurns(sight.fieldOfView / (2 * wholeTurn));
    for (std::size_t i = 0; i < kind.count; ++i) {
        if (kind.first + i == observer.robot) continue;
        const Point offset = position(observer.poseBefore(kind.first + i, lag)) - frame.origin;
        if (sight.range > 0 && dot(offset, offset) > farthest) continue;
        const Point position_B = frame.rotateBack(offset);
        if (!allRound && position_B.x < edge * length(position_B)) continue;
        seen.push_back({static_cast<std::uint32_t>(i), position_B, measured});
    }
}

/// Each body has draws of its own, so that no other one changes what is seen of it.
void addNoise(const Observer& observer, const BodySight& sight, NoiseChannel channel, double bearingBias,
              SeenBody& body) {
    const bool noisy = sight.bearingNoise != 0 || sight.rangeNoise != 0 || sight.rangeNoiseSlope != 0;
    const NoisePair draw = noisy ? normalPair(observer.key(channel, 2 * body.index)) : NoisePair{};
    const double share = sight.rangeNoise + sight.rangeNoiseSlope * length(body.position_B);
    const double bearing = sight.bearingBias * bearingBias + sight.bearingNoise * draw.first;
    const double range = std::max(0.0, 1 + share * draw.second), turns = bearing / wholeTurn;
    const double c = range * cosTurns(turns), s = range * sinTurns(turns);
    body.position_B = {c * body.position_B.x - s * body.position_B.y, s * body.position_B.x + c * body.position_B.y};
}

void see(const Observer& observer, const BodySight& sight, const Kind& kind, double bearingBias,
         std::vector<SeenBody>& seen) {
    seen.clear();
    if (!sight.present) return;
    collect(observer, sight, kind, seen);
    if (sight.dropOut > 0)
        std::erase_if(seen, [&](const SeenBody& body) {
            return uniformNoise(observer.key(kind.channel, 2 * body.index + 1)) < sight.dropOut;
        });
    if (sight.occlusion) removeHidden(observer, observer.lagOf(sight.latency), kind.first, seen);
    if (sight.bearingNoise == 0 && sight.rangeNoise == 0 && sight.rangeNoiseSlope == 0 && sight.bearingBias == 0)
        return;
    for (SeenBody& body : seen) addNoise(observer, sight, kind.channel, bearingBias, body);
}

}  // namespace

void seeRobots(const Observer& observer, double bearingBias, std::vector<SeenBody>& seen) {
    see(observer, observer.perception().robots, {0, observer.state.robots.size(), NoiseChannel::sightOfRobots},
        bearingBias, seen);
}

void seeObjects(const Observer& observer, double bearingBias, std::vector<SeenBody>& seen) {
    see(observer, observer.perception().objects,
        {observer.state.robots.size(), observer.state.objects.size(), NoiseChannel::sightOfObjects}, bearingBias, seen);
}

}  // namespace mrose
