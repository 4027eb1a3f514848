#include "sensing/wheel_encoders.h"

#include <cmath>

#include "geometry/pose.h"
#include "sensing/sensor_view.h"

namespace mrose {

WheelEncoders::WheelEncoders(const SensorTraits& traits, const Options& options)
    : traits_(traits), options_(options), poseReading_(traits.name + ".pose") {}

std::vector<ReadingKind> WheelEncoders::gives() const {
    return {{traits_.name, &recordType<WheelTicks>()}, {poseReading_, &recordType<Pose>()}};
}

bool WheelEncoders::sound(std::span<const std::byte> memory) const {
    constexpr double farthest = 1e9;
    const auto& own = as<Memory>(memory);
    for (const double number : {own.last.x, own.last.y, own.last.heading, own.left, own.right, own.reckoned.x,
                                own.reckoned.y, own.reckoned.heading})
        if (!(std::abs(number) <= farthest)) return false;
    return true;
}

void WheelEncoders::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    const auto& own = as<Memory>(memory);
    entries.add("x", own.reckoned.x, "m");
    entries.add("y", own.reckoned.y, "m");
    entries.add("heading", own.reckoned.heading, "rad");
}

WheelTicks WheelEncoders::ticksOf(const Memory& memory) const {
    return {static_cast<std::int64_t>(std::floor(memory.left * options_.ticksPerMetre)),
            static_cast<std::int64_t>(std::floor(memory.right * options_.ticksPerMetre))};
}

void WheelEncoders::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    auto& own = as<Memory>(memory);
    const Pose now = view.poseBefore(view.robot, 0);
    if (own.begun == 0) {
        own.begun = 1;
        own.last = now;
    }
    const Twist moved = log(relative(own.last, now));
    own.last = now;
    const NoisePair slipping = options_.slip > 0 ? normalPair(view.key(0)) : NoisePair{};
    const auto turned = [&](double way, double normal) {
        return way + options_.slip * std::sqrt(std::abs(way)) * normal;
    };
    const WheelTicks before = ticksOf(own);
    own.left += turned(moved.x - 0.5 * options_.track * moved.rotation, slipping.first);
    own.right += turned(moved.x + 0.5 * options_.track * moved.rotation, slipping.second);
    const WheelTicks after = ticksOf(own);
    const double left = static_cast<double>(after.left - before.left) / options_.ticksPerMetre;
    const double right = static_cast<double>(after.right - before.right) / options_.ticksPerMetre;
    own.reckoned = own.reckoned * exp(Twist{0.5 * (left + right), 0, (right - left) / options_.track});
    if (view.wants(0)) out.add(traits_.name, view.timeBefore(0), after);
    if (view.wants(1)) out.add(poseReading_, view.timeBefore(0), own.reckoned);
}

SensorPointer readWheelEncoders(TomlTable& table, const SensorTraits& traits, const SensorSources& /*sources*/) {
    WheelEncoders::Options options;
    options.ticksPerMetre = table.number("ticks_per_m", {1, 1e7});
    options.track = table.number("track_m", {0.001, 20});
    options.slip = table.numberOr("slip_m", 0, {0, 1});
    return table.failed() ? nullptr : std::make_shared<const WheelEncoders>(traits, options);
}

}  // namespace mrose
