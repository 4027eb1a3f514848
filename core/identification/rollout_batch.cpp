#include "identification/rollout_batch.h"

#include <cmath>

#include "geometry/point.h"
#include "learning/parallel_for.h"
#include "motion/percent_errors.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;

constexpr int velocityOutputs = 3;  // v' is output 3 and w' output 4 of the state form

/// Path length and rotation over steps of half a second: a wobble of the robot inflates shorter ones.
void addTravelled(std::span<const Pose> truth, std::size_t stepsPerHalfSecond, double& path, double& rotation) {
    Pose pose, last;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        pose = pose * truth[k];
        if ((k + 1) % stepsPerHalfSecond != 0) continue;
        path += distance(position(last), position(pose));
        rotation += std::abs(pose.heading - last.heading);
        last = pose;
    }
}

}  // namespace

RolloutBatch::RolloutBatch(const MotionSamples& samples, const MotionNetwork& network, std::vector<std::size_t> starts,
                           std::size_t length)
    : network_(network), starts_(std::move(starts)), length_(length) {
    for (std::size_t i = 0; i < network.inputs.size(); ++i) {
        if (network.inputs[i].quantity == Quantity::velocityV) feedback_.emplace_back(int(i), velocityOutputs);
        if (network.inputs[i].quantity == Quantity::velocityW) feedback_.emplace_back(int(i), velocityOutputs + 1);
    }
    recurrent_ = !feedback_.empty();
    inputs_.assign(length_, PatternMatrix(starts_.size(), int(samples.width)));
    if (recurrent_) velocities_.assign(length_, PatternMatrix(starts_.size(), 2));
    truth_.resize(starts_.size() * length_);
    parallelFor(starts_.size(), [&](std::size_t chain) {
        for (std::size_t k = 0; k < length_; ++k) {
            const std::size_t sample = starts_[chain] + k;
            truth_[chain * length_ + k] = samples.samples[sample].increment;
            if (recurrent_) {
                const auto& [v, w] = samples.samples[sample].after;
                velocities_[k](chain, 0) = static_cast<float>((v - network.outputs[3].mean) / network.outputs[3].scale);
                velocities_[k](chain, 1) = static_cast<float>((w - network.outputs[4].mean) / network.outputs[4].scale);
            }
            const auto raw = samples.inputsOf(sample);
            for (std::size_t i = 0; i < raw.size(); ++i)
                inputs_[k](chain, int(i)) =
                    static_cast<float>((raw[i] - network.inputs[i].mean) / network.inputs[i].scale);
        }
    });
}

void RolloutBatch::beginWith(std::size_t chain, const Velocity& velocity) {
    for (const auto& [input, output] : feedback_) {
        const NetworkInput& to = network_.inputs[static_cast<std::size_t>(input)];
        const double value = output == velocityOutputs ? velocity.v : velocity.w;
        inputs_.front()(chain, input) = static_cast<float>((value - to.mean) / to.scale);
    }
}

/// The velocity that a step predicted is what the next step reads.
void RolloutBatch::takeVelocity(const PatternMatrix& outputs, PatternMatrix& inputs) const {
    for (const auto& [input, output] : feedback_) {
        const NetworkOutput& from = network_.outputs[output];
        const NetworkInput& to = network_.inputs[input];
        const auto gain = static_cast<float>(from.scale / to.scale);
        const auto shift = static_cast<float>((from.mean - to.mean) / to.scale);
        for (std::size_t c = 0; c < inputs.patterns(); ++c) inputs(c, input) = shift + gain * outputs(c, output);
    }
}

void RolloutBatch::returnVelocity(const PatternMatrix& inputGradient, PatternMatrix& outputGradient) const {
    for (const auto& [input, output] : feedback_) {
        const auto gain = static_cast<float>(network_.outputs[output].scale / network_.inputs[input].scale);
        for (std::size_t c = 0; c < outputGradient.patterns(); ++c)
            outputGradient(c, output) += gain * inputGradient(c, input);
    }
}

RolloutBatch::Pass RolloutBatch::forward(const MlpGradient& engine, std::span<const float> parameters,
                                         bool keepHidden) const {
    Pass pass;
    pass.outputs.resize(length_);
    pass.hidden.resize(keepHidden ? length_ : 0);
    if (recurrent_) pass.inputs = inputs_;
    pass.increments.resize(truth_.size());
    for (std::size_t k = 0; k < length_; ++k) {
        if (recurrent_ && k > 0) takeVelocity(pass.outputs[k - 1], pass.inputs[k]);
        engine.forward(parameters, recurrent_ ? pass.inputs[k] : inputs_[k], pass.outputs[k],
                       keepHidden ? &pass.hidden[k] : nullptr);
    }
    const auto& o = network_.outputs;
    parallelFor(chains(), [&](std::size_t chain) {
        for (std::size_t k = 0; k < length_; ++k) {
            const PatternMatrix& y = pass.outputs[k];
            pass.increments[chain * length_ + k] = {o[0].mean + o[0].scale * y(chain, 0),
                                                    o[1].mean + o[1].scale * y(chain, 1),
                                                    o[2].mean + o[2].scale * y(chain, 2)};
        }
    });
    return pass;
}

std::vector<Pose> RolloutBatch::predict(const MlpGradient& engine, std::span<const float> parameters) const {
    return forward(engine, parameters, false).increments;
}

/// So that the velocities which a network hands on to itself are velocities.
double RolloutBatch::addVelocityError(const Pass& pass, std::size_t chain, double weight,
                                      std::vector<PatternMatrix>& byOutput) const {
    double sum = 0;
    const double share = weight / static_cast<double>(length_), each = share / static_cast<double>(chains());
    for (std::size_t k = 0; k < length_; ++k)
        for (int c = 0; c < 2; ++c) {
            const double error = pass.outputs[k](chain, velocityOutputs + c) - velocities_[k](chain, c);
            sum += share * error * error;
            byOutput[k](chain, velocityOutputs + c) = static_cast<float>(2 * each * error);
        }
    return sum;
}

double RolloutBatch::lossAndGradient(const MlpGradient& engine, std::span<const float> parameters,
                                     const RolloutLoss& loss, std::span<double> gradient) const {
    const Pass pass = forward(engine, parameters, true);
    const int outputs = engine.shape().outputs;
    std::vector<PatternMatrix> byOutput(length_, PatternMatrix(chains(), outputs));
    std::vector<double> losses(chains());
    const double share = 1 / static_cast<double>(chains());
    parallelFor(chains(), [&](std::size_t chain) {
        std::vector<Pose> byIncrement(length_);
        losses[chain] = loss({&pass.increments[chain * length_], length_}, truth(chain), byIncrement);
        for (std::size_t k = 0; k < length_; ++k) {
            const Pose& g = byIncrement[k];
            byOutput[k](chain, 0) = static_cast<float>(share * network_.outputs[0].scale * g.x);
            byOutput[k](chain, 1) = static_cast<float>(share * network_.outputs[1].scale * g.y);
            byOutput[k](chain, 2) = static_cast<float>(share * network_.outputs[2].scale * g.heading);
        }
        if (recurrent_) losses[chain] += addVelocityError(pass, chain, loss.velocityWeight, byOutput);
    });
    std::fill(gradient.begin(), gradient.end(), 0);
    PatternMatrix byInput;
    for (std::size_t k = length_; k-- > 0;) {
        engine.backward(parameters, recurrent_ ? pass.inputs[k] : inputs_[k], byOutput[k], gradient, &pass.hidden[k],
                        recurrent_ && k > 0 ? &byInput : nullptr);
        if (recurrent_ && k > 0) returnVelocity(byInput, byOutput[k - 1]);
    }
    double sum = 0;
    for (const double l : losses) sum += l;
    return sum * share;
}

OpenLoopError openLoopError(const RolloutBatch& batch, std::span<const Pose> predicted, Nanoseconds period) {
    const std::size_t length = batch.length();
    const auto halfSecond = static_cast<std::size_t>(std::max<Nanoseconds>(1, nanosecondsPerSecond / 2 / period));
    ErrorSums sums;
    OpenLoopError result;
    for (std::size_t chain = 0; chain < batch.chains(); ++chain) {
        double chainPath = 0, chainRotation = 0;
        addTravelled(batch.truth(chain), halfSecond, chainPath, chainRotation);
        if (chainPath < 0.3 && chainRotation < 1.0) continue;
        Pose p, q;
        double positionSum = 0, headingSum = 0;
        for (std::size_t k = 0; k < length; ++k) {
            p = p * predicted[chain * length + k];
            q = q * batch.truth(chain)[k];
            positionSum += distance(position(q), position(p));
            headingSum += std::abs(p.heading - q.heading);
        }
        sums.add(positionSum / static_cast<double>(length), headingSum / static_cast<double>(length), chainPath,
                 chainRotation);
        ++result.windows;
    }
    if (sums.path > 0) result.position = sums.percentErrors().p;
    if (sums.rotation > 0) result.heading = sums.percentErrors().hd;
    return result;
}

}  // namespace mrose
