#include "tasks/task_learning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "geometry/elementary.h"
#include "identification/likelihood_objective.h"
#include "identification/tree_growing.h"
#include "learning/ensemble.h"
#include "learning/initial_weights.h"
#include "learning/parallel_for.h"
#include "learning/squared_error.h"
#include "learning/trainer.h"
#include "tasks/output_contrasts.h"

namespace mrose {
namespace {

constexpr std::size_t fewestRows = 50;
/// Levenberg and Marquardt's method is fast up to about so many patterns.
constexpr std::size_t manyRows = 40'000, someRows = 10'000;
constexpr double weightDecay = 1e-3;
constexpr int knotsAlone = 16, knotsInPairs = 9;  // of a table's axes
constexpr double roughness = 1e-4;
constexpr int mostNeighbours = 32;

/// Rows, standardised.
struct Rows {
    PatternMatrix inputs;
    std::vector<float> targets;  ///< [row][output]
    std::size_t outputs = 1;

    PatternSet patterns() const { return {inputs, PatternMatrix::fromRows(targets, static_cast<int>(outputs))}; }
};

NetworkVariable standardised(const std::string& name, const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {name, "1", mean, std::max(std::sqrt(squares / count), 1e-9)};
}

class TaskLearner {
public:
    TaskLearner(const TaskData& data, const TaskLearning& how, const Progress& progress)
        : how_(how), progress_(progress), data_(data.part(TaskLearning::every, TaskLearning::offset, false)) {}

    Expected<TaskNetwork> learn() {
        if (data_.rows() < fewestRows)
            return fail("", "leaves " + std::to_string(data_.rows()) + " rows to learn from; expected at least " +
                                std::to_string(fewestRows));
        if (data_.inputs.size() > LearnedNetwork::maxInputs || data_.outputs() > LearnedNetwork::maxOutputs)
            return fail("", "has " + std::to_string(data_.inputs.size()) + " inputs and " +
                                std::to_string(data_.outputs()) + " outputs; expected at most " +
                                std::to_string(LearnedNetwork::maxInputs) + " and " +
                                std::to_string(LearnedNetwork::maxOutputs));
        if (how_.logarithmic && *std::ranges::min_element(data_.y) <= 0)
            return fail("", "is not above 0 in all rows, and has no logarithm", 0, data_.target);
        describe();
        std::optional<Regressor> regressor = learned();
        if (!regressor) return fail("", "was interrupted");
        network_.learned.regressor = std::move(*regressor);
        return std::move(network_);
    }

private:
    void describe() {
        LearnedNetwork& learned = network_.learned;
        learned.kind = TaskNetwork::kind;
        learned.synthetic = true;  // of simulated trials
        const std::size_t width = data_.inputs.size();
        for (std::size_t i = 0; i < width; ++i) {
            std::vector<double> column;
            for (std::size_t row = 0; row < data_.rows(); ++row) column.push_back(data_.inputsOf(row)[i]);
            const auto [least, most] = std::ranges::minmax_element(column);
            network_.seen.push_back({*least, *most});
            learned.inputs.push_back(standardised(data_.inputs[i], column));
        }
        for (std::size_t k = 0; k < data_.outputs(); ++k) {
            std::vector<double> column;
            for (std::size_t row = 0; row < data_.rows(); ++row) column.push_back(learnedValue(row, k));
            learned.outputs.push_back(standardised(data_.variants.empty() ? data_.target : data_.variants[k], column));
        }
        network_.logarithmic.assign(data_.outputs(), how_.logarithmic);
        learned.training.loss = "squared error";
        learned.training.seed = how_.seed;
        learned.training.patterns = static_cast<std::int64_t>(data_.rows());
        learned.holdOut.every = TaskLearning::every;
        learned.holdOut.offset = TaskLearning::offset;
    }

    double learnedValue(std::size_t row, std::size_t output) const {
        const double y = data_.y[row * data_.outputs() + output];
        return how_.logarithmic ? logarithm(y) : y;
    }

    /// Parts are of whole trials.
    int partOf(std::uint32_t trial) const {
        return static_cast<int>((trial - trial / TaskLearning::every) % static_cast<std::uint32_t>(how_.members));
    }
    template <class Takes>
    Rows rowsWhere(const Takes& takes) const {
        std::vector<float> x;
        Rows rows{.inputs = {}, .targets = {}, .outputs = data_.outputs()};
        const std::size_t width = data_.inputs.size();
        for (std::size_t row = 0; row < data_.rows(); ++row) {
            if (!takes(row)) continue;
            for (std::size_t i = 0; i < width; ++i) {
                const NetworkVariable& input = network_.learned.inputs[i];
                x.push_back(static_cast<float>((data_.inputsOf(row)[i] - input.mean) / input.scale));
            }
            for (std::size_t k = 0; k < rows.outputs; ++k) {
                const NetworkVariable& output = network_.learned.outputs[k];
                rows.targets.push_back(static_cast<float>((learnedValue(row, k) - output.mean) / output.scale));
            }
        }
        rows.inputs = PatternMatrix::fromRows(x, static_cast<int>(width));
        return rows;
    }
    Rows all() const {
        return rowsWhere([](std::size_t) { return true; });
    }
    Rows part(int which, bool held) const {
        return rowsWhere([&](std::size_t row) { return (partOf(data_.trial[row]) == which) == held; });
    }

    /// nullopt: progress ended it.
    std::optional<Regressor> learned() {
        NetworkTraining& training = network_.learned.training;
        switch (how_.family) {
            case RegressorFamily::network:
                return ensemble();
            case RegressorFamily::table:
                training.method = "irprop+";
                return table();
            case RegressorFamily::trees:
                training.method = "trees";
                return grown();
            case RegressorFamily::neighbours:
                training.method = "neighbours";
                return neighbours();
        }
        return std::nullopt;
    }

    /// Of these the best stays. Many rows are learned in one way alone.
    std::vector<TrainingOptions> waysToTrain() const {
        if (data_.rows() > manyRows) return {{.epochs = 3000, .patience = 300}};
        TrainingOptions decaying;
        decaying.epochs = 1500;
        decaying.patience = 200;
        decaying.weightDecay = weightDecay;
        TrainingOptions exact;
        exact.method = TrainingMethod::levenbergMarquardt;
        exact.epochs = 500;
        exact.validateEvery = 1;
        exact.patience = 60;
        // Of few rows all count for the matrix.
        if (data_.rows() <= someRows) exact.levenbergMarquardt.matrixEvery = 1;
        return {exact, decaying};
    }

    struct Ensemble {
        std::vector<Mlp> members;
        double error = 0;  ///< the sum of theirs, each of the part that it was learned without
        int epochs = 0;
    };

    /// The way of training that predicts best what each member was learned without.
    std::optional<Regressor> ensemble() {
        const std::vector<TrainingOptions> ways = waysToTrain();
        std::optional<Ensemble> best;
        for (std::size_t way = 0; way < ways.size(); ++way) {
            std::optional<Ensemble> trained = ensembleBy(ways[way], [&](double share) {
                return goesOn((static_cast<double>(way) + share) / static_cast<double>(ways.size()));
            });
            if (!trained) return std::nullopt;
            if (best && best->error <= trained->error) continue;
            best = std::move(trained);
            network_.learned.training.method = nameOf(ways[way].method);
        }
        network_.learned.training.epochs = best->epochs;
        network_.learned.members = membersOf(best->members);
        return mergedMean(best->members);
    }

    template <class MayGoOn>
    std::optional<Ensemble> ensembleBy(const TrainingOptions& options, const MayGoOn& mayGoOnAt) const {
        Ensemble ensemble;
        std::optional<OutputContrasts> contrasts;
        if (!data_.variants.empty()) contrasts.emplace(all().targets, network_.learned.outputs);
        const auto patterns = [&](int which, bool held) {
            Rows rows = part(which, held);
            if (contrasts) rows.targets = contrasts->of(rows.targets);
            if (contrasts) rows.outputs = contrasts->count();
            return rows.patterns();
        };
        for (int member = 0; member < how_.members; ++member) {
            const PatternSet learned = patterns(member, false), held = patterns(member, true);
            const MlpShape shape{static_cast<int>(data_.inputs.size()), how_.hidden,
                                 static_cast<int>(contrasts ? contrasts->count() : data_.outputs())};
            SquaredError objective(shape, learned, held);
            Mlp network = randomMlp(shape, {.seed = 64 * how_.seed + static_cast<std::uint64_t>(member)});
            TrainingResult result = train(objective, network.parameters, options, [&](const TrainingProgress& at) {
                return mayGoOnAt((member + static_cast<double>(at.epoch) / options.epochs) / how_.members);
            });
            if (result.end == TrainingEnd::stopped) return std::nullopt;
            if (!result.parameters.empty()) network.parameters = std::move(result.parameters);
            ensemble.error += result.validationError;
            ensemble.epochs += result.epochs;
            ensemble.members.push_back(contrasts ? contrasts->undone(network) : std::move(network));
        }
        return ensemble;
    }

    /// A sum of grids: of each input alone, and of each pair.
    LookupTable grids() const {
        const int width = static_cast<int>(data_.inputs.size()), outputs = static_cast<int>(data_.outputs());
        LookupTable table{width, outputs, {}};
        const auto axis = [&](int input, int knots) {
            const NetworkVariable& variable = network_.learned.inputs[static_cast<std::size_t>(input)];
            const TaskNetwork::Range& range = network_.seen[static_cast<std::size_t>(input)];
            const double least = (range.least - variable.mean) / variable.scale;
            const double wide = std::max((range.most - range.least) / variable.scale, 1e-3);
            LookupTable::Axis of{input, {}};
            for (int k = 0; k < knots; ++k) of.knots.push_back(static_cast<float>(least + wide * k / (knots - 1)));
            return of;
        };
        const auto add = [&](std::vector<LookupTable::Axis> axes) {
            LookupTable::Grid grid{std::move(axes), {}};
            grid.values.assign(grid.points() * data_.outputs(), 0.0f);
            table.grids.push_back(std::move(grid));
        };
        for (int i = 0; i < width; ++i) add({axis(i, knotsAlone)});
        for (int i = 0; i < width; ++i)
            for (int k = i + 1; k < width; ++k) add({axis(i, knotsInPairs), axis(k, knotsInPairs)});
        return table;
    }

    std::optional<Regressor> table() {
        const auto dataOf = [](const Rows& rows) {
            LikelihoodData data{rows.inputs, std::vector<NetworkVariable>(rows.outputs, {"y", "1", 0, 1}), {}};
            data.loss = [&rows](std::size_t p, std::span<const double> values, double* gradient) {
                double squares = 0;
                for (std::size_t k = 0; k < rows.outputs; ++k) {
                    const double off = values[k] - static_cast<double>(rows.targets[p * rows.outputs + k]);
                    gradient[k] = 2 * off;
                    squares += off * off;
                }
                return squares;
            };
            return data;
        };
        const Rows learned = part(0, false), held = part(0, true);
        const LikelihoodData from = dataOf(learned), judged = dataOf(held);
        LookupTable table = grids();
        TableLikelihood objective(from, judged, table, roughness);
        TrainingOptions options;
        options.rprop.firstStep = 0.01;
        options.epochs = 2000;
        options.validateEvery = 20;
        options.patience = 300;
        std::vector<float> values(objective.parameterCount());
        TrainingResult result = train(objective, values, options, [&](const TrainingProgress& at) {
            return goesOn(static_cast<double>(at.epoch) / options.epochs);
        });
        if (result.end == TrainingEnd::stopped) return std::nullopt;
        network_.learned.training.epochs = result.epochs;
        if (!result.parameters.empty()) values = std::move(result.parameters);
        const float* next = values.data();
        for (LookupTable::Grid& grid : table.grids) {
            std::copy_n(next, grid.values.size(), grid.values.begin());
            next += grid.values.size();
        }
        return table;
    }

    std::optional<Regressor> grown() {
        if (!goesOn(0)) return std::nullopt;
        const Rows rows = all();
        std::vector<std::vector<double>> targets(rows.outputs);
        for (std::size_t i = 0; i < rows.targets.size(); ++i)
            targets[i % rows.outputs].push_back(static_cast<double>(rows.targets[i]));
        return growMeanTrees(rows.inputs, targets, {.trees = how_.trees, .depth = 20, .leaf = 3, .seed = how_.seed});
    }

    /// With as many neighbours as predict one part best.
    std::optional<Regressor> neighbours() {
        const auto remember = [&](const Rows& rows) {
            NearestNeighbours of{static_cast<int>(data_.inputs.size()),
                                 static_cast<int>(rows.outputs),
                                 1,
                                 {},
                                 rows.inputs.toRows(),
                                 rows.targets};
            of.read.resize(data_.inputs.size());
            std::iota(of.read.begin(), of.read.end(), 0);
            return of;
        };
        const Rows held = part(0, true);
        const std::vector<float> asked = held.inputs.toRows();
        NearestNeighbours trial = remember(part(0, false));
        double best = std::numeric_limits<double>::infinity();
        int chosen = 1;
        for (int count = 1; count <= mostNeighbours && count <= static_cast<int>(trial.patterns()); count *= 2) {
            if (!goesOn(0.1 * count / mostNeighbours)) return std::nullopt;
            trial.neighbours = count;
            std::vector<double> squares(held.targets.size() / held.outputs);
            parallelFor(squares.size(), [&](std::size_t row) {
                std::array<float, LearnedNetwork::maxOutputs> y;
                trial.evaluate(asked.data() + row * data_.inputs.size(), y.data());
                for (std::size_t k = 0; k < held.outputs; ++k) {
                    const double off =
                        static_cast<double>(y[k]) - static_cast<double>(held.targets[row * held.outputs + k]);
                    squares[row] += off * off;
                }
            });
            const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
            if (sum < best) best = sum, chosen = count;
        }
        NearestNeighbours of = remember(all());
        of.neighbours = chosen;
        return of;
    }

    bool goesOn(double share) const { return mayGoOn(progress_, share); }

    const TaskLearning& how_;
    const Progress& progress_;
    TaskData data_;
    TaskNetwork network_;
};

}  // namespace

double shareOff(const TaskData& data, const std::vector<double>& predicted) {
    double off = 0, all = 0;
    for (std::size_t i = 0; i < data.y.size(); ++i)
        if (!std::isnan(predicted[i])) off += std::abs(predicted[i] - data.y[i]), all += std::abs(data.y[i]);
    return off / all;
}

Expected<TaskNetwork> learnTask(const TaskData& data, const TaskLearning& how, const Progress& progress) {
    auto network = TaskLearner(data, how, progress).learn();
    if (!network) return network;
    const TaskData held = data.part(TaskLearning::every, TaskLearning::offset, true);
    if (held.rows() > 0) network->heldOutError = shareOff(held, predictions(*network, held));
    return network;
}

std::vector<double> predictions(const TaskNetwork& network, const TaskData& data) {
    const TaskInference inference(network);
    const std::size_t outputs = inference.outputs();
    std::vector<double> predicted(data.rows() * outputs);
    parallelFor(data.rows(),
                [&](std::size_t row) { inference.evaluate(data.inputsOf(row), &predicted[row * outputs]); });
    return predicted;
}

}  // namespace mrose
