#include "sensing/body_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "geometry/elementary.h"
#include "sensing/drift.h"
#include "sensing/line_of_sight.h"
#include "sensing/sector_box.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

/// Bodies of one kind by their numbers in the world.
struct Kind {
    std::size_t first, count;
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

/// The part of the plane that a camera covers.
struct Field {
    Placement frame;
    double range, farthest;  ///< m, m2; 0 without end
    bool allRound;
    double edge;  ///< cosine of half the field of view

    Field(const Placement& eye, const BodySight& sight)
        : frame(eye),
          range(sight.range),
          farthest(range * range),
          allRound(sight.fieldOfView >= wholeTurn),
          edge(allRound ? -1 : cosTurns(sight.fieldOfView / (2 * wholeTurn))) {}

    /// The point as it is seen, in the camera's own frame, or nothing.
    std::optional<Point> at(const Point& point) const {
        const Point offset = point - frame.origin;
        if (range > 0 && dot(offset, offset) > farthest) return std::nullopt;
        const Point position = frame.rotateBack(offset);
        if (!allRound && position.x < edge * length(position)) return std::nullopt;
        return position;
    }

    /// Direction of its left edge, in its own frame.
    Point edge_B() const { return {edge, std::sqrt(std::max(0.0, 1 - edge * edge))}; }
    SightField whole() const {
        return {frame.origin, frame.rotate({edge, -edge_B().y}), frame.rotate(edge_B()), allRound,
                range > 0 ? range : std::numeric_limits<double>::infinity()};
    }

    /// Two corners of a box that holds a view whose range has an end.
    std::pair<Point, Point> box() const { return boxOfSector(frame, edge, edge_B().y, range, 0); }
};

// So few are looked at one by one; with more of them in reach it pays to keep track of what is hidden.
constexpr std::size_t fewBodies = 64;

/// Those that are seen, exactly but for noise.
void collect(const SensorView& view, const BodySight& sight, const Kind& kind, std::vector<SeenBody>& seen) {
    const BodyMap& map = view.bodiesBefore(view.lagOf(sight.latency));
    Pose eye = view.past.poseBefore(view.state, view.robot, map.lag);
    eye.heading += sight.direction;
    const Field field(Placement(eye), sight);
    const Placement direction({0, 0, sight.direction});  // in the robot's frame
    const Nanoseconds measured = view.scene.timeOf(view.state.tick - map.lag);
    const double widest = sight.occlusion ? view.scene.widestReach() : 0;
    const auto look = [&](const PointGrid::Entry& entry, auto hitsBody) {
        const std::size_t index = entry.number - kind.first;
        if (index >= kind.count || entry.number == view.robot) return;
        const std::optional<Point> position = field.at(entry.point);
        if (!position) return;
        if (sight.occlusion) {
            const SightLine line(view, map, entry.number, widest);
            if (hitsBody(line) || line.hitsObstacle()) return;
        }
        if (sight.dropOut > 0 && uniformNoise(kind.key(view, index, 1)) < sight.dropOut) return;
        const Point position_B = sight.direction == 0 ? *position : direction.rotate(*position);
        seen.push_back({static_cast<std::uint32_t>(index), position_B, measured});
    };
    const auto lookAt = [&](const PointGrid::Entry& entry) {
        look(entry, [&](const SightLine& line) { return line.hitsBody(); });
    };
    const bool limited = field.range > 0, ends = sight.occlusion || !field.allRound;
    if (kind.count <= fewBodies || !(limited || ends)) {
        for (std::size_t body = kind.first; body < kind.first + kind.count; ++body)
            lookAt({map.positions[body], static_cast<std::uint32_t>(body)});
        return;
    }
    const auto [least, most] = field.box();
    std::size_t near = 0;
    map.grid.visitBox(least, most, [&](std::span<const PointGrid::Entry> entries) { near += entries.size(); });
    if (ends && (!limited || near > fewBodies)) {
        Outlook& outlook = view.buffers.outlook;
        outlook.look(view, map, field.whole(), sight.occlusion);
        for (const Outlook::Body& body : outlook.found())
            look(body.entry, [&](const SightLine& line) {
                return outlook.anyBefore(body, [&](std::uint32_t other) { return line.hits(other); });
            });
    } else {
        map.grid.visitBox(least, most, [&](std::span<const PointGrid::Entry> entries) {
            for (const PointGrid::Entry& entry : entries) lookAt(entry);
        });
    }
    std::sort(seen.begin(), seen.end(), [](const SeenBody& a, const SeenBody& b) { return a.index < b.index; });
}

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
    collect(view, sight, kind, seen);
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

std::vector<MemoryEntry> BodySensor::explain(std::span<const std::byte> memory) const {
    if (robots_.bearingBias == 0 && objects_.bearingBias == 0) return {};
    const double bias = as<Memory>(memory).bearingBias;
    return {{"robots_bearing_bias", robots_.bearingBias * bias, "rad"},
            {"objects_bearing_bias", objects_.bearingBias * bias, "rad"}};
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
    give(0, robots_, robotsReading_, {0, robots, NoiseChannel::sightOfRobots, 0});
    give(1, objects_, objectsReading_, {robots, objects, NoiseChannel::sightOfObjects, 2});
}

BodySight readBodySight(TomlTable& table) {
    BodySight sight;
    sight.present = table.booleanOr("present", sight.present);
    sight.bearingNoise = angleOr(table, "bearing_noise_deg", 0, degreesOff);
    sight.rangeNoise = table.numberOr("range_noise", sight.rangeNoise, {0, 10});
    sight.rangeNoiseSlope = table.numberOr("range_noise_per_m", sight.rangeNoiseSlope, {0, 10});
    sight.bearingBias = angleOr(table, "bearing_bias_deg", 0, degreesOff);
    sight.fieldOfView = angleOr(table, "field_of_view_deg", sight.fieldOfView, {1, 360});
    sight.direction = angleOr(table, "direction_deg", sight.direction, {-180, 180});
    sight.range = table.numberOr("range_m", sight.range, {0, 10000});
    sight.latency = durationOr(table, "latency_s", sight.latency, latencies);
    sight.dropOut = table.numberOr("drop_out", sight.dropOut, probability);
    sight.occlusion = table.booleanOr("occlusion", sight.occlusion);
    return sight;
}

}  // namespace mrose
