#pragma once

#include <memory>

#include "motion/motion_model.h"
#include "motion/motion_noise.h"

namespace mrose {

/// A model with such noise on its increments. What it remembers is the other's memory.
class NoisyModel final : public MotionModel {
public:
    NoisyModel(std::shared_ptr<const MotionModel> model, const MotionNoise& noise)
        : model_(std::move(model)), noise_(noise) {}

    const std::shared_ptr<const MotionModel>& withoutNoise() const { return model_; }
    const MotionNoise& noise() const { return noise_; }

    Nanoseconds period() const override { return model_->period(); }
    Nanoseconds lookBack() const override { return model_->lookBack(); }
    DeadTimes deadTimes() const override { return model_->deadTimes(); }
    std::size_t memorySize() const override { return model_->memorySize(); }
    void start(std::span<std::byte> memory) const override { model_->start(memory); }
    void restart(std::span<std::byte> memory) const override { model_->restart(memory); }
    void adapt(std::span<std::byte> memory, const TrackerEvidence& seen) const override { model_->adapt(memory, seen); }
    void recall(std::span<std::byte> memory, const CommandView& sent, Nanoseconds start) const override {
        model_->recall(memory, sent, start);
    }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override {
        model_->explain(memory, entries);
    }
    const MotionModel& underlying() const override { return model_->underlying(); }
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override;
    /// How unsure the other is; its own noise is not counted.
    void predictWithSpread(std::span<const MotionInput> inputs, std::span<MotionStep> steps,
                           std::span<MotionSpread> spreads) const override;

private:
    void addTo(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const;

    std::shared_ptr<const MotionModel> model_;
    MotionNoise noise_;
};

/// The model with this noise in the place of any that it has; without noise the model alone.
std::shared_ptr<const MotionModel> withNoise(std::shared_ptr<const MotionModel> model, const MotionNoise& noise);

MotionNoise noiseOf(const MotionModel& model);

}  // namespace mrose
