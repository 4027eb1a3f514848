#include "motion/learned_model.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "motion/portable_math.h"

namespace mrose {

LearnedMotion::Decay LearnedMotion::decayOf(double timeConstant, double period) {
    if (timeConstant <= 0) return {};
    const double left = decay(period / timeConstant);
    return {left, timeConstant * (1 - left)};
}

LearnedMotion::LearnedMotion(MotionNetwork network)
    : network_(std::move(network)),
      inputs_(network_),
      inference_(network_.mlp),
      decayV_(decayOf(network_.recovery.v, toSeconds(network_.period))),
      decayW_(decayOf(network_.recovery.w, toSeconds(network_.period))),
      trackers_(network_.robots.size()) {
    for (const MotionNetwork::Identified& identified : network_.identified)
        if (const int robot = inputs_.robotIndex(identified.robot); robot >= 0)
            trackers_[static_cast<std::size_t>(robot)] = identified.tracker;
}

MotionStep LearnedMotion::toStep(const MotionInput& input, int robot, const float* outputs) const {
    std::array<double, MotionNetwork::maxOutputs> y;
    for (std::size_t i = 0; i < network_.outputs.size(); ++i)
        y[i] = network_.outputs[i].mean + network_.outputs[i].scale * static_cast<double>(outputs[i]);
    MotionStep step{{y[0], y[1], y[2]}, {y[3], y[4]}};
    Velocity unperturbed = step.velocity;
    if (network_.form == MotionNetwork::Form::history) {
        const bool begun = !input.memory.empty() && as<Memory>(input.memory).begun != 0;
        const Velocity expected = begun ? as<Memory>(input.memory).unperturbed : step.velocity;
        const double v = input.velocity.v - expected.v, w = input.velocity.w - expected.w;
        step.increment.x += v * decayV_.displacement;
        step.increment.heading += w * decayW_.displacement;
        unperturbed = {y[5], y[6]};
        step.velocity = {y[5] + v * decayV_.velocity, y[6] + w * decayW_.velocity};
    }
    if (robot >= 0) step.increment.y += trackers_[static_cast<std::size_t>(robot)].sideways(step.increment);
    if (!input.memory.empty()) as<Memory>(input.memory) = {unperturbed, 1};
    return step;
}

void LearnedMotion::predict(std::span<const MotionInput> inputs, std::span<const int> robots,
                            std::span<MotionStep> steps) const {
    assert(inputs.size() == steps.size() && inputs.size() == robots.size());
    constexpr std::size_t chunk = 32;
    const std::size_t width = inputs_.width(), outputs = network_.outputs.size();
    std::array<float, chunk * MotionNetwork::maxInputs> rows;
    std::array<float, chunk * MotionNetwork::maxOutputs> results;
    for (std::size_t begin = 0; begin < inputs.size(); begin += chunk) {
        const std::size_t count = std::min(chunk, inputs.size() - begin);
        for (std::size_t i = 0; i < count; ++i) inputs_.read(inputs[begin + i], robots[begin + i], &rows[i * width]);
        inference_.batch(rows.data(), results.data(), count);
        for (std::size_t i = 0; i < count; ++i)
            steps[begin + i] = toStep(inputs[begin + i], robots[begin + i], &results[i * outputs]);
    }
}

LearnedModel::LearnedModel(std::shared_ptr<const LearnedMotion> motion, const std::string& robot)
    : motion_(std::move(motion)), robot_(motion_->inputs().robotIndex(robot)) {
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

std::vector<MemoryEntry> LearnedModel::explain(std::span<const std::byte> memory) const {
    const auto& kept = as<LearnedMotion::Memory>(memory);
    if (kept.begun == 0) return {};
    return {{"unperturbed_v", kept.unperturbed.v, "m/s"}, {"unperturbed_w", kept.unperturbed.w, "rad/s"}};
}

void LearnedModel::predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const {
    constexpr std::size_t chunk = 64;
    std::array<int, chunk> robots;
    robots.fill(robot_);
    for (std::size_t begin = 0; begin < inputs.size(); begin += chunk) {
        const std::size_t count = std::min(chunk, inputs.size() - begin);
        motion_->predict(inputs.subspan(begin, count), std::span(robots).first(count), steps.subspan(begin, count));
    }
}

}  // namespace mrose
