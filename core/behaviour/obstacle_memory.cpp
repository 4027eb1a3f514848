#include "behaviour/obstacle_memory.h"

#include <algorithm>
#include <limits>

#include "geometry/point.h"

namespace mrose {
namespace {

constexpr double noEcho = std::numeric_limits<double>::infinity();
constexpr double sameEcho = 0.15;  // m: as far apart may be what two sensors say of one surface
constexpr double leastSpacing = 0.03, spacingPerMetre = 0.03;  // m, of a scan's points, and more of each metre away
constexpr Nanoseconds bumpMemory = 3 * nanosecondsPerSecond;   // what is bumped into, other sensors have missed
constexpr double sameThing = 0.25;                             // m, from echo to echo of a scan
constexpr double smallThing = 0.8;                             // m
constexpr std::size_t leastBeams = 3;

Point placeOf(const ObstacleMemory::Found& found) { return {found.x, found.y}; }

/// An element's cone, up to a range.
struct Cone {
    Placement element;
    double cosine = 1, range = 0;

    bool holds(const Point& place) const {
        const Point seen = element.placeBack(place);
        const double squared = dot(seen, seen);
        return squared <= range * range && seen.x > 0 && seen.x * seen.x >= cosine * cosine * squared;
    }
};

/// The ranges of elements, infinite where there is no echo.
std::vector<double> rangesOf(const Observation& observation, const Reading& reading, const ObstacleSensor& sensor) {
    std::vector<double> ranges;
    for (const RangeEcho& echo : observation.records<RangeEcho>(&reading)) ranges.push_back(echo.range);
    for (const InfraredEcho& echo : observation.records<InfraredEcho>(&reading)) {
        const double intensity = echo.intensity - sensor.ambient;
        ranges.push_back(intensity < sensor.leastIntensity ? noEcho : sensor.reference / std::sqrt(intensity));
    }
    ranges.resize(std::min(ranges.size(), sensor.elements.size()));
    return ranges;
}

}  // namespace

template <class Condition>
void ObstacleMemory::forget(Condition condition) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (condition(points[i], sensors[i])) continue;
        points[kept] = points[i];
        sensors[kept++] = sensors[i];
    }
    count = kept;
}

/// In the place of the oldest where there is no more room.
void ObstacleMemory::add(const Point& point, const Point& velocity, Nanoseconds measured, std::size_t sensor) {
    std::size_t place = count;
    if (place < capacity)
        ++count;
    else
        place = static_cast<std::size_t>(
            std::ranges::min_element(points, {}, [](const Found& found) { return found.measured; }) - points.begin());
    points[place] = {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(velocity.x),
                     static_cast<float>(velocity.y), measured};
    sensors[place] = static_cast<std::uint8_t>(sensor);
}

void ObstacleMemory::takeScan(std::span<const RangeEcho> echoes, const ObstacleSensor& laser, std::size_t sensor,
                              const Pose& robot, Nanoseconds measured, double reach) {
    const std::size_t beams = std::min(echoes.size(), laser.elements.size());
    if (beams == 0) return;
    const Pose &first = laser.elements.front(), &last = laser.elements.back();
    const double step = (last.heading - first.heading) / static_cast<double>(std::max<std::size_t>(1, beams - 1));
    const Pose middle = robot * Pose{first.x, first.y, (first.heading + last.heading) / 2};
    const double halfView = (last.heading - first.heading + step) / 2;
    const Placement view(middle);
    forget([&](const Found& found, std::size_t by) {
        const Point seen = view.placeBack(placeOf(found));
        return by == sensor && std::abs(direction(seen)) <= halfView && length(seen) <= laser.range;
    });
    // From beam to beam by turning: sines of 4096 beams would cost more than all the rest.
    const Placement turn({0, 0, step});
    Point beam = towards(-(last.heading - first.heading) / 2);
    std::vector<Point> places(beams);
    for (std::size_t i = 0; i < beams; ++i, beam = turn.rotate(beam))
        places[i] = view.place(std::min(echoes[i].range, laser.range) * beam);
    tracks.begin(measured);
    for (std::size_t begin = 0, end = 1; begin < beams; begin = end, ++end) {
        while (end < beams && distance(places[end - 1], places[end]) < sameThing) ++end;
        // Something small before all that is beside it may move.
        const auto hides = [&](std::size_t mine, std::size_t beside) {
            return echoes[beside].range > echoes[mine].range + sameThing;
        };
        Point velocity;
        if (begin > 0 && end < beams && end - begin >= leastBeams && echoes[begin].range < laser.range &&
            distance(places[begin], places[end - 1]) < smallThing && hides(begin, begin - 1) && hides(end - 1, end))
            velocity = tracks.take(0.5 * (places[begin] + places[end - 1]), measured);
        Point before{noEcho, noEcho};
        for (std::size_t i = begin; i < end; ++i) {
            const double range = echoes[i].range;
            if (!(range < reach) || distance(places[i], before) < leastSpacing + spacingPerMetre * range) continue;
            add(places[i], velocity, measured, sensor);
            before = places[i];
        }
    }
}

void ObstacleMemory::takeEchoes(std::span<const double> ranges, const ObstacleSensor& ring, std::size_t sensor,
                                const Pose& robot, Nanoseconds measured, double reach) {
    std::array<Cone, 64> cones;
    const std::size_t elements = std::min(ranges.size(), cones.size());
    const double cosine = mrose::cosine(ring.halfWidth);
    for (std::size_t i = 0; i < elements; ++i)
        if (ranges[i] < noEcho) cones[i] = {Placement(robot * ring.elements[i]), cosine, ranges[i] + sameEcho};
    forget([&](const Found& found, std::size_t by) {
        return by == sensor &&
               std::any_of(cones.begin(), cones.begin() + static_cast<std::ptrdiff_t>(elements),
                           [&](const Cone& cone) { return cone.range > 0 && cone.holds(placeOf(found)); });
    });
    const std::size_t others = count;
    for (std::size_t i = 0; i < elements; ++i) {
        if (!(ranges[i] < reach)) continue;
        bool explained = false;
        for (std::size_t k = 0; k < others && !explained; ++k)
            explained = sensors[k] < sensor && cones[i].holds(placeOf(points[k]));
        if (!explained) add(cones[i].element.place({ranges[i], 0}), {}, measured, sensor);
    }
}

void ObstacleMemory::update(const Observation& observation, const MotionMemory& motion,
                            std::span<const ObstacleSensor> known, const Options& options) {
    odometry = odometry * motion.motionSince(observation.time - motion.sinceLast());
    count = std::min<std::uint64_t>(count, capacity);
    forget([&](const Found& found, std::size_t by) {
        if (by >= known.size()) return true;  // of a robot with more sensors, whose memory this was
        const bool bumped = known[by].kind == ObstacleSensor::Kind::bumpers;
        return observation.time - found.measured > (bumped ? bumpMemory : options.memory);
    });
    for (std::size_t sensor = 0; sensor < known.size(); ++sensor)
        for (const Reading& reading : observation.readings()) {
            if (!(reading.name == known[sensor].name)) continue;
            const ObstacleSensor& its = known[sensor];
            const Pose robot = odometry * inverse(motion.motionSince(reading.measured));
            switch (its.kind) {
                case ObstacleSensor::Kind::laser:
                    takeScan(observation.records<RangeEcho>(&reading), its, sensor, robot, reading.measured,
                             options.reach);
                    break;
                case ObstacleSensor::Kind::sonar:
                case ObstacleSensor::Kind::infrared:
                    takeEchoes(rangesOf(observation, reading, its), its, sensor, robot, reading.measured,
                               options.reach);
                    break;
                case ObstacleSensor::Kind::bumpers:
                    for (const BumperContact& contact : observation.records<BumperContact>(&reading))
                        if (contact.pressed != 0)
                            add(Placement(robot).place(its.range * towards(contact.bearing)), {}, reading.measured,
                                sensor);
                    break;
            }
        }
}

}  // namespace mrose
