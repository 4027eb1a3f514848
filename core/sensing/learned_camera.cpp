#include "sensing/learned_camera.h"

#include <algorithm>
#include <cmath>

#include "geometry/normal_distribution.h"
#include "sensing/own_velocity.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr std::array<const char*, LearnedCamera::channels> channelNames{"reported", "range", "bearing"};

BodySight sightOf(const SensorNetwork& network) {
    BodySight sight;
    sight.range = network.view.range;
    sight.fieldOfView = network.view.fieldOfView;
    sight.latency = network.latency;
    sight.occlusion = true;
    return sight;
}

}  // namespace

LearnedCamera::Memory::Slot* LearnedCamera::Memory::find(std::uint32_t subject) {
    Slot& first = slots[subject % slots.size()];
    if (first.owner == subject + 1) return &first;
    const auto own = std::ranges::find(slots, subject + 1, &Slot::owner);
    return own == slots.end() ? nullptr : &*own;
}

LearnedCamera::Memory::Slot* LearnedCamera::Memory::take(std::uint32_t subject, Nanoseconds now) {
    Slot* slot = &slots[subject % slots.size()];
    if (slot->owner != 0) {
        const auto free = std::ranges::find(slots, 0u, &Slot::owner);
        slot = free != slots.end() ? &*free : &*std::ranges::min_element(slots, {}, &Slot::looked);
    }
    if (slot->owner != 0 && slot->looked == now) return nullptr;
    *slot = {.owner = subject + 1};
    return slot;
}

LearnedCamera::LearnedCamera(std::shared_ptr<const LearnedSensor> learned, const SensorTraits& traits,
                             const Options& options)
    : learned_(std::move(learned)),
      traits_(traits),
      latency_(options.latency.value_or(learned_->network().latency)),
      reach_(velocityReach(latency_)),
      sight_(sightOf(learned_->network())),
      weights_(learned_->network().noise) {
    const SensorNetwork& network = learned_->network();
    if (options.robot) robot_ = learned_->robotIndex(*options.robot);
    if (traits_.period == 0) traits_.period = network.period;
    sight_.latency = latency_;
    for (std::size_t i = 0; i < channels; ++i) {
        slow_[i] = Lasting::after(toSeconds(traits_.period), network.noise[i].slowTime);
        subject_[i] = Lasting::after(toSeconds(traits_.period), network.noise[i].subjectTime);
    }
    if (network.landmarks) gives_.push_back({traits_.name + ".landmarks", &recordType<SeenBody>()});
    if (network.robotSubjects) gives_.push_back({traits_.name + ".robots", &recordType<SeenBody>()});
}

std::vector<ReadingKind> LearnedCamera::gives() const { return gives_; }

bool LearnedCamera::reports(SubjectKind kind) const {
    const SensorNetwork& network = learned_->network();
    return kind == SubjectKind::landmark ? network.landmarks : network.robotSubjects;
}

bool LearnedCamera::sound(std::span<const std::byte> memory) const {
    const auto& own = as<Memory>(memory);
    const auto normal = [](float number) { return std::abs(number) <= 1e3f; };
    const auto instant = [](Nanoseconds time) { return time >= -latestTime && time <= latestTime; };
    return instant(own.looked) && std::ranges::all_of(own.slow, normal) &&
           std::ranges::all_of(own.slots, [&](const Memory::Slot& slot) {
               return instant(slot.looked) && instant(slot.reported) && std::ranges::all_of(slot.parts, normal);
           });
}

std::vector<MemoryEntry> LearnedCamera::explain(std::span<const std::byte> memory) const {
    const auto& own = as<Memory>(memory);
    std::vector<MemoryEntry> entries;
    for (std::size_t i = 0; i < channels; ++i)
        if (weights_.slow[i] > 0)
            entries.push_back(
                {std::string("slow_") + channelNames[i], weights_.slow[i] * static_cast<double>(own.slow[i])});
    return entries;
}

Lasting LearnedCamera::between(Nanoseconds before, Nanoseconds now, double time, const Lasting& afterPeriod) const {
    const Nanoseconds since = now - before;
    if (since == traits_.period) return afterPeriod;
    return since < 0 ? Lasting{} : Lasting::after(toSeconds(since), time);
}

/// What all readings of a look have in common, by the first draws of the look.
LearnedCamera::Channels LearnedCamera::commonNumbers(const SensorView& view, Memory& memory) const {
    Channels common{};
    const UniformDraws draws(view.key(0));
    const ReadingNoises& noise = learned_->network().noise;
    for (std::size_t i = 0; i < channels; ++i) {
        if (noise[i].look > 0) common[i] = weights_.look[i] * drawnNormal(draws[i]);
        if (noise[i].slow == 0) continue;
        const Lasting lasting =
            memory.begun == 0 ? Lasting{} : between(memory.looked, view.measured, noise[i].slowTime, slow_[i]);
        memory.slow[i] =
            static_cast<float>(lasting.next(static_cast<double>(memory.slow[i]), drawnNormal(draws[channels + i])));
        common[i] += weights_.slow[i] * static_cast<double>(memory.slow[i]);
    }
    memory.looked = view.measured;
    memory.begun = 1;
    return common;
}

/// One channel's number of a subject's reading; `before`: the last instant that had one.
double LearnedCamera::numberOf(std::size_t channel, const UniformDraws& draws, double common, Memory::Slot& slot,
                               bool begun, Nanoseconds before, Nanoseconds now) const {
    const double number = common + weights_.alone[channel] * drawnNormal(draws[1 + channel]);
    if (weights_.subject[channel] == 0) return number;
    const double time = learned_->network().noise[channel].subjectTime;
    const Lasting lasting = begun ? between(before, now, time, subject_[channel]) : Lasting{};
    float& part = slot.parts[channel];
    part = static_cast<float>(lasting.next(static_cast<double>(part), drawnNormal(draws[1 + channels + channel])));
    return number + weights_.subject[channel] * static_cast<double>(part);
}

/// Each subject has draws of its own, and a slot as long as no more are in view than there are slots, so that no other
/// one changes what is reported of it.
double LearnedCamera::reportedNumber(const SensorView& view, std::uint32_t subject, const Channels& common,
                                     Memory& memory) const {
    Memory::Slot none;
    Memory::Slot* const own = memory.find(subject);
    Memory::Slot* const taken = own != nullptr ? own : memory.take(subject, view.measured);
    Memory::Slot& slot = taken != nullptr ? *taken : none;
    const UniformDraws draws(view.key(1 + subject));
    const double number = numberOf(0, draws, common[0], slot, own != nullptr, slot.looked, view.measured);
    slot.looked = view.measured;
    return number;
}

/// After reportedNumber().
ReadingDraw LearnedCamera::errorDraw(const SensorView& view, std::uint32_t subject, const Channels& common,
                                     Memory& memory) const {
    Memory::Slot none;
    Memory::Slot* const own = memory.find(subject);
    Memory::Slot& slot = own != nullptr ? *own : none;
    const UniformDraws draws(view.key(1 + subject));
    ReadingDraw draw;
    draw.which = draws[0];
    for (std::size_t i = 1; i < channels; ++i)
        draw.error[i - 1] = numberOf(i, draws, common[i], slot, slot.wasReported != 0, slot.reported, view.measured);
    slot.wasReported = 1;
    slot.reported = view.measured;
    return draw;
}

int LearnedCamera::robotOf(const SensorView& view) const {
    return robot_ ? *robot_ : learned_->robotIndex(view.scene.robots[view.robot].motionRobot);
}

Velocity LearnedCamera::ownVelocity(const SensorView& view, const Placement& own) const {
    return mrose::ownVelocity(view, own, reach_);
}

void LearnedCamera::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    bool wanted = false;
    for (std::size_t i = 0; i < gives_.size(); ++i) wanted = wanted || view.wants(i);
    if (!wanted) return;
    auto& own = as<Memory>(memory);
    const Channels common = commonNumbers(view, own);
    SensingBuffers& b = view.buffers;
    b.simulated.look(view, learned_->network().view);
    b.states.clear();
    b.which.clear();
    b.simulated.describe(
        view, ownVelocity(view, b.simulated.eye()),
        [&](const SimulatedView::Subject& subject) { return reports(subject.kind); }, b.states, b.which);
    const std::span<const SimulatedView::Subject> subjects = b.simulated.subjects();
    const auto landmarks = static_cast<std::uint32_t>(view.obstacles.landmarks().size());
    const auto numberOf = [&](std::uint32_t state) {
        const SimulatedView::Subject& subject = subjects[b.which[state]];
        return subject.kind == SubjectKind::robot ? landmarks + subject.index : subject.index;
    };
    b.numbers.clear();
    for (std::uint32_t i = 0; i < b.states.size(); ++i)
        b.numbers.push_back(reportedNumber(view, numberOf(i), common, own));
    const int robot = robotOf(view);
    b.reported.clear();
    learned_->reported(b.states, robot, b.numbers, b.reported);
    b.draws.clear();
    for (const std::uint32_t i : b.reported) b.draws.push_back(errorDraw(view, numberOf(i), common, own));
    b.errors.resize(b.reported.size());
    learned_->errors(b.states, b.reported, robot, b.draws, b.errors);
    std::size_t reading = 0;
    for (const SubjectKind kind : {SubjectKind::landmark, SubjectKind::robot}) {
        if (!reports(kind)) continue;
        if (view.wants(reading)) {
            b.seen.clear();
            for (std::size_t i = 0; i < b.reported.size(); ++i) {
                const SimulatedView::Subject& subject = subjects[b.which[b.reported[i]]];
                if (subject.kind != kind) continue;
                const double range = std::max(0.0, subject.range + b.errors[i][0]);
                b.seen.push_back({subject.index, range * towards(subject.bearing + b.errors[i][1]), view.measured});
            }
            out.add(gives_[reading].name, view.measured, std::span<const SeenBody>(b.seen));
        }
        ++reading;
    }
}

}  // namespace mrose
