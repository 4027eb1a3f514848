#include "identification/sensor_trainer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "identification/constant_noise_fit.h"
#include "identification/likelihood_objective.h"
#include "identification/reading_noise_fit.h"
#include "identification/sensor_blueprint.h"
#include "identification/sound_errors.h"
#include "identification/tree_growing.h"
#include "learning/initial_weights.h"
#include "perception/learned_sensor.h"

namespace mrose {
namespace {

using Half = SensorHalf;

constexpr std::size_t fewestReadings = 200;

int foldOf(int block, int folds) { return (block % folds + folds) % folds; }

/// Cases by which one half is learned, or by which it is validated.
struct Patterns {
    std::vector<std::size_t> cases;
    LikelihoodData data;
};

/// Which of the network's inputs one half reads.
struct HalfInputs {
    std::vector<int> places;
    std::vector<NetworkVariable> variables;
};

/// What was learned from a part of the samples.
struct Learned {
    Regressor regressor;
    double loss = 0;  ///< mean, of what was held out
    int epochs = 0;   ///< after which that was
};

class SensorLearner {
public:
    SensorLearner(const SensorNetwork& network, const SensorSamples& samples, const SensorTrainerOptions& options,
                  const Progress& progress)
        : network_(network),
          samples_(samples),
          options_(options),
          progress_(progress),
          steps_(options.reported.folds + options.error.folds + 2.0) {
        const std::vector<NetworkVariable>& inputs = network.learned.inputs;
        for (std::size_t i = 0; i < inputs.size(); ++i)
            for (const Half half : {Half::reported, Half::error}) {
                if (half == Half::error && !isReadForErrors(inputs[i].name)) continue;
                of(half).places.push_back(static_cast<int>(i));
                of(half).variables.push_back(inputs[i]);
            }
        for (const SampledLook& look : samples.looks)
            for (std::size_t i = 0; i < look.count; ++i) cases_.push_back({look.robot, look.block, look.unknown});
    }

    /// From all samples but those of a fold. Nothing: progress ended it.
    std::optional<Learned> withoutFold(Half half, int fold) {
        return learned(half, fold, patternsOf(half, [&](const Case& one) { return foldOf(half, one) != fold; }),
                       patternsOf(half, [&](const Case& one) { return foldOf(half, one) == fold; }), {});
    }
    /// From all, for so many epochs.
    std::optional<Learned> fromAll(Half half, int epochs) {
        const Patterns all = patternsOf(half, [](const Case&) { return true; });
        return learned(half, how(half).folds, all, all, epochs);
    }

    std::size_t casesOf(Half half, int fold) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < cases_.size(); ++i) count += foldOf(half, cases_[i]) == fold && isOf(half, i);
        return count;
    }
    std::int64_t epochs() const { return epochs_; }

private:
    /// As SampledLook says.
    struct Case {
        int robot = -1, block = 0;
        bool unknown = false;
    };

    const SensorHalfOptions& how(Half half) const {
        return half == Half::reported ? options_.reported : options_.error;
    }
    int foldOf(Half half, const Case& one) const { return mrose::foldOf(one.block, how(half).folds); }

    HalfInputs& of(Half half) { return inputs_[static_cast<std::size_t>(half)]; }
    bool isOf(Half half, std::size_t i) const {
        return half == Half::reported || (samples_.cases[i].reported && !cases_[i].unknown);
    }
    std::vector<NetworkVariable> outputsOf(Half half) const {
        const std::vector<NetworkVariable>& all = network_.learned.outputs;
        const auto member = all.begin() + ReadingForm::errors;
        return half == Half::reported ? std::vector(all.begin(), member)
                                      : std::vector(member, member + network_.form.memberOutputs());
    }

    template <class Takes>
    Patterns patternsOf(Half half, const Takes& takes) {
        Patterns patterns;
        for (std::size_t i = 0; i < cases_.size(); ++i)
            if (takes(cases_[i]) && isOf(half, i)) patterns.cases.push_back(i);
        patterns.data.outputs = outputsOf(half);
        const SensorInputs inputs(of(half).variables, network_.robots);
        std::vector<float> row(inputs.width());
        patterns.data.inputs.resize(patterns.cases.size(), static_cast<int>(row.size()));
        for (std::size_t p = 0; p < patterns.cases.size(); ++p) {
            const std::size_t i = patterns.cases[p];
            inputs.read(samples_.cases[i].state, cases_[i].robot, row.data());
            for (std::size_t k = 0; k < row.size(); ++k) patterns.data.inputs(p, static_cast<int>(k)) = row[k];
        }
        return patterns;
    }

    /// The loss refers to the patterns' cases.
    void setLoss(Half half, Patterns& patterns) const {
        const std::vector<SensorCase>& cases = samples_.cases;
        const std::vector<std::size_t>& of = patterns.cases;
        if (half == Half::reported)
            patterns.data.loss = [&cases, &of](std::size_t p, std::span<const double> values, double* gradient) {
                return reportLoss(values[0], cases[of[p]].reported, gradient);
            };
        else
            patterns.data.loss = [&cases, &of, this](std::size_t p, std::span<const double> values, double* gradient) {
                return errorLoss(network_.form, values.data(), network_.gross, cases[of[p]].error, gradient);
            };
    }

    /// With the epochs that are given, otherwise with as many as predict best what is held out.
    std::optional<Learned> learned(Half half, int part, Patterns from, Patterns heldOut, std::optional<int> epochs) {
        if (!mayGoOn(progress_, done_ / steps_)) return std::nullopt;
        setLoss(half, from);
        setLoss(half, heldOut);
        Learned learned;
        if (options_.family == RegressorFamily::trees) {
            learned.regressor = grown(half, from);
            learned.loss = meanLoss(learned.regressor, heldOut);
        } else if (!fit(half, part, from, heldOut, epochs, learned)) {
            return std::nullopt;
        }
        learned.regressor =
            amongInputs(learned.regressor, static_cast<int>(network_.learned.inputs.size()), of(half).places);
        ++done_;
        return learned;
    }

    bool fit(Half half, int part, const Patterns& from, const Patterns& heldOut, std::optional<int> epochs,
             Learned& learned) {
        TrainingOptions training;
        training.rprop.firstStep = 0.01;
        training.rprop.largestStep = 1;
        training.epochs = epochs.value_or(how(half).epochs);
        training.patience = options_.patience;
        training.validateEvery = epochs.value_or(20);
        if (options_.family == RegressorFamily::network) {
            training.weightDecay = how(half).weightDecay;
            NetworkLikelihood objective(from.data, heldOut.data, how(half).hidden);
            const std::uint64_t seed =
                64 * options_.seed + 2 * static_cast<std::uint64_t>(part) + static_cast<std::uint64_t>(half);
            Mlp network =
                randomMlp(objective.engine()->shape(), {.seed = seed, .hiddenScale = 1.5, .outputScale = 0.3});
            if (!train(objective, network.parameters, training, learned)) return false;
            learned.regressor = std::move(network);
            return true;
        }
        LookupTable table =
            sensorTableFor(of(half).variables, network_, half, static_cast<int>(from.data.outputs.size()));
        TableLikelihood objective(from.data, heldOut.data, table, options_.roughness);
        std::vector<float> values(objective.parameterCount());
        if (!train(objective, values, training, learned)) return false;
        const float* next = values.data();
        for (LookupTable::Grid& grid : table.grids) {
            std::copy_n(next, grid.values.size(), grid.values.begin());
            next += grid.values.size();
        }
        learned.regressor = std::move(table);
        return true;
    }

    /// False: progress ended it.
    bool train(TrainingObjective& objective, std::vector<float>& parameters, const TrainingOptions& training,
               Learned& learned) {
        TrainingResult result = mrose::train(objective, parameters, training, [&](const TrainingProgress& at) {
            return mayGoOn(progress_, (done_ + static_cast<double>(at.epoch) / training.epochs) / steps_);
        });
        learned.loss = result.validationError;
        learned.epochs = result.bestEpoch;
        epochs_ += result.epochs;
        if (!result.parameters.empty()) parameters = std::move(result.parameters);
        return result.end != TrainingEnd::stopped;
    }

    DecisionTrees grown(Half half, const Patterns& from) const {
        TreeOptions growing;
        growing.trees = options_.trees;
        growing.seed = 2 * options_.seed + static_cast<std::uint64_t>(half);
        return half == Half::reported ? growReportTrees(from.data, reportsOf(from), growing)
                                      : growErrorTrees(from.data, errorsOf(from), growing);
    }

    std::vector<bool> reportsOf(const Patterns& patterns) const {
        std::vector<bool> reports;
        for (const std::size_t i : patterns.cases) reports.push_back(samples_.cases[i].reported);
        return reports;
    }
    std::vector<std::vector<double>> errorsOf(const Patterns& patterns) const {
        std::vector<std::vector<double>> errors(static_cast<std::size_t>(network_.form.dimensions));
        for (const std::size_t i : patterns.cases)
            for (std::size_t d = 0; d < errors.size(); ++d) errors[d].push_back(samples_.cases[i].error[d]);
        return errors;
    }

    double meanLoss(const Regressor& regressor, const Patterns& patterns) const {
        const LikelihoodData& data = patterns.data;
        const RegressorInference inference(regressor);
        const std::vector<float> rows = data.inputs.toRows();
        const std::size_t count = data.inputs.patterns(), width = data.outputs.size();
        std::vector<float> outputs(count * width);
        inference.batch(rows.data(), outputs.data(), count);
        std::array<double, LearnedNetwork::maxOutputs> values, slope;
        double sum = 0;
        for (std::size_t p = 0; p < count; ++p) {
            for (std::size_t k = 0; k < width; ++k)
                values[k] = data.outputs[k].mean + data.outputs[k].scale * static_cast<double>(outputs[p * width + k]);
            sum += data.loss(p, std::span(values).first(width), slope.data());
        }
        return sum / static_cast<double>(std::max<std::size_t>(count, 1));
    }

    const SensorNetwork& network_;
    const SensorSamples& samples_;
    const SensorTrainerOptions& options_;
    const Progress& progress_;
    std::array<HalfInputs, 2> inputs_;  ///< by Half
    std::vector<Case> cases_;
    double done_ = 0, steps_;  ///< times that something is learned
    std::int64_t epochs_ = 0;
};

/// As many folds as are asked for, or as the samples have blocks to judge by: of fewer than 2, 0.
int foldsOf(const SensorSamples& samples, int asked) {
    for (int folds = asked; folds >= 2; --folds) {
        std::vector<std::size_t> readings(static_cast<std::size_t>(folds));
        for (const SampledLook& look : samples.looks)
            for (std::size_t i = 0; i < look.count && !look.unknown; ++i)
                readings[static_cast<std::size_t>(foldOf(look.block, folds))] += samples.cases[look.first + i].reported;
        if (*std::ranges::min_element(readings) >= fewestReadings / 10) return folds;
    }
    return 0;
}

/// The middle one of what was best for the folds.
int usualEpochs(std::vector<int> epochs) {
    std::sort(epochs.begin(), epochs.end());
    return epochs[epochs.size() / 2];
}

tl::unexpected<Error> cancelled() { return fail("", "was not learned from: cancelled"); }

/// What a half's folds say.
struct Folds {
    std::vector<Regressor> regressors;
    double score = 0;  ///< mean logarithm of the likelihood of what was held out
    std::int64_t cases = 0;
    int epochs = 0;
};
Expected<Folds> learnFolds(SensorLearner& learner, Half half, int count) {
    Folds folds;
    std::vector<int> epochs;
    double loss = 0;
    for (int fold = 0; fold < count; ++fold) {
        auto learned = learner.withoutFold(half, fold);
        if (!learned) return cancelled();
        const auto cases = static_cast<std::int64_t>(learner.casesOf(half, fold));
        loss += learned->loss * static_cast<double>(cases);
        folds.cases += cases;
        epochs.push_back(learned->epochs);
        folds.regressors.push_back(std::move(learned->regressor));
    }
    folds.epochs = usualEpochs(std::move(epochs));
    folds.score = -loss / static_cast<double>(folds.cases);
    if (!std::isfinite(folds.score)) return fail("", "cannot be learned from: its likelihood is no number");
    return folds;
}

/// Why a network of such inputs cannot be.
std::string objection(const SensorNetwork& network) {
    if (network.learned.inputs.size() > LearnedNetwork::maxInputs)
        return "holds " + std::to_string(network.robots.size()) + " robots; at most " +
               std::to_string(LearnedNetwork::maxInputs - (network.learned.inputs.size() - network.robots.size())) +
               " can be told apart";
    return {};
}

}  // namespace

Expected<SensorNetwork> trainSensor(const SensorNetwork& blueprint, const SensorSamples& samples,
                                    const SensorTrainerOptions& asked, const Progress& progress) {
    SensorTrainerOptions options = asked;
    if (asked.family != RegressorFamily::network) options.error.folds = asked.reported.folds;
    for (SensorHalfOptions* half : {&options.reported, &options.error}) half->folds = foldsOf(samples, half->folds);
    const bool isNetwork = options.family == RegressorFamily::network;
    assert(!isNetwork || options.error.folds <= ReadingForm::maxMembers);
    const std::size_t readings = samples.readings();
    if (readings < fewestReadings)
        return fail("", "holds " + std::to_string(readings) + " readings of what is known; learning needs " +
                            std::to_string(fewestReadings));
    if (options.reported.folds == 0 || options.error.folds == 0)
        return fail("", "is too short to hold out a part of it: less than a few minutes");
    SensorNetwork network = blueprint;
    network.robots = samples.robots;
    network.form = {static_cast<int>(dimensionsOf(network.measures).size()), isNetwork ? options.components : 1,
                    isNetwork ? options.error.folds : 1};
    const SoundErrors sound = soundErrors(samples, network.form.dimensions);
    network.gross = grossErrors(samples, sound);
    network.constant = fitConstantNoise(network, samples, sound);
    network.learned.kind = SensorNetwork::kind;
    network.learned.inputs = sensorInputsFor(network, samples);
    network.learned.outputs = sensorOutputsFor(network, samples, sound);
    if (const std::string reason = objection(network); !reason.empty()) return fail("", reason);
    SensorLearner learner(network, samples, options, progress);
    const auto reports = learnFolds(learner, Half::reported, options.reported.folds);
    if (!reports) return tl::unexpected(reports.error());
    auto errors = learnFolds(learner, Half::error, options.error.folds);
    if (!errors) return tl::unexpected(errors.error());
    const auto report = learner.fromAll(Half::reported, reports->epochs);
    if (!report) return cancelled();
    if (!isNetwork) {
        auto error = learner.fromAll(Half::error, errors->epochs);
        if (!error) return cancelled();
        errors->regressors = {std::move(error->regressor)};
    }
    network.learned.regressor = report->regressor;
    for (const Regressor& member : errors->regressors)
        network.learned.regressor = sideBySide(network.learned.regressor, member);
    network.heldOut = {std::ranges::count_if(samples.looks, [](const SampledLook& look) { return !look.unknown; }),
                       reports->cases, errors->cases, reports->score, errors->score};
    network.learned.training.method = options.family == RegressorFamily::trees ? "trees" : "irprop+";
    network.learned.training.loss = "likelihood";
    network.learned.training.seed = options.seed;
    network.learned.training.patterns = static_cast<std::int64_t>(samples.cases.size());
    network.learned.training.epochs = learner.epochs();
    network.noise = fitReadingNoises(LearnedSensor(network), samples);
    mayGoOn(progress, 1);
    return network;
}

}  // namespace mrose
