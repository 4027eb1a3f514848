#include "sensing/sonar_ring.h"

#include <algorithm>
#include <array>

#include "sensing/range_summary.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_mount.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

/// The counters of a measurement's draws: those of the errors, and from here on those of cross-talk.
constexpr std::uint32_t crossTalkDraws = 0x8000;

}  // namespace

SonarRing::SonarRing(const SensorTraits& traits, const Options& options)
    : ElementSensor(traits, options.latency), reading_(traits.name), options_(options) {
    for (const Pose& sonar : options.sonars)
        farthest_ = std::max(farthest_, length(position(sonar)) + options.errors.range);
}

std::vector<SensorElement> SonarRing::elements() const {
    std::vector<SensorElement> elements;
    for (const Pose& sonar : options_.sonars) elements.push_back({sonar, options_.cone / 2, options_.errors.range});
    return elements;
}

std::vector<MemoryEntry> SonarRing::summary(const Observation& all, const Reading& reading) const {
    return elementSummary(all.records<RangeEcho>(&reading), options_.sonars.size());
}

/// A sonar that hears a neighbour takes its echo for one of its own.
void SonarRing::hearNeighbours(const SensorView& view, std::span<double> ranges) const {
    const std::size_t count = ranges.size();
    if (options_.crossTalk == 0 || count < 2) return;
    std::array<double, mostSonars> own{};
    std::copy(ranges.begin(), ranges.end(), own.begin());
    for (std::size_t i = 0; i < count; ++i)
        if (uniformNoise(view.key(crossTalkDraws + static_cast<std::uint32_t>(i))) < options_.crossTalk)
            ranges[i] = std::min({own[i], own[(i + 1) % count], own[(i + count - 1) % count]});
}

void SonarRing::sense(const SensorView& view, std::span<std::byte> /*memory*/, Observation& out) const {
    if (!view.wants(0)) return;
    Outlines& outlines = view.buffers.outlines;
    outlines.find(view, {}, {farthest_});
    std::vector<double>& ranges = view.buffers.ranges;
    ranges.clear();
    for (const Pose& sonar : options_.sonars) {
        view.buffers.cone.look(outlines, sonar, options_.cone / 2);
        ranges.push_back(view.buffers.cone.nearestEcho(options_.reflection));
    }
    hearNeighbours(view, ranges);
    options_.errors.apply(view, 0, ranges);
    std::byte* const place = out.add(reading_, recordType<RangeEcho>(), view.measured, ranges.size());
    auto* const echoes = reinterpret_cast<RangeEcho*>(place);
    for (std::size_t i = 0; i < ranges.size(); ++i) echoes[i] = {wrapAngle(options_.sonars[i].heading), ranges[i]};
}

SensorPointer readSonarRing(TomlTable& table, const SensorTraits& traits, const SensorSources& sources) {
    SonarRing::Options options;
    options.sonars = readElements(table, sources, SonarRing::mostSonars);
    options.cone = angle(table, "cone_deg", {0.1, 180});
    options.reflection = angleOr(table, "reflection_deg", 90, {1, 90});
    options.crossTalk = table.numberOr("cross_talk", 0, probability);
    options.errors = readRangeErrors(table, 5, {0.01, 100});
    options.latency = durationOr(table, "latency_s", 0, latencies);
    return table.failed() ? nullptr : std::make_shared<const SonarRing>(traits, options);
}

}  // namespace mrose
