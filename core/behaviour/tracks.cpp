#include "behaviour/tracks.h"

#include <algorithm>

namespace mrose {
namespace {

constexpr Nanoseconds lostAfter = nanosecondsPerSecond / 2;
constexpr double placeGain = 0.6, velocityGain = 0.3;
constexpr double farthestStep = 0.4;  // m, off where a track leads
constexpr double hardlyMoves = 0.2;   // m/s: as much comes from seeing another part of it
constexpr double fastestTrack = 2;    // m/s

}  // namespace

void Tracks::begin(Nanoseconds now) {
    const auto first = tracks.begin(), last = first + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(count, most));
    const auto kept = std::remove_if(first, last, [&](const Track& track) { return now - track.seen > lostAfter; });
    count = static_cast<std::uint64_t>(kept - first);
}

Point Tracks::take(const Point& place, Nanoseconds seen) {
    Track* nearest = nullptr;
    double least = farthestStep;
    for (std::size_t i = 0; i < count; ++i) {
        Track& track = tracks[i];
        const double off = distance(track.place + toSeconds(seen - track.seen) * track.velocity, place);
        if (track.seen >= seen || off >= least) continue;
        least = off;
        nearest = &track;
    }
    if (nearest == nullptr) {
        if (count < most) tracks[count++] = {place, {}, seen};
        return {};
    }
    const double since = toSeconds(seen - nearest->seen);
    const Point foreseen = nearest->place + since * nearest->velocity, off = place - foreseen;
    nearest->place = foreseen + placeGain * off;
    nearest->velocity = nearest->velocity + (velocityGain / since) * off;
    nearest->seen = seen;
    const double speed = length(nearest->velocity);
    return speed < hardlyMoves ? Point{} : std::min(1.0, fastestTrack / speed) * nearest->velocity;
}

}  // namespace mrose
