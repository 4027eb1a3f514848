#include "identification/sensor_trainer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/normal_distribution.h"
#include "identification/constant_noise_fit.h"
#include "identification/likelihood_objective.h"
#include "identification/reading_noise_fit.h"
#include "identification/robust_statistics.h"
#include "identification/sensor_blueprint.h"
#include "identification/tree_growing.h"
#include "learning/initial_weights.h"
#include "perception/learned_sensor.h"

namespace mrose {
namespace {

using Half = SensorHalf;

constexpr std::size_t fewestReadings = 200;

/// Cases by which one half is learned, or by which it is validated.
struct Patterns {
    std::vector<std::size_t> cases;
    LikelihoodData data;
};

class SensorLearner {
public:
    SensorLearner(SensorNetwork& network, const SensorSamples& samples, const SensorTrainerOptions& options)
        : network_(network), samples_(samples), options_(options), inputs_(network.learned.inputs, network.robots) {
        for (const NetworkVariable& input : network.learned.inputs) {
            read_[0].push_back(true);
            read_[1].push_back(isReadForErrors(input.name));
        }
        for (const SampledLook& look : samples.looks)
            for (std::size_t i = 0; i < look.count; ++i) {
                robots_.push_back(look.robot);
                folds_.push_back(look.block % options.folds);
                unknown_.push_back(look.unknown);
            }
    }

    /// How one fold was predicted by what was learned from the others.
    struct FoldScore {
        double loss = 0;  ///< mean
        std::size_t cases = 0;
        int epochs = 0;  ///< after which that was
    };
    FoldScore validate(Half half, int fold, Regressor& regressor) {
        const Patterns learned = patternsOf(half, [&](int of) { return of != fold; });
        const Patterns heldOut = patternsOf(half, [&](int of) { return of == fold; });
        FoldScore score{0, heldOut.cases.size(), 0};
        if (options_.family == RegressorFamily::trees)
            score.loss = meanLoss(regressor = grow(half, learned), heldOut, half);
        else
            regressor = fit(half, fold, learned, heldOut, score);
        return score;
    }

    /// From all samples.
    Regressor learn(Half half, int epochs) {
        const Patterns all = patternsOf(half, [](int) { return true; });
        if (options_.family == RegressorFamily::trees) return grow(half, all);
        FoldScore fixed{0, 0, epochs};
        return fit(half, options_.folds, all, all, fixed);
    }

    /// Whether each fold has something to be judged by.
    bool enough() const {
        std::vector<std::size_t> readings(static_cast<std::size_t>(options_.folds));
        for (std::size_t i = 0; i < folds_.size(); ++i)
            readings[static_cast<std::size_t>(folds_[i])] += samples_.cases[i].reported && !unknown_[i];
        return *std::ranges::min_element(readings) >= fewestReadings / 10;
    }
    std::int64_t epochs() const { return epochs_; }

private:
    std::vector<NetworkVariable> outputsOf(Half half) const {
        const std::vector<NetworkVariable>& all = network_.learned.outputs;
        const auto member = all.begin() + ReadingForm::errors;
        return half == Half::reported ? std::vector(all.begin(), member)
                                      : std::vector(member, member + network_.form.memberOutputs());
    }

    template <class Takes>
    Patterns patternsOf(Half half, const Takes& takes) const {
        Patterns patterns;
        for (std::size_t i = 0; i < samples_.cases.size(); ++i)
            if (takes(folds_[i]) && (half == Half::reported || (samples_.cases[i].reported && !unknown_[i])))
                patterns.cases.push_back(i);
        patterns.data.outputs = outputsOf(half);
        std::vector<float> row(inputs_.width());
        const std::vector<bool>& read = read_[static_cast<std::size_t>(half)];
        patterns.data.inputs.resize(patterns.cases.size(), static_cast<int>(row.size()));
        for (std::size_t p = 0; p < patterns.cases.size(); ++p) {
            const std::size_t i = patterns.cases[p];
            inputs_.read(samples_.cases[i].state, robots_[i], row.data());
            for (std::size_t k = 0; k < row.size(); ++k)
                patterns.data.inputs(p, static_cast<int>(k)) = read[k] ? row[k] : 0.0f;
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

    /// With score.epochs as many as that, otherwise as many as predict best what is held out.
    Regressor fit(Half half, int part, Patterns learned, Patterns heldOut, FoldScore& score) {
        setLoss(half, learned);
        setLoss(half, heldOut);
        const SensorHalfOptions& how = half == Half::reported ? options_.reported : options_.error;
        TrainingOptions training;
        training.rprop.firstStep = 0.01;
        training.rprop.largestStep = 1;
        training.epochs = score.epochs > 0 ? score.epochs : how.epochs;
        training.patience = options_.patience;
        training.validateEvery = score.epochs > 0 ? score.epochs : 20;
        const int outputs = static_cast<int>(learned.data.outputs.size());
        if (options_.family == RegressorFamily::network) {
            training.weightDecay = how.weightDecay;
            NetworkLikelihood objective(learned.data, heldOut.data, how.hidden);
            const std::uint64_t seed = 64 * options_.seed + 2 * static_cast<std::uint64_t>(part) + static_cast<std::uint64_t>(half);
            Mlp network =
                randomMlp(objective.engine()->shape(), {.seed = seed, .hiddenScale = 1.5, .outputScale = 0.3});
            forgetUnread(half, network);
            network.parameters = trained(objective, network.parameters, training, score);
            return network;
        }
        LookupTable table = sensorTableFor(network_.learned.inputs, network_, half, outputs);
        TableLikelihood objective(learned.data, heldOut.data, table, options_.roughness);
        const std::vector<float> values =
            trained(objective, std::vector<float>(objective.parameterCount()), training, score);
        const float* from = values.data();
        for (LookupTable::Grid& grid : table.grids) {
            std::copy_n(from, grid.values.size(), grid.values.begin());
            from += grid.values.size();
        }
        return table;
    }

    /// What is always 0 has no gradient: these weights stay as they are.
    void forgetUnread(Half half, Mlp& network) const {
        const int inputs = network.shape.inputs;
        for (int j = 0; j < network.shape.hidden; ++j)
            for (int i = 0; i < inputs; ++i)
                if (!read_[static_cast<std::size_t>(half)][static_cast<std::size_t>(i)])
                    network.parameters[static_cast<std::size_t>(j * inputs + i)] = 0;
    }

    std::vector<float> trained(TrainingObjective& objective, const std::vector<float>& first,
                               const TrainingOptions& training, FoldScore& score) {
        const TrainingResult result = train(objective, first, training);
        score.loss = result.validationError;
        score.epochs = result.bestEpoch;
        epochs_ += result.epochs;
        return result.parameters.empty() ? first : result.parameters;
    }

    DecisionTrees grow(Half half, const Patterns& learned) const {
        TreeOptions growing;
        growing.trees = options_.trees;
        growing.seed = 2 * options_.seed + static_cast<std::uint64_t>(half);
        return half == Half::reported ? growReportTrees(learned.data, reportsOf(learned), growing)
                                      : growErrorTrees(learned.data, errorsOf(learned), growing);
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

    double meanLoss(const Regressor& regressor, Patterns patterns, Half half) const {
        setLoss(half, patterns);
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

    SensorNetwork& network_;
    const SensorSamples& samples_;
    const SensorTrainerOptions& options_;
    SensorInputs inputs_;
    std::array<std::vector<bool>, 2> read_;  ///< by Half: which inputs it reads
    std::vector<int> robots_, folds_;        ///< by case, as the next one
    std::vector<bool> unknown_;              ///< SampledLook::unknown
    std::int64_t epochs_ = 0;
};

/// Ten times what the middle half of the errors would make the standard deviation: errors beyond are gross.
ReadingError soundBounds(const SensorSamples& samples, int dimensions) {
    ReadingError bounds{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimensions); ++d) {
        std::vector<double> errors;
        for (const SensorCase& one : samples.cases)
            if (one.reported) errors.push_back(one.error[d]);
        bounds[d] = std::max(10 * robustSpread(errors, medianOf(errors)), 1e-6);
    }
    return bounds;
}

GrossErrors findGross(const SensorSamples& samples, int dimensions, const ReadingError& bounds) {
    GrossErrors gross;
    const auto each = static_cast<std::size_t>(dimensions);
    for (std::size_t d = 0; d < each; ++d) gross.reach[d] = 2 * bounds[d];
    std::size_t wrong = 0;
    for (const SensorCase& one : samples.cases) {
        bool sound = true;
        for (std::size_t d = 0; d < each; ++d) sound = sound && std::abs(one.error[d]) <= bounds[d];
        if (!one.reported || sound) continue;
        ++wrong;
        for (std::size_t d = 0; d < each; ++d) gross.reach[d] = std::max(gross.reach[d], std::abs(one.error[d]));
    }
    // one may yet be farther off than any so far
    constexpr double farther = 1.5;
    for (double& reach : gross.reach) reach *= farther;
    const auto readings = std::ranges::count_if(samples.cases, &SensorCase::reported);
    gross.share = (static_cast<double>(wrong) + 0.5) / (static_cast<double>(readings) + 1);
    return gross;
}

/// How the outputs are standardised: by all cases together whose errors are within bounds, so that zeros are a first
/// guess of everything.
void findOutputScales(SensorNetwork& network, const SensorSamples& samples, const ReadingError& bounds) {
    std::vector<NetworkVariable>& outputs = network.learned.outputs;
    outputs = sensorOutputs(network.measures, network.form);
    const double readings = static_cast<double>(samples.readings());
    const double cases = static_cast<double>(samples.cases.size());
    outputs[ReadingForm::reported].mean = normalQuantile(std::min(readings, cases - 0.5) / cases);
    const auto setAll = [&](int i, double mean, double scale) {
        for (int m = 0; m < network.form.members; ++m) {
            const int place = ReadingForm::errors + m * network.form.memberOutputs() + i;
            outputs[static_cast<std::size_t>(place)].mean = mean;
            outputs[static_cast<std::size_t>(place)].scale = scale;
        }
    };
    for (int d = 0; d < network.form.dimensions; ++d) {
        const auto i = static_cast<std::size_t>(d);
        double sum = 0, squares = 0, count = 0;
        const auto visit = [&](auto use) {
            for (const SensorCase& one : samples.cases)
                if (one.reported && std::abs(one.error[i]) < bounds[i]) use(one.error[i]);
        };
        visit([&](double error) { sum += error, ++count; });
        const double mean = sum / count;
        visit([&](double error) { squares += (error - mean) * (error - mean); });
        const double deviation = std::sqrt(squares / count);
        for (int k = 0; k < network.form.components; ++k) {
            setAll(network.form.errorOf(k, d), mean, deviation);
            // components begin of different widths, so that each finds its part
            const double width = 0.7 * k - 0.3 * (network.form.components - 1);
            setAll(network.form.spreadOf(k, d), logarithm(deviation) + width, 1);
        }
    }
    for (int k = 1; k < network.form.components; ++k) setAll(network.form.shareOf(k), -1, 1);
}

/// The middle one of what was best for the folds.
int usualEpochs(std::vector<int> epochs) {
    std::sort(epochs.begin(), epochs.end());
    return epochs[epochs.size() / 2];
}

}  // namespace

Expected<SensorNetwork> trainSensor(const SensorNetwork& blueprint, const SensorSamples& samples,
                                    const SensorTrainerOptions& options, const Progress& progress) {
    const std::size_t readings = samples.readings();
    if (readings < fewestReadings)
        return fail("", "holds " + std::to_string(readings) + " readings of what is known; learning needs " +
                            std::to_string(fewestReadings));
    SensorNetwork network = blueprint;
    network.robots = samples.robots;
    network.form.dimensions = static_cast<int>(dimensionsOf(network.measures).size());
    network.form.components = options.family == RegressorFamily::network ? options.components : 1;
    network.form.members = options.family == RegressorFamily::network && options.members ? options.folds : 1;
    const ReadingError bounds = soundBounds(samples, network.form.dimensions);
    network.gross = findGross(samples, network.form.dimensions, bounds);
    network.constant = fitConstantNoise(network, samples);
    network.learned.kind = SensorNetwork::kind;
    network.learned.inputs = sensorInputsFor(network, samples);
    findOutputScales(network, samples, bounds);
    SensorLearner learner(network, samples, options);
    if (!learner.enough()) return fail("", "is too short to hold out a part of it: less than a few minutes");
    // learning from all takes somewhat longer than from a fold's others
    const double steps = 2.0 * (options.folds + 1);
    double done = 0;
    std::array<int, 2> epochs{};
    std::vector<Regressor> members;  // of the errors
    for (const Half half : {Half::reported, Half::error}) {
        std::vector<int> best;
        std::vector<Regressor> ofFolds(static_cast<std::size_t>(options.folds));
        double score = 0, cases = 0;
        for (int fold = 0; fold < options.folds; ++fold) {
            if (!mayGoOn(progress, done++ / steps)) return fail("", "was not learned from: cancelled");
            const auto found = learner.validate(half, fold, ofFolds[static_cast<std::size_t>(fold)]);
            best.push_back(found.epochs);
            score -= found.loss * static_cast<double>(found.cases);
            cases += static_cast<double>(found.cases);
        }
        epochs[static_cast<std::size_t>(half)] = usualEpochs(best);
        if (half == Half::error && network.form.members > 1) members = std::move(ofFolds);
        (half == Half::reported ? network.heldOut.reported : network.heldOut.error) = score / cases;
        (half == Half::reported ? network.heldOut.cases : network.heldOut.readings) = static_cast<std::int64_t>(cases);
    }
    network.heldOut.looks = std::count_if(samples.looks.begin(), samples.looks.end(),
                                          [](const SampledLook& look) { return !look.unknown; });
    if (!mayGoOn(progress, done++ / steps)) return fail("", "was not learned from: cancelled");
    const Regressor reported = learner.learn(Half::reported, epochs[0]);
    if (!mayGoOn(progress, done++ / steps)) return fail("", "was not learned from: cancelled");
    if (members.empty()) members.push_back(learner.learn(Half::error, epochs[1]));
    network.learned.regressor = reported;
    for (const Regressor& member : members)
        network.learned.regressor = sideBySide(network.learned.regressor, member);
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
