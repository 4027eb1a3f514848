#include "motion/learned_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "geometry/elementary.h"

namespace mrose {

LearnedMotion::Decay LearnedMotion::decayOf(double timeConstant, double period) {
    if (timeConstant <= 0) return {};
    const double left = decay(period / timeConstant);
    return {left, timeConstant * (1 - left)};
}

namespace {

/// Standard deviations of the members about the mean, their arithmetic mean but for rounding.
MotionSpread spreadOf(std::span<const MotionStep> members, const MotionStep& mean) {
    MotionSpread sum;
    const auto add = [](double& to, double member, double ofMean) { to += (member - ofMean) * (member - ofMean); };
    for (const MotionStep& member : members) {
        add(sum.increment.x, member.increment.x, mean.increment.x);
        add(sum.increment.y, member.increment.y, mean.increment.y);
        add(sum.increment.heading, member.increment.heading, mean.increment.heading);
        add(sum.velocity.v, member.velocity.v, mean.velocity.v);
        add(sum.velocity.w, member.velocity.w, mean.velocity.w);
    }
    const auto deviation = [&](double squares) { return std::sqrt(squares / double(members.size() - 1)); };
    return {{deviation(sum.increment.x), deviation(sum.increment.y), deviation(sum.increment.heading)},
            {deviation(sum.velocity.v), deviation(sum.velocity.w)}};
}

}  // namespace

LearnedMotion::LearnedMotion(MotionNetwork network)
    : network_(std::move(network)),
      inputs_(network_),
      inference_(network_.mlp),
      decayV_(decayOf(network_.recovery.v, toSeconds(network_.period))),
      decayW_(decayOf(network_.recovery.w, toSeconds(network_.period))),
      trackers_(network_.robots.size()) {
    if (!network_.members.empty()) withMembers_.emplace(withMemberOutputs(network_.mlp, network_.members));
    for (const MotionNetwork::Identified& identified : network_.identified)
        if (const int robot = inputs_.robotIndex(identified.robot); robot >= 0)
            trackers_[static_cast<std::size_t>(robot)] = identified.tracker;
    for (const MotionNetwork::Identified& identified : network_.identified) {
        const auto count = static_cast<double>(network_.identified.size());
        usualTracker_.ahead += identified.tracker.ahead / count;
        usualTracker_.rotated += identified.tracker.rotated / count;
    }
    if (network_.noise)
        noise_.emplace(Noise{NoiseTraitReader(network_),
                             NoiseProcesses(*network_.noise, network_.members.size(), toSeconds(network_.period))});
    if (network_.familiar) familiar_.emplace(network_.form, *network_.familiar);
}

namespace {

/// What noise remembers of a robot, in front of the values of its processes.
struct NoiseMemory {
    float forward = 0, heading = 0;  ///< the mean's increment of the period before
};

/// Never 0, which is at no time.
std::uint32_t lowerBits(Nanoseconds time) { return std::max(1U, static_cast<std::uint32_t>(time / 1000)); }

}  // namespace

std::size_t LearnedMotion::memorySize(MotionDraw draw) const {
    if (draw == MotionDraw::mean || !noise_) return noiseOffset();
    const std::size_t values = (noise_->processes.values() + 1) / 2 * 2;  // whole blocks of 8 bytes
    return noiseOffset() + sizeof(NoiseMemory) + values * sizeof(float);
}

void LearnedMotion::adapt(int robot, std::span<std::byte> memory, const TrackerEvidence& seen) const {
    if (seen.none()) return;
    const TrackerOffset besides = seen.offset(robot >= 0 ? TrackerOffset{} : usualTracker_);
    as<Memory>(memory).ahead = static_cast<float>(besides.ahead);
    as<Memory>(memory).rotated = static_cast<float>(besides.rotated);
}

void LearnedMotion::recall(std::span<std::byte> memory, const CommandView& sent, Nanoseconds start) const {
    if (!inputs_.ramps()) return;
    const InputReader::Followed followed = inputs_.followedFrom(sent, start);
    followedIn(memory) = {followed.command.v, followed.command.w};
    as<Memory>(memory).followedAt = lowerBits(followed.time);
}

const MlpInference& LearnedMotion::inferenceFor(MotionDraw draw) const {
    return draw == MotionDraw::noisy && noise_ && noise_->processes.members() > 0 ? *withMembers_ : inference_;
}

std::optional<Pose> LearnedMotion::drawNoise(const MotionInput& input, const float* row, const float* outputs) const {
    if (!noise_ || !input.noise) return std::nullopt;
    const Pose mean = incrementOf(outputs);
    const bool kept = !input.memory.empty(), begun = kept && as<Memory>(input.memory).begun != 0;
    std::array<float, ResidualNoise::maxValues> own;
    std::span<float> values = std::span(own).first(noise_->processes.values());
    NoiseMemory* const before = kept ? reinterpret_cast<NoiseMemory*>(input.memory.data() + noiseOffset()) : nullptr;
    if (kept) values = {reinterpret_cast<float*>(before + 1), values.size()};
    noise_->processes.advance(input.key(0), begun, values);
    const Pose previous = begun ? Pose{before->forward, 0, before->heading} : mean;
    if (kept) *before = {static_cast<float>(mean.x), static_cast<float>(mean.heading)};
    std::array<Pose, ResidualNoise::maxMembers> members;
    const std::size_t outputCount = network_.outputs.size();
    for (std::size_t m = 0; m < noise_->processes.members(); ++m) {
        const float* const member = outputs + outputCount + m * network_.members.front().outputBiases.size();
        const Pose increment = incrementOf(member);
        members[m] = {increment.x - mean.x, increment.y - mean.y, increment.heading - mean.heading};
    }
    return noise_->processes.noise(values, noise_->traits.read(row, mean, previous),
                                   std::span(members).first(noise_->processes.members()));
}

void LearnedMotion::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    if (!followsInMemory()) {
        const Velocity& unperturbed = as<Memory>(memory).unperturbed;
        entries.add("unperturbed_v", unperturbed.v, "m/s");
        entries.add("unperturbed_w", unperturbed.w, "rad/s");
    }
    if (inputs_.ramps()) {
        const Velocity& followed = followedIn(memory);
        entries.add("followed_v", followed.v, "m/s");
        entries.add("followed_w", followed.w, "rad/s");
    }
    if (memory.size() <= noiseOffset() || !noise_) return;
    const auto* const values = reinterpret_cast<const float*>(memory.data() + noiseOffset() + sizeof(NoiseMemory));
    entries.add("noise_scale", noise_->processes.scale({values, noise_->processes.values()}));
}

MotionStep LearnedMotion::toStep(const MotionInput& input, int robot, const float* outputs,
                                 const std::optional<Pose>& noise) const {
    std::array<double, MotionNetwork::maxOutputs> y;
    for (std::size_t i = 0; i < network_.outputs.size(); ++i) y[i] = value(outputs, i);
    MotionStep step{{y[0], y[1], y[2]}, {y[3], y[4]}};
    if (network_.form == MotionNetwork::Form::history) {
        const bool begun = !input.memory.empty() && as<Memory>(input.memory).begun != 0;
        const Velocity expected = begun ? as<Memory>(input.memory).unperturbed : step.velocity;
        const double v = input.velocity.v - expected.v, w = input.velocity.w - expected.w;
        step.increment.x += v * decayV_.displacement;
        step.increment.heading += w * decayW_.displacement;
        step.velocity = {y[5] + v * decayV_.velocity, y[6] + w * decayW_.velocity};
    }
    if (noise) {
        step.increment.x += noise->x;
        step.increment.y += noise->y;
        step.increment.heading += noise->heading;
    }
    TrackerOffset offset = tracker(robot);
    if (!input.memory.empty()) {
        offset.ahead += static_cast<double>(as<Memory>(input.memory).ahead);
        offset.rotated += static_cast<double>(as<Memory>(input.memory).rotated);
    }
    if (offset != TrackerOffset{}) step.increment.y += offset.sideways(step.increment);
    return step;
}

void LearnedMotion::readInputs(const MotionInput& input, int robot, float* row) const {
    if (!inputs_.ramps() || input.memory.empty()) return inputs_.read(input, robot, row);
    auto& memory = as<Memory>(input.memory);
    Velocity& kept = followedIn(input.memory);
    InputReader::Followed followed;
    const Nanoseconds begin = inputs_.beginOf(input);
    if (memory.followedAt == lowerBits(begin)) followed = {{kept.v, kept.w}, begin};
    inputs_.read(input, robot, row, &followed);
    kept = {followed.command.v, followed.command.w};
    memory.followedAt = lowerBits(followed.time);
}

void LearnedMotion::remember(const MotionInput& input, const float* outputs) const {
    if (input.memory.empty()) return;
    const std::size_t end = network_.form == MotionNetwork::Form::history ? 5 : 3;
    auto& memory = as<Memory>(input.memory);
    if (!followsInMemory()) memory.unperturbed = {value(outputs, end), value(outputs, end + 1)};
    memory.begun = 1;
}

void LearnedMotion::predict(std::span<const MotionInput> inputs, std::span<const int> robots,
                            std::span<MotionStep> steps, MotionDraw draw) const {
    assert(inputs.size() == steps.size() && inputs.size() == robots.size());
    constexpr std::size_t chunk = 32;
    const MlpInference& inference = inferenceFor(draw);
    const std::size_t width = inputs_.width(), outputs = static_cast<std::size_t>(inference.shape().outputs);
    std::array<float, chunk * MotionNetwork::maxInputs> rows;
    std::array<float, chunk*(MotionNetwork::maxOutputs + ResidualNoise::maxMembers * MotionNetwork::maxOutputs)>
        results;
    for (std::size_t begin = 0; begin < inputs.size(); begin += chunk) {
        const std::size_t count = std::min(chunk, inputs.size() - begin);
        for (std::size_t i = 0; i < count; ++i) readInputs(inputs[begin + i], robots[begin + i], &rows[i * width]);
        inference.batch(rows.data(), results.data(), count);
        for (std::size_t i = 0; i < count; ++i) {
            const MotionInput& input = inputs[begin + i];
            const float* const result = &results[i * outputs];
            const auto noise = draw == MotionDraw::noisy ? drawNoise(input, &rows[i * width], result) : std::nullopt;
            steps[begin + i] = toStep(input, robots[begin + i], result, noise);
            remember(input, result);
        }
    }
}

void LearnedMotion::predictMembers(std::span<const MotionInput> inputs, std::span<const int> robots,
                                   std::span<MotionStep> steps, std::span<MotionStep> members) const {
    assert(withMembers_ && inputs.size() == steps.size() && inputs.size() == robots.size());
    assert(members.size() == inputs.size() * memberCount());
    constexpr std::size_t chunk = 32;
    const std::size_t width = inputs_.width(), outputs = network_.outputs.size();
    const std::size_t own = network_.members.front().outputBiases.size(), all = outputs + memberCount() * own;
    std::array<float, chunk * MotionNetwork::maxInputs> rows;
    std::vector<float> results(std::min(chunk, inputs.size()) * all);
    for (std::size_t begin = 0; begin < inputs.size(); begin += chunk) {
        const std::size_t count = std::min(chunk, inputs.size() - begin);
        for (std::size_t i = 0; i < count; ++i) readInputs(inputs[begin + i], robots[begin + i], &rows[i * width]);
        withMembers_->batch(rows.data(), results.data(), count);
        for (std::size_t i = 0; i < count; ++i) {
            const MotionInput& input = inputs[begin + i];
            const int robot = robots[begin + i];
            const float* const mean = &results[i * all];
            steps[begin + i] = toStep(input, robot, mean);
            std::array<float, MotionNetwork::maxOutputs> member;
            std::copy_n(mean, outputs, member.begin());
            for (std::size_t m = 0; m < memberCount(); ++m) {
                std::copy_n(mean + outputs + m * own, own, member.begin());
                members[(begin + i) * memberCount() + m] = toStep(input, robot, member.data());
            }
            remember(input, mean);
        }
    }
}

LearnedModel::LearnedModel(std::shared_ptr<const LearnedMotion> motion, const std::string& robot, MotionDraw draw)
    : motion_(std::move(motion)),
      robot_(motion_->inputs().robotIndex(robot)),
      draw_(motion_->network().noise ? draw : MotionDraw::mean) {
    const std::vector<MotionNetwork::Identified>& all = network().identified;
    const bool own = std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.robot == robot; });
    double v = 0, w = 0, count = 0;
    for (const MotionNetwork::Identified& one : all) {
        if (own && one.robot != robot) continue;
        v += one.v.deadTime;
        w += one.w.deadTime;
        ++count;
    }
    if (count > 0) deadTimes_ = {fromSeconds(v / count), fromSeconds(w / count)};
}

bool LearnedModel::sameAs(const MotionModel& other) const {
    const auto* learned = dynamic_cast<const LearnedModel*>(&other);
    return learned != nullptr && learned->robot_ == robot_ && learned->draw_ == draw_ &&
           learned->network() == network();
}

std::shared_ptr<const LearnedModel> LearnedModel::drawn(MotionDraw draw) const {
    auto other = std::make_shared<LearnedModel>(*this);
    other->draw_ = network().noise ? draw : MotionDraw::mean;
    return other;
}

void LearnedModel::restart(std::span<std::byte> memory) const {
    const auto before = as<LearnedMotion::Memory>(memory);
    std::fill(memory.begin(), memory.end(), std::byte{0});
    as<LearnedMotion::Memory>(memory).ahead = before.ahead;
    as<LearnedMotion::Memory>(memory).rotated = before.rotated;
}

void LearnedModel::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    const auto& kept = as<LearnedMotion::Memory>(memory);
    if (kept.begun == 0) return;
    if (kept.ahead != 0 || kept.rotated != 0) {
        const TrackerOffset own = motion_->tracker(robot_);
        entries.add("tracked_point_ahead", own.ahead + static_cast<double>(kept.ahead), "m");
        entries.add("tracked_point_rotated", own.rotated + static_cast<double>(kept.rotated), "rad");
    }
    motion_->explain(memory, entries);
}

void LearnedModel::predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const {
    constexpr std::size_t chunk = 64;
    std::array<int, chunk> robots;
    robots.fill(robot_);
    for (std::size_t begin = 0; begin < inputs.size(); begin += chunk) {
        const std::size_t count = std::min(chunk, inputs.size() - begin);
        motion_->predict(inputs.subspan(begin, count), std::span(robots).first(count), steps.subspan(begin, count),
                         draw_);
    }
}

void LearnedModel::predictWithSpread(std::span<const MotionInput> inputs, std::span<MotionStep> steps,
                                     std::span<MotionSpread> spreads) const {
    const std::size_t count = motion_->memberCount();
    if (count < 2) return MotionModel::predictWithSpread(inputs, steps, spreads);
    const std::vector<int> robots(inputs.size(), robot_);
    std::vector<MotionStep> members(inputs.size() * count);
    motion_->predictMembers(inputs, robots, steps, members);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        spreads[i] = spreadOf(std::span(members).subspan(i * count, count), steps[i]);
}

std::shared_ptr<const MotionModel> meanOf(std::shared_ptr<const MotionModel> model) {
    const auto* learned = dynamic_cast<const LearnedModel*>(model.get());
    if (learned == nullptr || learned->draw() == MotionDraw::mean) return model;
    return learned->drawn(MotionDraw::mean);
}

const LearnedModel* learnedModel(const MotionModel& model) {
    return dynamic_cast<const LearnedModel*>(&model.underlying());
}

}  // namespace mrose
