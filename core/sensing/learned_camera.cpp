#include "sensing/learned_camera.h"

#include <algorithm>
#include <cmath>

#include "geometry/normal_distribution.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr Nanoseconds leastReach = 40'000'000;  // that velocities are found over

constexpr std::array<const char*, LearnedCamera::channels> channelNames{"reported", "range", "bearing"};

/// A channel of a draw: first whether it is reported, then the errors.
double& partOf(ReadingDraw& draw, std::size_t channel) {
    return channel == 0 ? draw.reported : draw.error[channel - 1];
}
/// Two standard normal numbers for each channel, from a key's draws.
std::array<double, 2 * LearnedCamera::channels> normalsOf(const UniformDraws& draws, std::size_t first) {
    std::array<double, 2 * LearnedCamera::channels> uniforms;
    for (std::size_t i = 0; i < uniforms.size(); ++i) uniforms[i] = draws[first + i];
    return drawnNormals(uniforms);
}

BodySight sightOf(const SensorNetwork& network) {
    BodySight sight;
    sight.range = network.view.range;
    sight.fieldOfView = network.view.fieldOfView;
    sight.latency = network.latency;
    sight.occlusion = true;
    return sight;
}

}  // namespace

LearnedCamera::LearnedCamera(std::shared_ptr<const LearnedSensor> learned, const SensorTraits& traits,
                             const Options& options)
    : learned_(std::move(learned)),
      traits_(traits),
      latency_(options.latency.value_or(learned_->network().latency)),
      reach_(std::max(latency_, leastReach)),
      sight_(sightOf(learned_->network())),
      weights_(learned_->network().noise) {
    const SensorNetwork& network = learned_->network();
    if (options.robot) robot_ = learned_->robotIndex(*options.robot);
    if (traits_.period == 0) traits_.period = network.period;
    sight_.latency = latency_;
    slow_ = after(traits_.period, &ReadingNoise::slowTime);
    subject_ = after(traits_.period, &ReadingNoise::subjectTime);
    for (std::size_t i = 0; i < channels; ++i) {
        anyCommon_ = anyCommon_ || network.noise[i].look > 0 || network.noise[i].slow > 0;
        anySubject_ = anySubject_ || network.noise[i].subject > 0;
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

std::vector<MemoryEntry> LearnedCamera::explain(std::span<const std::byte> memory) const {
    const auto& own = as<Memory>(memory);
    std::vector<MemoryEntry> entries;
    for (std::size_t i = 0; i < channels; ++i)
        if (weights_.slow[i] > 0)
            entries.push_back(
                {std::string("slow_") + channelNames[i], weights_.slow[i] * static_cast<double>(own.slow[i])});
    return entries;
}

LearnedCamera::Lasting LearnedCamera::after(Nanoseconds duration, double ReadingNoise::*time) const {
    Lasting lasting;
    for (std::size_t i = 0; i < channels; ++i) {
        const double kept = decay(toSeconds(duration) / (learned_->network().noise[i].*time));
        lasting.kept[i] = kept;
        lasting.added[i] = std::sqrt(1 - kept * kept);
    }
    return lasting;
}

/// What all readings of a look have in common, by the first draws of the look.
ReadingDraw LearnedCamera::common(const SensorView& view, Memory& memory) const {
    ReadingDraw common;
    if (anyCommon_) {
        const auto normals = normalsOf(UniformDraws(view.key(0)), 0);
        const Nanoseconds since = view.measured - memory.looked;
        const Lasting lasting = memory.begun == 0 || since < 0 ? Lasting{{}, {1, 1, 1}}
                                : since == traits_.period      ? slow_
                                                               : after(since, &ReadingNoise::slowTime);
        for (std::size_t i = 0; i < channels; ++i) {
            const double slow =
                lasting.kept[i] * static_cast<double>(memory.slow[i]) + lasting.added[i] * normals[channels + i];
            memory.slow[i] = static_cast<float>(slow);
            partOf(common, i) = weights_.look[i] * normals[i] + weights_.slow[i] * static_cast<double>(memory.slow[i]);
        }
    }
    memory.looked = view.measured;
    memory.begun = 1;
    return common;
}

/// Of one subject's reading. Each has draws of its own, so that no other one changes what is reported of it.
ReadingDraw LearnedCamera::draw(const SensorView& view, std::uint32_t subject, const ReadingDraw& common,
                                Memory& memory) const {
    const UniformDraws draws(view.key(1 + subject));
    const auto normals = normalsOf(draws, 1);
    ReadingDraw draw = common;
    draw.which = draws[0];
    for (std::size_t i = 0; i < channels; ++i) partOf(draw, i) += weights_.alone[i] * normals[i];
    if (!anySubject_) return draw;
    Memory::Slot& slot = memory.slots[subject % memory.slots.size()];
    const Nanoseconds since = view.measured - slot.looked;
    const bool fresh = slot.subject != subject + 1 || since < 0;
    const Lasting lasting = fresh                     ? Lasting{{}, {1, 1, 1}}
                            : since == traits_.period ? subject_
                                                      : after(since, &ReadingNoise::subjectTime);
    for (std::size_t i = 0; i < channels; ++i) {
        if (weights_.subject[i] == 0) continue;
        const double part =
            lasting.kept[i] * static_cast<double>(slot.parts[i]) + lasting.added[i] * normals[channels + i];
        slot.parts[i] = static_cast<float>(part);
        partOf(draw, i) += weights_.subject[i] * static_cast<double>(slot.parts[i]);
    }
    slot.subject = subject + 1;
    slot.looked = view.measured;
    return draw;
}

int LearnedCamera::robotOf(const SensorView& view) const {
    return robot_ ? *robot_ : learned_->robotIndex(view.scene.robots[view.robot].motionRobot);
}

Velocity LearnedCamera::ownVelocity(const SensorView& view, const Placement& own) const {
    const Nanoseconds before = view.measured - reach_;
    const Nanoseconds after = std::min(view.measured + reach_, view.timeBefore(0));
    const Pose from = view.poseAt(view.robot, before), to = view.poseAt(view.robot, after);
    const double duration = toSeconds(after - before);
    return {own.rotateBack(position(to) - position(from)).x / duration, (to.heading - from.heading) / duration};
}

void LearnedCamera::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    auto& own = as<Memory>(memory);
    const ReadingDraw common = this->common(view, own);
    bool wanted = false;
    for (std::size_t i = 0; i < gives_.size(); ++i) wanted = wanted || view.wants(i);
    if (!wanted && !anySubject_) return;

    SensingBuffers& buffers = view.buffers;
    SimulatedView& simulated = buffers.simulated;
    simulated.look(view, learned_->network().view);
    const std::span<const SimulatedView::Subject> subjects = simulated.subjects();
    const auto landmarks = static_cast<std::uint32_t>(view.obstacles.landmarks().size());
    buffers.draws.clear();
    for (const SimulatedView::Subject& subject : subjects)
        buffers.draws.push_back(
            reports(subject.kind)
                ? draw(view, (subject.kind == SubjectKind::robot ? landmarks : 0) + subject.index, common, own)
                : ReadingDraw{});
    if (!wanted) return;

    buffers.states.clear();
    buffers.which.clear();
    buffers.reports.clear();
    simulated.describe(
        view, ownVelocity(view, simulated.eye()),
        [&](const SimulatedView::Subject& subject) { return reports(subject.kind); }, buffers.states, buffers.which);
    // In their order: no draw is moved onto one that is needed yet.
    for (std::size_t i = 0; i < buffers.which.size(); ++i) buffers.draws[i] = buffers.draws[buffers.which[i]];
    learned_->report(buffers.states, robotOf(view), std::span(buffers.draws).first(buffers.states.size()),
                     buffers.reports);
    std::size_t reading = 0;
    for (const SubjectKind kind : {SubjectKind::landmark, SubjectKind::robot}) {
        if (!reports(kind)) continue;
        if (view.wants(reading)) {
            buffers.seen.clear();
            for (const LearnedSensor::Report& report : buffers.reports) {
                const SimulatedView::Subject& subject = subjects[buffers.which[report.state]];
                if (subject.kind != kind) continue;
                const double range = std::max(0.0, subject.range + report.error[0]);
                buffers.seen.push_back(
                    {subject.index, range * towards(subject.bearing + report.error[1]), view.measured});
            }
            out.add(gives_[reading].name, view.measured, std::span<const SeenBody>(buffers.seen));
        }
        ++reading;
    }
}

}  // namespace mrose
