#include "identification/network_trainer.h"

#include <algorithm>
#include <cmath>

#include "identification/velocity_outputs.h"
#include "learning/initial_weights.h"
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

/// Means and scales of inputs and outputs over all samples. What never changes gets scale 1.
void standardise(const MotionSamples& samples, MotionNetwork& network) {
    const auto count = static_cast<double>(samples.samples.size());
    std::vector<Moments> inputs(samples.width), outputs(5);
    for (std::size_t s = 0; s < samples.samples.size(); ++s) {
        const auto row = samples.inputsOf(s);
        for (std::size_t i = 0; i < row.size(); ++i) inputs[i].add(row[i]);
        const MotionSample& sample = samples.samples[s];
        const double targets[] = {sample.increment.x, sample.increment.y, sample.increment.heading, sample.after.v,
                                  sample.after.w};
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

/// One network, learned with one fold held out.
class Member {
public:
    Member(const MotionNetwork& network, const MotionSamples& samples, const TrainerOptions& options, int index)
        : network_(network),
          options_(options),
          index_(index),
          shape_{int(samples.width), options.hidden, int(network.outputs.size())},
          engine_(shape_),
          heldOut_(samples, network, heldOutStarts(samples), horizonSteps(samples)),
          parameters_(randomMlp(shape_, {.seed = options.seed * 1000 + static_cast<std::uint64_t>(index)}).parameters),
          best_(parameters_) {
        const auto learned = [&](const SampleRun& run) { return samples.folds == 1 || run.fold != fold(samples); };
        if (options.loss == LearningLoss::rollout)
            rollouts_.emplace(samples, network, chainStarts(samples, rolloutLength(), rolloutLength(), learned),
                              rolloutLength());
        else
            gatherSteps(samples, learned);
    }

    bool canLearn() const { return patterns() > 0 && heldOut_.chains() > 0; }
    std::int64_t patterns() const {
        return static_cast<std::int64_t>(rollouts_ ? rollouts_->chains() * rollouts_->length() : targets_.patterns());
    }

    /// False when cancelled.
    bool learn(const ProgressCallback& progress) {
        Rprop rprop(shape_.parameterCount(), rpropOptions(options_.method));
        std::vector<double> gradient(shape_.parameterCount());
        bool cancelled = false;
        for (epochs_ = 1; epochs_ <= options_.epochs; ++epochs_) {
            const double loss = lossAndGradient(gradient);
            if (epochs_ % options_.evaluateEvery == 0 && !assess(loss, progress, cancelled)) break;
            rprop.step(parameters_, gradient, loss);
        }
        return !cancelled;
    }

    const std::vector<float>& best() const { return best_; }
    const OpenLoopError& bestError() const { return bestError_; }
    int epochs() const { return epochs_; }
    const MlpShape& shape() const { return shape_; }

private:
    std::size_t rolloutLength() const { return static_cast<std::size_t>(options_.rolloutLength); }
    int fold(const MotionSamples& samples) const { return index_ % samples.folds; }

    /// The horizon in periods, or the longest held-out run where that is shorter.
    std::size_t horizonSteps(const MotionSamples& samples) const {
        auto steps = static_cast<std::size_t>(std::llround(options_.horizon * 1e9 / double(samples.period)));
        std::size_t longest = 1;
        for (const SampleRun& run : samples.runs) longest = std::max(longest, run.count);
        return std::min(steps, longest);
    }
    std::vector<std::size_t> heldOutStarts(const MotionSamples& samples) const {
        const std::size_t steps = horizonSteps(samples);
        return chainStarts(samples, steps, std::max<std::size_t>(1, steps / 10),
                           [&](const SampleRun& run) { return run.phase == 0 && run.fold == fold(samples); });
    }

    template <class Predicate>
    void gatherSteps(const MotionSamples& samples, Predicate learned) {
        std::vector<std::size_t> rows = chainStarts(samples, 1, 1, learned);
        inputs_ = PatternMatrix(rows.size(), shape_.inputs);
        targets_ = PatternMatrix(rows.size(), shape_.outputs);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const auto raw = samples.inputsOf(rows[r]);
            for (std::size_t i = 0; i < raw.size(); ++i)
                inputs_(r, int(i)) = float((raw[i] - network_.inputs[i].mean) / network_.inputs[i].scale);
            const MotionSample& s = samples.samples[rows[r]];
            const double targets[] = {s.increment.x, s.increment.y, s.increment.heading, s.after.v, s.after.w};
            for (int k = 0; k < shape_.outputs; ++k)
                targets_(r, k) = float((targets[k] - network_.outputs[k].mean) / network_.outputs[k].scale);
        }
    }

    double lossAndGradient(std::span<double> gradient) const {
        return rollouts_ ? rollouts_->lossAndGradient(engine_, parameters_, options_.rolloutLoss, gradient)
                         : engine_.meanSquaredError(parameters_, inputs_, targets_, gradient);
    }

    /// Keeps the parameters if they are the best so far; false when it is time to stop.
    bool assess(double loss, const ProgressCallback& progress, bool& cancelled) {
        const OpenLoopError error = openLoopError(heldOut_, heldOut_.predict(engine_, parameters_), network_.period);
        const double score = error.position + 0.5 * error.heading;
        if (std::isfinite(score) && score < bestScore_) {
            bestScore_ = score;
            bestError_ = error;
            best_ = parameters_;
            bestEpoch_ = epochs_;
        }
        cancelled = progress && !progress({index_, options_.members, epochs_, options_.epochs, loss, bestError_});
        return !cancelled && epochs_ - bestEpoch_ < options_.patience && std::isfinite(loss);
    }

    const MotionNetwork& network_;
    const TrainerOptions& options_;
    int index_;
    MlpShape shape_;
    MlpGradient engine_;
    RolloutBatch heldOut_;
    std::optional<RolloutBatch> rollouts_;
    PatternMatrix inputs_, targets_;  ///< of one-step learning
    std::vector<float> parameters_, best_;
    OpenLoopError bestError_;
    double bestScore_ = std::numeric_limits<double>::infinity();
    int epochs_ = 0, bestEpoch_ = 0;
};

/// The mean of the members' outputs, as one network: their hidden layers side by side.
Mlp meanOf(const std::vector<Member>& members) {
    const MlpShape one = members.front().shape();
    const auto count = static_cast<int>(members.size());
    const auto ni = static_cast<std::size_t>(one.inputs), nh = static_cast<std::size_t>(one.hidden);
    std::vector<float> weights, biases, outWeights, outBiases(static_cast<std::size_t>(one.outputs));
    for (const Member& member : members) {
        const auto p = member.best().begin();
        weights.insert(weights.end(), p, p + nh * ni);
        biases.insert(biases.end(), p + nh * ni, p + nh * (ni + 1));
    }
    for (std::size_t k = 0; k < outBiases.size(); ++k)
        for (const Member& member : members) {
            const auto p = member.best().begin() + nh * (ni + 1);
            for (std::size_t j = 0; j < nh; ++j) outWeights.push_back(p[k * nh + j] / float(count));
            outBiases[k] += p[outBiases.size() * nh + k] / float(count);
        }
    Mlp mlp{{one.inputs, one.hidden * count, one.outputs}, std::move(weights)};
    for (const auto* part : {&biases, &outWeights, &outBiases})
        mlp.parameters.insert(mlp.parameters.end(), part->begin(), part->end());
    return mlp;
}

}  // namespace

Expected<TrainingSummary> trainNetwork(const MotionNetwork& blueprint, const MotionSamples& samples,
                                       const TrainerOptions& options, const ProgressCallback& progress) {
    TrainingSummary summary;
    summary.network = blueprint;
    standardise(samples, summary.network);
    const MotionNetwork network = summary.network;
    std::vector<Member> members;
    members.reserve(static_cast<std::size_t>(options.members));
    OpenLoopError& error = summary.heldOut;
    for (int m = 0; m < options.members && !summary.cancelled; ++m) {
        Member& member = members.emplace_back(network, samples, options, m);
        if (!member.canLearn())
            return fail("", "the logs are too short: part " + std::to_string(m + 1) + " of " +
                                std::to_string(samples.folds) + " has nothing to learn from or to hold out");
        summary.cancelled = !member.learn(progress);
        summary.network.training.epochs += member.epochs();
        summary.network.training.patterns = std::max(summary.network.training.patterns, member.patterns());
        error.position += member.bestError().position / options.members;
        error.heading += member.bestError().heading / options.members;
        error.windows += member.bestError().windows;
    }
    summary.network.mlp = meanOf(members);
    if (network.form == Form::history) addVelocityOutputs(samples, summary.network);
    return summary;
}

}  // namespace mrose
