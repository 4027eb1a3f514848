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

/// Landmarks first, then robots.
std::uint32_t numberOf(const SimulatedView::Subject& subject, std::uint32_t landmarks) {
    return subject.kind == SubjectKind::robot ? landmarks + subject.index : subject.index;
}

Lasting between(Nanoseconds before, Nanoseconds now, double time) {
    return now < before ? Lasting{} : Lasting::after(toSeconds(now - before), time);
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
        anySubject_ = anySubject_ || weights_.subject[i] > 0;
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
               return instant(slot.looked) && std::ranges::all_of(slot.parts, normal);
           });
}

void LearnedCamera::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    const auto& own = as<Memory>(memory);
    for (std::size_t i = 0; i < channels; ++i)
        if (weights_.slow[i] > 0)
            entries.add(EntryName("slow_", channelNames[i]), weights_.slow[i] * static_cast<double>(own.slow[i]));
}

/// What all readings of a look have in common, by the first draws of the look.
LearnedCamera::Channels LearnedCamera::commonNumbers(const SensorView& view, Memory& memory) const {
    Channels common{};
    const UniformDraws draws(view.key(0));
    const auto normals = drawnNormals(std::array{draws[0], draws[1], draws[2], draws[3], draws[4], draws[5]});
    const ReadingNoises& noise = learned_->network().noise;
    const bool usual = memory.begun != 0 && view.measured - memory.looked == traits_.period;
    for (std::size_t i = 0; i < channels; ++i) {
        common[i] = weights_.look[i] * normals[i];
        if (noise[i].slow == 0) continue;
        const Lasting lasting = usual               ? slow_[i]
                                : memory.begun != 0 ? between(memory.looked, view.measured, noise[i].slowTime)
                                                    : Lasting{};
        memory.slow[i] = static_cast<float>(lasting.next(static_cast<double>(memory.slow[i]), normals[channels + i]));
        common[i] += weights_.slow[i] * static_cast<double>(memory.slow[i]);
    }
    memory.looked = view.measured;
    memory.begun = 1;
    return common;
}

/// Each subject has draws of its own, and a slot as long as no more are in view than there are slots, so that no other
/// one changes what is reported of it.
LearnedCamera::Numbers LearnedCamera::numbersOf(const UniformDraws& draws, std::uint32_t subject, Nanoseconds now,
                                                const Channels& common, Memory& memory) const {
    const auto normals = drawnNormals(std::array{draws[1], draws[4], draws[5], draws[6]});
    Channels numbers = common;
    if (anySubject_) {
        Memory::Slot none;
        Memory::Slot* const own = memory.find(subject);
        Memory::Slot* const taken = own != nullptr ? own : memory.take(subject, now);
        Memory::Slot& slot = taken != nullptr ? *taken : none;
        const bool usual = own != nullptr && now - slot.looked == traits_.period;
        for (std::size_t i = 0; i < channels; ++i) {
            if (weights_.subject[i] == 0) continue;
            const double time = learned_->network().noise[i].subjectTime;
            const Lasting lasting = usual ? subject_[i] : own != nullptr ? between(slot.looked, now, time) : Lasting{};
            const double part = lasting.next(static_cast<double>(slot.parts[i]), normals[1 + i]);
            slot.parts[i] = static_cast<float>(part);
            numbers[i] += weights_.subject[i] * static_cast<double>(slot.parts[i]);
        }
        slot.looked = now;
    }
    return {numbers[0] + weights_.alone[0] * normals[0], {numbers[1], numbers[2]}};
}

ReadingDraw LearnedCamera::errorDraw(const UniformDraws& draws, const ReadingError& common) const {
    ReadingDraw draw;
    draw.which = draws[0];
    for (std::size_t i = 1; i < channels; ++i)
        draw.error[i - 1] = common[i - 1] + weights_.alone[i] * drawnNormal(draws[1 + i]);
    return draw;
}

int LearnedCamera::robotOf(const SensorView& view) const {
    return robot_ ? *robot_ : learned_->robotIndex(view.scene.robots[view.robot].motionRobot);
}

void LearnedCamera::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    auto& own = as<Memory>(memory);
    const Channels common = commonNumbers(view, own);
    bool wanted = false;
    for (std::size_t i = 0; i < gives_.size(); ++i) wanted = wanted || view.wants(i);
    // What is remembered does not depend on what is read.
    if (!wanted && !anySubject_) return;

    SensingBuffers& b = view.buffers;
    b.simulated.look(view, learned_->network().view);
    const std::span<const SimulatedView::Subject> subjects = b.simulated.subjects();
    const auto landmarks = static_cast<std::uint32_t>(view.obstacles.landmarks().size());
    const auto drawsOf = [&](const SimulatedView::Subject& subject) {
        return UniformDraws(view.key(1 + numberOf(subject, landmarks)));
    };
    b.numbers.clear();
    b.common.clear();
    for (const SimulatedView::Subject& subject : subjects) {
        const Numbers numbers = reports(subject.kind) ? numbersOf(drawsOf(subject), numberOf(subject, landmarks),
                                                                  view.measured, common, own)
                                                      : Numbers{};
        b.numbers.push_back(numbers.reported);
        b.common.push_back(numbers.errors);
    }
    if (!wanted) return;

    b.states.clear();
    b.which.clear();
    b.simulated.describe(
        view, ownVelocity(view, b.simulated.eye(), reach_),
        [&](const SimulatedView::Subject& subject) { return reports(subject.kind); }, b.states, b.which);
    // In their order: none is moved onto one that is needed yet.
    for (std::size_t i = 0; i < b.which.size(); ++i) b.numbers[i] = b.numbers[b.which[i]];
    const int robot = robotOf(view);
    b.reported.clear();
    learned_->reported(b.states, robot, std::span(b.numbers).first(b.states.size()), b.reported);
    b.draws.clear();
    for (const std::uint32_t i : b.reported)
        b.draws.push_back(errorDraw(drawsOf(subjects[b.which[i]]), b.common[b.which[i]]));
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
