#include "sensing/bumpers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr double wholeOutline = 2 * std::numbers::pi;

std::span<Bumpers::Memory> segmentsOf(std::span<std::byte> memory) {
    return {reinterpret_cast<Bumpers::Memory*>(memory.data()), memory.size() / sizeof(Bumpers::Memory)};
}

}  // namespace

bool Bumpers::Segment::holds(double bearing) const {
    double beyond = bearing - first;
    beyond -= wholeOutline * std::floor(beyond / wholeOutline);
    return beyond < width;
}

double Bumpers::Segment::middle() const { return wrapAngle(first + width / 2); }

Bumpers::Bumpers(const SensorTraits& traits, std::vector<Segment> segments)
    : traits_(traits), segments_(std::move(segments)) {}

std::vector<SensorElement> Bumpers::elements() const {
    std::vector<SensorElement> elements;
    for (const Segment& segment : segments_) elements.push_back({{0, 0, segment.middle()}, segment.width / 2, 0});
    return elements;
}

std::vector<MemoryEntry> Bumpers::summary(const Observation& all, const Reading& reading) const {
    double pressed = 0, touches = 0;
    std::vector<MemoryEntry> entries{{"pressed"}, {"touches"}};
    const auto contacts = all.records<BumperContact>(&reading);
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const BumperContact contact = i < contacts.size() ? contacts[i] : BumperContact{};
        entries.push_back({"pressed_" + std::to_string(i + 1), static_cast<double>(contact.pressed)});
        pressed += contact.pressed;
        touches += contact.touches;
    }
    entries[0].value = pressed;
    entries[1].value = touches;
    return entries;
}

void Bumpers::start(std::span<std::byte> memory) const { std::ranges::fill(segmentsOf(memory), Memory{}); }

void Bumpers::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    const std::span<Memory> segments = segmentsOf(memory);
    const std::int64_t now = view.state.tick - view.arrivedAgo;
    const std::int64_t before = now - std::max<std::int64_t>(1, view.lagOf(fromSeconds(view.sinceLast)));
    for (const RobotTouch& touch : view.state.touches) {
        if (touch.robot != view.robot || touch.tick <= before || touch.tick > now) continue;
        const double bearing = direction(touch.place_B);
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            if (!segments_[i].holds(bearing)) continue;
            // One that goes on from tick to tick is the same touch.
            if (touch.tick > segments[i].pressed + 1) ++segments[i].touches;
            segments[i].pressed = touch.tick;
        }
    }
    if (!view.wants(0)) return;
    std::byte* const place = out.add(traits_.name, recordType<BumperContact>(), view.timeBefore(0), segments_.size());
    auto* const contacts = reinterpret_cast<BumperContact*>(place);
    for (std::size_t i = 0; i < segments_.size(); ++i)
        contacts[i] = {segments_[i].middle(), segments[i].pressed > before ? 1U : 0U,
                       static_cast<std::uint32_t>(segments[i].touches)};
}

SensorPointer readBumpers(TomlTable& table, const SensorTraits& traits, const SensorSources& /*sources*/) {
    std::vector<Bumpers::Segment> segments;
    table.expectOneOf("ring", "segments", "`ring` or `segments`");
    if (table.has("ring")) {
        TomlTable ring = table.table("ring");
        const std::int64_t count = ring.integer("count", 1, Bumpers::mostSegments);
        const double first = angleOr(ring, "first_deg", 0, {-360, 360});
        ring.rejectUnknown();
        const double width = wholeOutline / static_cast<double>(count);
        for (std::int64_t i = 0; i < count; ++i)
            segments.push_back({first + (static_cast<double>(i) - 0.5) * width, width});
    } else {
        std::vector<TomlTable> tables = table.tablesOrNone("segments");
        if (tables.empty() || tables.size() > Bumpers::mostSegments)
            table.reject("segments", "has " + std::to_string(tables.size()) + "; expected 1 to " +
                                         std::to_string(Bumpers::mostSegments));
        for (TomlTable& one : tables) {
            const double first = angle(one, "start_deg", {-360, 360}), last = angle(one, "end_deg", {-360, 720});
            if (!(last > first) || last > first + wholeOutline * (1 + 1e-12))
                one.reject("end_deg", "expected more than start_deg, by at most 360");
            one.rejectUnknown();
            segments.push_back({first, last - first});
        }
    }
    return table.failed() ? nullptr : std::make_shared<const Bumpers>(traits, std::move(segments));
}

}  // namespace mrose
