#include "motion/noisy_model.h"

#include "geometry/point.h"
#include "world/noise.h"

namespace mrose {

void NoisyModel::addTo(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const {
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!inputs[i].noise) continue;
        Pose& increment = steps[i].increment;
        const double distance = length({increment.x, increment.y});
        const NoisePair draw = normalPair(*inputs[i].noise);
        increment.x += noise_.distancePerDistance * distance * draw.first;
        increment.heading += draw.second * length({noise_.rotationPerRotation * increment.heading,
                                                   noise_.rotationPerDistance * distance});
    }
}

void NoisyModel::predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const {
    model_->predict(inputs, steps);
    addTo(inputs, steps);
}

void NoisyModel::predictWithSpread(std::span<const MotionInput> inputs, std::span<MotionStep> steps,
                                   std::span<MotionSpread> spreads) const {
    model_->predictWithSpread(inputs, steps, spreads);
    addTo(inputs, steps);
}

std::shared_ptr<const MotionModel> withNoise(std::shared_ptr<const MotionModel> model, const MotionNoise& noise) {
    if (const auto* noisy = dynamic_cast<const NoisyModel*>(model.get())) model = noisy->withoutNoise();
    if (noise.none()) return model;
    return std::make_shared<const NoisyModel>(std::move(model), noise);
}

MotionNoise noiseOf(const MotionModel& model) {
    const auto* noisy = dynamic_cast<const NoisyModel*>(&model);
    return noisy != nullptr ? noisy->noise() : MotionNoise{};
}

}  // namespace mrose
