#include "identification/network_trainer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "identification/velocity_outputs.h"
#include "learning/initial_weights.h"
#include "learning/levenberg_marquardt.h"
#include "learning/rprop.h"

namespace mrose {
namespace {

using Form = MotionNetwork::Form;

struct Moments {
    double sum = 0, squares = 0;
    void add(double x) {
        sum += x;
        squares += x * x;
    }
    double mean(double count) const { return sum / count; }
    double deviation(double count) const {
        return std::sqrt(std::max(squares / count - mean(count) * mean(count), 0.0));
    }
};

std::array<double, 5> targetsOf(const MotionSample& sample) {
    return {sample.increment.x, sample.increment.y, sample.increment.heading, sample.after.v, sample.after.w};
}

/// Means and scales of inputs and outputs over all samples. What never changes gets scale 1.
void standardise(const MotionSamples& samples, MotionNetwork& network) {
    const auto count = static_cast<double>(samples.samples.size());
    std::vector<Moments> inputs(samples.width), outputs(5);
    for (std::size_t s = 0; s < samples.samples.size(); ++s) {
        const auto row = samples.inputsOf(s);
        for (std::size_t i = 0; i < row.size(); ++i) inputs[i].add(row[i]);
        const auto targets = targetsOf(samples.samples[s]);
        for (std::size_t k = 0; k < outputs.size(); ++k) outputs[k].add(targets[k]);
    }
    const auto scale = [&](const Moments& m) { return m.deviation(count) > 1e-9 ? m.deviation(count) : 1.0; };
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        network.inputs[i].mean = inputs[i].mean(count);
        network.inputs[i].scale = scale(inputs[i]);
    }
    network.outputs.clear();
    for (const Moments& m : std::span(outputs).first(network.form == Form::state ? 5 : 3))
        network.outputs.push_back({m.mean(count), scale(m)});
}

RpropOptions rpropOptions(LearningMethod method) {
    RpropOptions options;
    options.firstStep = 0.01;
    if (method == LearningMethod::irpropMinus) options.variant = RpropVariant::iRpropMinus;
    if (method == LearningMethod::rpropPlus) options.variant = RpropVariant::rpropPlus;
    if (method == LearningMethod::rpropMinus) options.variant = RpropVariant::rpropMinus;
    return options;
}

template <class Predicate>
std::size_t longestRun(const MotionSamples& samples, Predicate wanted) {
    std::size_t longest = 1;
    for (const SampleRun& run : samples.runs)
        if (wanted(run)) longest = std::max(longest, run.count);
    return longest;
}

/// What is learned from: all patterns but those of one fold, as chains or as single steps.
class LearningSet {
public:
    LearningSet(const MotionSamples& samples, const MotionNetwork& network, const TrainerOptions& options, int heldOut)
        : engine_({int(samples.width), options.hidden, int(network.outputs.size())}), loss_(options.rolloutLoss) {
        const auto learned = [&](const SampleRun& run) { return run.fold != heldOut; };
        const auto length = std::min(static_cast<std::size_t>(options.rolloutLength), longestRun(samples, learned));
        if (options.loss == LearningLoss::rollout)
            chains_.emplace(samples, network, chainStarts(samples, length, length, learned), length);
        else
            gatherSteps(samples, network, chainStarts(samples, 1, 1, learned));
    }

    const MlpGradient& engine() const { return engine_; }
    std::size_t patterns() const { return chains_ ? chains_->chains() * chains_->length() : targets_.patterns(); }
    const PatternMatrix& inputs() const { return inputs_; }    ///< of single steps
    const PatternMatrix& targets() const { return targets_; }  ///< likewise

    double lossAndGradient(std::span<const float> parameters, std::span<double> gradient) const {
        return chains_ ? chains_->lossAndGradient(engine_, parameters, loss_, gradient)
                       : engine_.meanSquaredError(parameters, inputs_, targets_, gradient);
    }

private:
    void gatherSteps(const MotionSamples& samples, const MotionNetwork& network, const std::vector<std::size_t>& rows) {
        inputs_ = PatternMatrix(rows.size(), int(network.inputs.size()));
        targets_ = PatternMatrix(rows.size(), int(network.outputs.size()));
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const auto raw = samples.inputsOf(rows[r]);
            for (std::size_t i = 0; i < raw.size(); ++i)
                inputs_(r, int(i)) = float((raw[i] - network.inputs[i].mean) / network.inputs[i].scale);
            const auto y = targetsOf(samples.samples[rows[r]]);
            for (std::size_t k = 0; k < network.outputs.size(); ++k)
                targets_(r, int(k)) = float((y[k] - network.outputs[k].mean) / network.outputs[k].scale);
        }
    }

    MlpGradient engine_;
    RolloutLoss loss_;
    std::optional<RolloutBatch> chains_;
    PatternMatrix inputs_, targets_;
};

/// The chains of one fold that nothing is learned from, `horizon` long or as long as the fold's longest run.
RolloutBatch heldOutChains(const MotionSamples& samples, const MotionNetwork& network, double horizon, int fold) {
    const auto isHeldOut = [&](const SampleRun& run) { return run.phase == 0 && run.fold == fold; };
    const std::size_t longest = longestRun(samples, isHeldOut);
    const auto wanted = static_cast<std::size_t>(std::llround(horizon / toSeconds(samples.period)));
    const std::size_t steps = std::min(wanted, longest);
    return {samples, network, chainStarts(samples, steps, std::max<std::size_t>(1, steps / 10), isHeldOut), steps};
}

/// A network while it learns, and the best that it was.
struct Member {
    std::vector<float> parameters, best;
    OpenLoopError bestError;
    double bestScore = std::numeric_limits<double>::infinity();
    int epochs = 0, bestEpoch = 0;
    bool cancelled = false;
};

/// One epoch of any method; its loss.
using Epoch = std::function<double(std::span<float> parameters)>;

Epoch epochsBy(LearningMethod method, const LearningSet& set) {
    if (method == LearningMethod::levenbergMarquardt)
        return [optimiser = LevenbergMarquardt(set.engine(), set.inputs(), set.targets())](
                   std::span<float> parameters) mutable {
            optimiser.step(parameters);
            return optimiser.loss();
        };
    const std::size_t count = set.engine().shape().parameterCount();
    return [&set, rprop = Rprop(count, rpropOptions(method)),
            gradient = std::vector<double>(count)](std::span<float> parameters) mutable {
        const double loss = set.lossAndGradient(parameters, gradient);
        rprop.step(parameters, gradient, loss);
        return loss;
    };
}

Member learn(const LearningSet& set, const RolloutBatch& heldOut, const TrainerOptions& options, int index,
             Nanoseconds period, const ProgressCallback& progress) {
    Member member;
    const std::uint64_t seed = options.seed * 1000 + static_cast<std::uint64_t>(index);
    member.parameters = randomMlp(set.engine().shape(), {.seed = seed}).parameters;
    const Epoch epoch = epochsBy(options.method, set);
    while (member.epochs < options.epochs && !member.cancelled) {
        const double loss = epoch(member.parameters);
        if (++member.epochs % options.evaluateEvery != 0 && member.epochs < options.epochs) continue;
        const OpenLoopError error = openLoopError(heldOut, heldOut.predict(set.engine(), member.parameters), period);
        const double score = error.position + 0.5 * error.heading;
        if (score < member.bestScore) {
            member.bestScore = score;
            member.bestError = error;
            member.best = member.parameters;
            member.bestEpoch = member.epochs;
        }
        member.cancelled =
            progress && !progress({index, options.members, member.epochs, options.epochs, loss, member.bestError});
        if (!std::isfinite(loss) || member.epochs - member.bestEpoch >= options.patience) break;
    }
    return member;
}

/// The mean of the members' outputs, as one network: their hidden layers side by side.
Mlp meanOf(const std::vector<Member>& members, const MlpShape& one) {
    const auto count = static_cast<int>(members.size());
    const auto ni = static_cast<std::size_t>(one.inputs), nh = static_cast<std::size_t>(one.hidden);
    std::vector<float> weights, biases, outWeights, outBiases(static_cast<std::size_t>(one.outputs));
    for (const Member& member : members) {
        const float* p = member.best.data();
        weights.insert(weights.end(), p, p + nh * ni);
        biases.insert(biases.end(), p + nh * ni, p + nh * (ni + 1));
    }
    for (std::size_t k = 0; k < outBiases.size(); ++k)
        for (const Member& member : members) {
            const float* p = member.best.data() + nh * (ni + 1);
            for (std::size_t j = 0; j < nh; ++j) outWeights.push_back(p[k * nh + j] / float(count));
            outBiases[k] += p[outBiases.size() * nh + k] / float(count);
        }
    Mlp mlp{{one.inputs, one.hidden * count, one.outputs}, std::move(weights)};
    for (const auto* part : {&biases, &outWeights, &outBiases})
        mlp.parameters.insert(mlp.parameters.end(), part->begin(), part->end());
    return mlp;
}

std::string methodName(LearningMethod method) {
    switch (method) {
        case LearningMethod::irpropPlus:
            return "irprop+";
        case LearningMethod::irpropMinus:
            return "irprop-";
        case LearningMethod::rpropPlus:
            return "rprop+";
        case LearningMethod::rpropMinus:
            return "rprop-";
        case LearningMethod::levenbergMarquardt:
            return "lm";
    }
    return {};
}

void describe(const std::vector<Member>& members, const TrainerOptions& options, double horizon,
              MotionNetwork& network) {
    network.training.method = methodName(options.method);
    network.training.loss = options.loss == LearningLoss::rollout ? "rollout" : "one-step";
    network.training.seed = options.seed;
    network.heldOut.horizon = horizon;
    const double share = 1 / static_cast<double>(members.size());
    for (const Member& member : members) {
        network.training.epochs += member.epochs;
        network.heldOut.windows += member.bestError.windows;
        network.heldOut.position += share * member.bestError.position;
        network.heldOut.heading += share * member.bestError.heading;
    }
}

}  // namespace

Expected<TrainingSummary> trainNetwork(const MotionNetwork& blueprint, const MotionSamples& samples,
                                       const TrainerOptions& options, const ProgressCallback& progress) {
    assert(options.method != LearningMethod::levenbergMarquardt || options.loss == LearningLoss::oneStep);
    TrainingSummary summary;
    MotionNetwork& network = summary.network;
    network = blueprint;
    standardise(samples, network);
    std::vector<Member> members;
    MlpShape shape;
    double horizon = 0;
    for (int m = 0; m < options.members && !summary.cancelled; ++m) {
        const int fold = m % samples.folds;
        const LearningSet set(samples, network, options, fold);
        const RolloutBatch heldOut = heldOutChains(samples, network, options.horizon, fold);
        if (set.patterns() == 0 || heldOut.chains() == 0)
            return fail("", "the logs are too short: part " + std::to_string(fold + 1) + " of " +
                                std::to_string(samples.folds) + " leaves nothing to learn from or to hold out");
        Member member = learn(set, heldOut, options, m, samples.period, progress);
        if (member.best.empty()) return fail("", "learning diverged: the loss is not a finite number");
        summary.cancelled = member.cancelled;
        shape = set.engine().shape();
        horizon = toSeconds(samples.period) * static_cast<double>(heldOut.length());
        network.training.patterns = std::max(network.training.patterns, static_cast<std::int64_t>(set.patterns()));
        // A member that was cut off is worse than the others; it counts only where it is all there is.
        if (!member.cancelled || members.empty()) members.push_back(std::move(member));
    }
    network.mlp = meanOf(members, shape);
    describe(members, options, horizon, network);
    if (network.form == Form::history) addVelocityOutputs(samples, network);
    return summary;
}

}  // namespace mrose
