#include "sensing/line_camera.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "geometry/normal_distribution.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_mount.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr double wholeView = 2 * std::numbers::pi * (1 - 1e-12);
constexpr double farthestDraw = 6.5;      // standard deviations: no drawnNormal is farther
constexpr std::size_t pixelsOfDraws = 8;  // the numbers of a key

BeamFan fanOfPixels(const LineCamera::Options& options) {
    const double half = options.spacing == BeamFan::Spacing::angles ? options.view / 2 : tangent(options.view / 2);
    const double step = 2 * half / static_cast<double>(options.width);
    return {step / 2 - half, step, options.width, options.spacing};
}

/// The class of an outline's owner, for a robot that looks at it.
ColourClass classOf(const Scene& scene, std::uint32_t owner, std::uint32_t looking) {
    if (owner >= scene.bodyCount()) return scene.environment.obstacles[owner - scene.bodyCount()].colourClass;
    if (owner >= scene.robots.size())
        return scene.typeOfObject(owner - scene.robots.size()).rolls ? ColourClass::ball : ColourClass::box;
    if (scene.typeOf(owner).person) return ColourClass::person;
    const std::string &its = scene.robots[owner].team, &own = scene.robots[looking].team;
    if (its.empty() || own.empty()) return ColourClass::robot;
    return its == own ? ColourClass::teamMate : ColourClass::opponent;
}

/// visit(first, count) for each run of pixels of one class; of a row that is a circle across its ends as well.
template <class Visit>
void visitRuns(std::span<const ColourPixel> row, bool circle, Visit visit) {
    const std::size_t size = row.size();
    const auto begins = [&](std::size_t pixel) {
        return row[pixel].colourClass != row[(pixel + size - 1) % size].colourClass;
    };
    std::size_t first = 0;
    if (circle)
        while (first < size && !begins(first)) ++first;
    if (first == size) first = 0;  // all of one class
    std::size_t count = 0;
    for (std::size_t done = 0; done < size; done += count) {
        const std::size_t at = (first + done) % size;
        for (count = 1; done + count < size && !begins((at + count) % size);) ++count;
        visit(at, count);
    }
}

}  // namespace

LineCamera::LineCamera(const SensorTraits& traits, const Options& options)
    : ElementSensor(traits, options.latency),
      pixels_(traits.name),
      blobs_(traits.name + ".blobs"),
      options_(options),
      fan_(fanOfPixels(options)),
      sector_{options.range, options.view / 2 + farthestDraw * options.edgeNoise * fan_.step()} {
    for (std::size_t pixel = 0; pixel < fan_.size(); ++pixel)
        row_.push_back({wrapAngle(options.mount.heading + fan_.direction(pixel))});
}

std::vector<SensorElement> LineCamera::elements() const {
    const Pose& mount = options_.mount;
    std::vector<SensorElement> elements;
    for (std::size_t pixel = 0; pixel < fan_.size(); ++pixel)
        elements.push_back({{mount.x, mount.y, mount.heading + fan_.direction(pixel)},
                            0,
                            std::min(options_.range, floorRange(fan_.towards(pixel)))});
    return elements;
}

std::vector<MemoryEntry> LineCamera::summary(const Observation& all, const Reading& reading) const {
    std::vector<ColourBlob> blobs;
    const auto row = all.records<ColourPixel>(&reading);
    if (row.size() == row_.size()) findBlobs(row, blobs);
    std::vector<MemoryEntry> entries;
    for (const ColourClass of : options_.blobClasses) {
        ColourBlob largest;
        for (const ColourBlob& blob : blobs)
            if (blob.colourClass == of && blob.pixels > largest.pixels) largest = blob;
        const std::string name(wordOf(of));
        entries.push_back({name + "_bearing", largest.bearing, "rad"});
        entries.push_back({name + "_pixels", static_cast<double>(largest.pixels)});
    }
    return entries;
}

double LineCamera::floorRange(const Point& along) const {
    if (options_.floor == 0) return std::numeric_limits<double>::infinity();
    return options_.spacing == BeamFan::Spacing::angles ? options_.floor : options_.floor / along.x;
}

const BeamFan& LineCamera::noisyFan(const SensorView& view) const {
    if (options_.edgeNoise == 0) return fan_;
    BeamFan& fan = view.buffers.fan;
    fan = fan_;
    for (std::size_t begin = 0; begin < fan.size(); begin += pixelsOfDraws) {
        const UniformDraws u(view.key(static_cast<std::uint32_t>(2 * (begin / pixelsOfDraws))));
        const auto normal = drawnNormals(std::array{u[0], u[1], u[2], u[3], u[4], u[5], u[6], u[7]});
        for (std::size_t i = 0; i < std::min(pixelsOfDraws, fan.size() - begin); ++i)
            fan.turn(begin + i, options_.edgeNoise * normal[i]);
    }
    return fan;
}

void LineCamera::look(const SensorView& view, std::span<ColourPixel> row) const {
    SensingBuffers& buffers = view.buffers;
    const BeamFan& fan = noisyFan(view);
    buffers.outlines.find(view, options_.mount, sector_);
    buffers.ranges.resize(fan.places());
    buffers.owners.resize(fan.places());
    fan.cast(buffers.outlines, buffers.ranges, buffers.owners);
    if (options_.floor > 0)
        buffers.floorLines.find(view.scene.environment, buffers.outlines.frame(), options_.floor,
                                options_.spacing == BeamFan::Spacing::angles ? options_.floor : options_.range);
    for (std::size_t pixel = 0; pixel < row.size(); ++pixel) {
        const Point along = fan.towards(pixel);
        const double floor = floorRange(along), range = buffers.ranges[pixel];
        if (std::min(range, floor) > options_.range) continue;
        if (range <= floor)
            row[pixel].colourClass = classOf(view.scene, buffers.owners[pixel], view.robot);
        else
            row[pixel].colourClass = buffers.floorLines.hold(floor * along) ? ColourClass::marking : ColourClass::floor;
    }
}

void LineCamera::misclassify(const SensorView& view, std::span<ColourPixel> row) const {
    constexpr auto others = static_cast<std::uint32_t>(colourClassWords.size() - 1);
    for (std::size_t begin = 0; begin < row.size() && options_.misclassification > 0; begin += pixelsOfDraws) {
        const UniformDraws u(view.key(static_cast<std::uint32_t>(2 * (begin / pixelsOfDraws) + 1)));
        for (std::size_t i = 0; i < std::min(pixelsOfDraws, row.size() - begin); ++i) {
            if (!(u[i] < options_.misclassification)) continue;
            ColourClass& its = row[begin + i].colourClass;
            const auto other = static_cast<std::uint32_t>(u[i] / options_.misclassification * others);
            its = static_cast<ColourClass>(other < static_cast<std::uint32_t>(its) ? other : other + 1);
        }
    }
}

ColourBlob LineCamera::blobOf(ColourClass colourClass, std::size_t first, std::size_t count) const {
    const double right = fan_.directionAt(static_cast<double>(first) - 0.5);
    const double left = fan_.directionAt(static_cast<double>(first + count) - 0.5);
    return {wrapAngle(options_.mount.heading + (right + left) / 2), left - right, colourClass,
            static_cast<std::uint32_t>(count)};
}

void LineCamera::findBlobs(std::span<const ColourPixel> row, std::vector<ColourBlob>& blobs) const {
    blobs.clear();
    visitRuns(row, options_.view >= wholeView, [&](std::size_t first, std::size_t count) {
        const ColourClass its = row[first].colourClass;
        const bool wanted = std::ranges::find(options_.blobClasses, its) != options_.blobClasses.end();
        if (wanted && count >= options_.leastBlob) blobs.push_back(blobOf(its, first, count));
    });
}

void LineCamera::sense(const SensorView& view, std::span<std::byte> /*memory*/, Observation& out) const {
    if (!view.wants(0) && !view.wants(1)) return;
    std::vector<ColourPixel>& row = view.buffers.row;
    row = row_;
    look(view, row);
    misclassify(view, row);
    if (view.wants(0)) out.add<ColourPixel>(pixels_, view.measured, std::span<const ColourPixel>(row));
    if (!view.wants(1)) return;
    findBlobs(row, view.buffers.blobs);
    out.add<ColourBlob>(blobs_, view.measured, std::span<const ColourBlob>(view.buffers.blobs));
}

namespace {

/// All but nothing may be asked for; unless said, all but the floor are.
std::vector<ColourClass> readBlobClasses(TomlTable& table) {
    constexpr std::span seen = std::span(colourClassWords).subspan(1);
    std::vector<std::size_t> chosen;
    if (table.has("blobs"))
        chosen = table.someChoices("blobs", seen);
    else
        for (std::size_t i = 1; i < seen.size(); ++i) chosen.push_back(i);
    std::vector<ColourClass> classes;
    for (const std::size_t i : chosen) classes.push_back(static_cast<ColourClass>(1 + i));
    return classes;
}

}  // namespace

SensorPointer readLineCamera(TomlTable& table, const SensorTraits& traits, const SensorSources& sources) {
    using Spacing = BeamFan::Spacing;
    LineCamera::Options options;
    options.mount = readMount(table, sources);
    options.width = static_cast<std::size_t>(table.integer("width", 1, LineCamera::mostPixels));
    const bool equiangular = table.has("lens") && table.choice("lens", {"pinhole", "equiangular"}) == 1;
    options.spacing = equiangular ? Spacing::angles : Spacing::tangents;
    options.view = angle(table, "view_deg", {0.1, equiangular ? 360.0 : 170.0});
    options.range = table.number("range_m", {0.01, 1000});
    if (table.has("floor_m")) options.floor = table.number("floor_m", {0.01, options.range});
    options.edgeNoise = table.numberOr("edge_noise_px", 0, {0, 10});
    options.misclassification = table.numberOr("misclassification", 0, probability);
    options.blobClasses = readBlobClasses(table);
    options.leastBlob = static_cast<std::size_t>(table.integerOr("least_blob_px", 1, 1, LineCamera::mostPixels));
    options.latency = durationOr(table, "latency_s", 0, latencies);
    return table.failed() ? nullptr : std::make_shared<const LineCamera>(traits, options);
}

}  // namespace mrose
