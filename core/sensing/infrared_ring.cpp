#include "sensing/infrared_ring.h"

#include <algorithm>
#include <numbers>

#include "sensing/range_summary.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_mount.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr int raysOfBeam = 5;  // over the width of a beam

}  // namespace

InfraredRing::InfraredRing(const SensorTraits& traits, const Options& options)
    : ElementSensor(traits, options.latency), reading_(traits.name), options_(options) {
    for (const Pose& element : options.elements)
        farthest_ = std::max(farthest_, length(position(element)) + options.range);
}

std::vector<SensorElement> InfraredRing::elements() const {
    std::vector<SensorElement> elements;
    for (const Pose& element : options_.elements)
        elements.push_back({element, options_.beam / 2, options_.range, options_.reference});
    return elements;
}

std::vector<MemoryEntry> InfraredRing::summary(const Observation& all, const Reading& reading) const {
    return elementSummary(all.records<InfraredEcho>(&reading), options_.elements.size());
}

double InfraredRing::returned(const SensorView& view, const Pose& element) const {
    ConeView& cone = view.buffers.cone;
    cone.look(view.buffers.outlines, element, options_.beam / 2);
    double sum = 0;
    for (int ray = 0; ray < raysOfBeam; ++ray) {
        const ConeView::Hit hit = cone.along(options_.beam * ((ray + 0.5) / raysOfBeam - 0.5));
        if (hit.range > options_.range) continue;
        const double share = options_.reference / std::max(hit.range, 1e-6);
        sum += std::min(1.0, share * share * hit.incidence);
    }
    return sum / raysOfBeam;
}

void InfraredRing::sense(const SensorView& view, std::span<std::byte> /*memory*/, Observation& out) const {
    if (!view.wants(0)) return;
    view.buffers.outlines.find(view, {}, {farthest_});
    const std::size_t count = options_.elements.size();
    std::byte* const place = out.add(reading_, recordType<InfraredEcho>(), view.measured, count);
    auto* const echoes = reinterpret_cast<InfraredEcho*>(place);
    NoisePair noise;
    for (std::size_t i = 0; i < count; ++i) {
        if (options_.noise > 0 && i % 2 == 0) noise = normalPair(view.key(static_cast<std::uint32_t>(i / 2)));
        const double off = options_.noise * (i % 2 == 0 ? noise.first : noise.second);
        const double intensity = returned(view, options_.elements[i]) + options_.ambient + off;
        echoes[i] = {wrapAngle(options_.elements[i].heading), std::clamp(intensity, 0.0, 1.0)};
    }
}

SensorPointer readInfraredRing(TomlTable& table, const SensorTraits& traits, const SensorSources& sources) {
    InfraredRing::Options options;
    options.elements = readElements(table, sources, InfraredRing::mostElements);
    options.beam = angleOr(table, "beam_deg", 10, {0.1, 180});
    options.range = table.number("range_m", {0.001, 10});
    options.reference = table.number("reference_m", {0.001, 10});
    options.ambient = table.numberOr("ambient", 0, {0, 1});
    options.noise = table.numberOr("intensity_noise", 0, {0, 1});
    options.latency = durationOr(table, "latency_s", 0, latencies);
    return table.failed() ? nullptr : std::make_shared<const InfraredRing>(traits, options);
}

}  // namespace mrose
