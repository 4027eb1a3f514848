#include "sensing/learned_localiser.h"

#include <cassert>
#include <cmath>

#include "geometry/point.h"
#include "sensing/own_velocity.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

/// The counters of a look's draws: one for each channel's numbers, and which component it is.
enum LookDraw : std::uint32_t { channelNumbers = 0, whichComponent = readingChannels };

}  // namespace

LearnedLocaliser::LearnedLocaliser(std::shared_ptr<const LearnedSensor> learned, const SensorTraits& traits,
                                   const Options& options)
    : learned_(std::move(learned)),
      traits_(traits),
      latency_(options.latency.value_or(learned_->network().latency)),
      reach_(velocityReach(latency_)),
      weights_(learned_->network().noise) {
    if (options.robot) robot_ = learned_->robotIndex(*options.robot);
    assert(learned_->network().measures == SensorNetwork::Measures::pose);
    if (traits_.period == 0) traits_.period = learned_->network().period;
}

bool LearnedLocaliser::sound(std::span<const std::byte> memory) const {
    constexpr double farthest = 1e3;
    for (const double number : as<Memory>(memory).slow)
        if (!(std::abs(number) <= farthest)) return false;
    return true;
}

void LearnedLocaliser::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    const auto& own = as<Memory>(memory);
    if (own.begun == 0) return;
    entries.add("lasting_reported", own.slow[0]);
    std::size_t channel = 1;
    for (const ReadingDimension& dimension : dimensionsOf(SensorNetwork::Measures::pose))
        entries.add(EntryName("lasting_", dimension.name), own.slow[channel++]);
}

void LearnedLocaliser::carryOn(const SensorView& view, Memory& memory) const {
    for (std::size_t i = 0; i < channels(); ++i) {
        const ReadingNoise& noise = learned_->network().noise[i];
        if (noise.slow == 0) continue;
        const double normal = normalPair(view.key(channelNumbers + static_cast<std::uint32_t>(i))).first;
        const Lasting lasting = memory.begun != 0 ? Lasting::after(view.sinceLast, noise.slowTime) : Lasting{};
        memory.slow[i] = lasting.next(memory.slow[i], normal);
    }
    memory.begun = 1;
}

/// One reading is all of its look, so that what does not last is its own.
ReadingDraw LearnedLocaliser::drawOf(const SensorView& view, const Memory& memory) const {
    ChannelNumbers numbers{};
    for (std::size_t i = 0; i < channels(); ++i) {
        const double normal = normalPair(view.key(channelNumbers + static_cast<std::uint32_t>(i))).second;
        const double slow = learned_->network().noise[i].slow;
        numbers[i] = weights_.slow[i] * memory.slow[i] + std::sqrt(1 - slow) * normal;
    }
    return {numbers[0], uniformPair(view.key(whichComponent)).first, {numbers[1], numbers[2], numbers[3]}};
}

void LearnedLocaliser::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    auto& own = as<Memory>(memory);
    carryOn(view, own);
    if (!view.wants(0)) return;
    SensedState state;
    state.own = view.poseAt(view.robot, view.measured);
    state.velocity = ownVelocity(view, Placement(state.own), reach_);
    const int robot = robot_ ? *robot_ : learned_->robotIndex(view.scene.robots[view.robot].motionRobot);
    const ReadingDraw draw = drawOf(view, own);
    std::vector<std::uint32_t>& reported = view.buffers.reported;
    reported.clear();
    learned_->reported({&state, 1}, robot, {&draw.reported, 1}, reported);
    if (reported.empty()) return;
    ReadingError error;
    learned_->errors({&state, 1}, reported, robot, {&draw, 1}, {&error, 1});
    out.add(traits_.name, view.measured, state.own * Pose{error[0], error[1], error[2]});
}

}  // namespace mrose
