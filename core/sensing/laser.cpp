#include "sensing/laser.h"

#include <algorithm>
#include <cstring>
#include <numbers>

#include "io/format.h"
#include "sensing/range_summary.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_mount.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr double wholeFan = 2 * std::numbers::pi;

}  // namespace

Laser::Laser(const SensorTraits& traits, const Options& options)
    : ElementSensor(traits, options.latency),
      reading_(traits.name),
      options_(options),
      fan_(-0.5 * static_cast<double>(options.beams - 1) * options.step, options.step, options.beams),
      middle_(options.mount),
      sector_{options.errors.range, std::min(wholeFan, -fan_.direction(0))} {
    middle_.heading += options.first - fan_.direction(0);
    for (std::size_t beam = 0; beam < fan_.size(); ++beam)
        echoes_.push_back({wrapAngle(middle_.heading + fan_.direction(beam)), 0});
}

std::vector<SensorElement> Laser::elements() const {
    std::vector<SensorElement> elements;
    for (std::size_t beam = 0; beam < fan_.size(); ++beam)
        elements.push_back({{middle_.x, middle_.y, middle_.heading + fan_.direction(beam)}, 0, options_.errors.range});
    return elements;
}

std::vector<MemoryEntry> Laser::summary(const Observation& all, const Reading& reading) const {
    return rangeSummary(all.records<RangeEcho>(&reading));
}

void Laser::sense(const SensorView& view, std::span<std::byte> /*memory*/, Observation& out) const {
    if (!view.wants(0)) return;
    Outlines& outlines = view.buffers.outlines;
    outlines.find(view, middle_, sector_);
    view.buffers.ranges.resize(fan_.places());
    fan_.cast(outlines, view.buffers.ranges);
    const std::span<double> ranges = std::span(view.buffers.ranges).first(fan_.size());
    options_.errors.apply(view, 0, ranges);
    std::byte* const place = out.add(reading_, recordType<RangeEcho>(), view.measured, fan_.size());
    std::memcpy(place, echoes_.data(), fan_.size() * sizeof(RangeEcho));
    auto* const echoes = reinterpret_cast<RangeEcho*>(place);
    for (std::size_t beam = 0; beam < fan_.size(); ++beam) echoes[beam].range = ranges[beam];
}

SensorPointer readLaser(TomlTable& table, const SensorTraits& traits, const SensorSources& sources) {
    Laser::Options options;
    options.mount = readMount(table, sources);
    options.beams = static_cast<std::size_t>(table.integer("beams", 1, Laser::mostBeams));
    options.first = angle(table, "start_deg", {-360, 360});
    const double last = angle(table, "end_deg", {-360, 720});
    const double view = last - options.first;
    if (!(view <= wholeFan * (1 + 1e-12)) || view < 0 || (view == 0) != (options.beams == 1))
        table.reject("end_deg", "is " + fixed(view * degrees, 1) +
                                    " degrees from start_deg; expected up to 360, and 0 with a single beam alone");
    if (options.beams > 1) options.step = view / static_cast<double>(options.beams - 1);
    options.errors = readRangeErrors(table, 8, {0.01, 1000});
    options.latency = durationOr(table, "latency_s", 0, latencies);
    return table.failed() ? nullptr : std::make_shared<const Laser>(traits, options);
}

}  // namespace mrose
