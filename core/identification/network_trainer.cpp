#include "identification/network_trainer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "identification/velocity_outputs.h"
#include "learning/ensemble.h"
#include "learning/initial_weights.h"

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

/// Of the runs from their pattern `first(run)` on.
template <class First>
std::size_t longestRun(const MotionSamples& samples, First first) {
    std::size_t longest = 1;
    for (const SampleRun& run : samples.runs) longest = std::max(longest, run.count - first(run));
    return longest;
}

/// The chains of one fold that nothing is learned from, `horizon` long or as long as the fold's longest run.
RolloutBatch heldOutChains(const MotionSamples& samples, const MotionNetwork& network, double horizon, int fold) {
    const auto heldOut = [&](const SampleRun& run) { return run.phase == 0 && run.fold == fold ? 0 : run.count; };
    const std::size_t longest = longestRun(samples, heldOut);
    const auto wanted = static_cast<std::size_t>(std::llround(horizon / toSeconds(samples.period)));
    const std::size_t steps = std::min(wanted, longest);
    return {samples, network, chainStarts(samples, steps, std::max<std::size_t>(1, steps / 10), heldOut), steps};
}

/// Learned from: all patterns but those of one fold and those that read it, as chains or as single steps. Held out:
/// that fold, open loop.
class MotionObjective final : public TrainingObjective {
public:
    MotionObjective(const MotionSamples& samples, const MotionNetwork& network, const NetworkTrainerOptions& options,
                    int fold)
        : engine_({int(samples.width), options.hidden, int(network.outputs.size())}),
          loss_(options.rolloutLoss),
          heldOut_(heldOutChains(samples, network, options.horizon, fold)),
          period_(samples.period) {
        const auto learned = [&](const SampleRun& run) { return run.firstLearned(fold); };
        const auto length = std::min(static_cast<std::size_t>(options.rolloutLength), longestRun(samples, learned));
        if (options.loss == LearningLoss::rollout)
            chains_.emplace(samples, network, chainStarts(samples, length, length, learned), length);
        if (options.loss == LearningLoss::oneStep || options.linearStart)
            gatherSteps(samples, network, chainStarts(samples, 1, 1, learned));
    }

    Mlp start(const NetworkTrainerOptions& options, std::uint64_t seed) const {
        Mlp first = randomMlp(engine_.shape(), {.seed = seed});
        if (options.linearStart) startLinear(first, steps_);
        return first;
    }

    const MlpGradient* engine() const override { return &engine_; }
    double lossAndGradient(std::span<const float> parameters, std::span<double> gradient) const override {
        return chains_ ? chains_->lossAndGradient(engine_, parameters, loss_, gradient)
                       : engine_.meanSquaredError(parameters, steps_.inputs, steps_.targets, gradient);
    }
    double validationError(std::span<const float> parameters) override {
        lastError_ = openLoopError(heldOut_, heldOut_.predict(engine_, parameters), period_);
        return lastError_.position + 0.5 * lastError_.heading;
    }
    const PatternSet* patterns() const override { return chains_ ? nullptr : &steps_; }

    /// Of the last validation.
    const OpenLoopError& lastError() const { return lastError_; }
    std::size_t learnedPatterns() const {
        return chains_ ? chains_->chains() * chains_->length() : steps_.inputs.patterns();
    }
    std::size_t heldOutChainCount() const { return heldOut_.chains(); }
    double horizon() const { return toSeconds(period_) * static_cast<double>(heldOut_.length()); }

private:
    void gatherSteps(const MotionSamples& samples, const MotionNetwork& network, const std::vector<std::size_t>& rows) {
        steps_ = {PatternMatrix(rows.size(), int(network.inputs.size())),
                  PatternMatrix(rows.size(), int(network.outputs.size()))};
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const auto raw = samples.inputsOf(rows[r]);
            for (std::size_t i = 0; i < raw.size(); ++i)
                steps_.inputs(r, int(i)) = float((raw[i] - network.inputs[i].mean) / network.inputs[i].scale);
            const auto y = targetsOf(samples.samples[rows[r]]);
            for (std::size_t k = 0; k < network.outputs.size(); ++k)
                steps_.targets(r, int(k)) = float((y[k] - network.outputs[k].mean) / network.outputs[k].scale);
        }
    }

    MlpGradient engine_;
    RolloutLoss loss_;
    std::optional<RolloutBatch> chains_;
    PatternSet steps_;
    RolloutBatch heldOut_;
    Nanoseconds period_;
    OpenLoopError lastError_;
};

/// One network of the ensemble, as it was when it was best.
struct Member {
    Mlp mlp;
    OpenLoopError error;
    int epochs = 0;
    bool cancelled = false;
};

Member learn(MotionObjective& objective, const NetworkTrainerOptions& options, int index,
             const NetworkProgressCallback& progress) {
    TrainingOptions training;
    training.method = options.method;
    training.rprop.firstStep = 0.01;
    training.epochs = options.epochs;
    training.validateEvery = options.evaluateEvery;
    training.patience = options.patience;
    Member member;
    const auto report = [&](const TrainingProgress& p) {
        if (p.bestEpoch == p.epoch) member.error = objective.lastError();
        return !progress || progress({index, options.members, p.epoch, options.epochs, p.loss, member.error});
    };
    const std::uint64_t seed = options.seed * 1000 + static_cast<std::uint64_t>(index);
    Mlp first = objective.start(options, seed);
    TrainingResult result = train(objective, std::move(first.parameters), training, report);
    member.mlp = {first.shape, std::move(result.parameters)};
    member.epochs = result.epochs;
    member.cancelled = result.end == TrainingEnd::stopped;
    return member;
}

/// As one network, which knows its members.
void merge(const std::vector<Member>& members, MotionNetwork& network) {
    std::vector<Mlp> networks;
    for (const Member& member : members) networks.push_back(member.mlp);
    network.mlp = mergedMean(networks);
    network.members = networks.size() > 1 ? membersOf(networks) : std::vector<EnsembleMember>();
}

void describe(const std::vector<Member>& members, const NetworkTrainerOptions& options, double horizon,
              MotionNetwork& network) {
    network.training.method = nameOf(options.method);
    network.training.loss = options.loss == LearningLoss::rollout ? "rollout" : "one-step";
    network.training.seed = options.seed;
    network.heldOut.horizon = horizon;
    const double share = 1 / static_cast<double>(members.size());
    for (const Member& member : members) {
        network.training.epochs += member.epochs;
        network.heldOut.windows += member.error.windows;
        network.heldOut.position += share * member.error.position;
        network.heldOut.heading += share * member.error.heading;
    }
}

/// Told before anything is learned, of whatever part.
Expected<void> checkParts(const MotionSamples& samples, const MotionNetwork& network,
                          const NetworkTrainerOptions& options) {
    for (int fold = 0; fold < std::min(options.members, samples.folds); ++fold) {
        const MotionObjective objective(samples, network, options, fold);
        if (objective.learnedPatterns() == 0 || objective.heldOutChainCount() == 0)
            return fail("", "the logs are too short: part " + std::to_string(fold + 1) + " of " +
                                std::to_string(samples.folds) +
                                " leaves nothing to learn from or to hold out; expected longer logs, or more of them" +
                                (samples.folds > leastFolds ? ", or fewer parts (--folds)" : ""));
    }
    return {};
}

}  // namespace

Expected<TrainedNetwork> trainNetwork(const MotionNetwork& blueprint, const MotionSamples& samples,
                                      const NetworkTrainerOptions& options, const NetworkProgressCallback& progress) {
    assert(options.method != TrainingMethod::levenbergMarquardt || options.loss == LearningLoss::oneStep);
    TrainedNetwork trained;
    MotionNetwork& network = trained.network;
    network = blueprint;
    standardise(samples, network);
    if (auto enough = checkParts(samples, network, options); !enough) return tl::unexpected(enough.error());
    std::vector<Member> members;
    double horizon = 0;
    for (int m = 0; m < options.members && !trained.cancelled; ++m) {
        const int fold = m % samples.folds;
        MotionObjective objective(samples, network, options, fold);
        Member member = learn(objective, options, m, progress);
        if (member.mlp.parameters.empty()) return fail("", "learning diverged: the loss is not a finite number");
        trained.cancelled = member.cancelled;
        horizon = objective.horizon();
        network.training.patterns =
            std::max(network.training.patterns, static_cast<std::int64_t>(objective.learnedPatterns()));
        // A member that was cut off is worse than the others; it counts only where it is all there is.
        if (!member.cancelled || members.empty()) members.push_back(std::move(member));
    }
    merge(members, network);
    describe(members, options, horizon, network);
    if (network.form == Form::history) addVelocityOutputs(samples, network);
    return trained;
}

}  // namespace mrose
