#include "tasks/task_learning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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
#include "world/noise.h"

namespace mrose {
namespace {

constexpr std::size_t fewestRows = 50;
/// Levenberg and Marquardt's method is fast up to about so many patterns.
constexpr std::size_t manyRows = 40'000, someRows = 10'000;
constexpr int knotsAlone = 16, knotsInPairs = 9;  // of a table's axes
constexpr double roughness = 1e-4;
constexpr int mostNeighbours = 32;

/// Rows, standardised.
struct Rows {
    PatternMatrix inputs;
    std::vector<float> targets;  ///< [row]

    PatternSet patterns() const {
        PatternSet set{inputs, PatternMatrix(targets.size(), 1)};
        for (std::size_t i = 0; i < targets.size(); ++i) set.targets(i, 0) = targets[i];
        return set;
    }
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
        std::vector<double> y = data_.y;
        if (how_.logarithmic)
            for (double& value : y) value = logarithm(value);
        learned.outputs = {standardised(data_.target, y)};
        network_.logarithmic = {how_.logarithmic};
        learned.training.loss = "squared error";
        learned.training.seed = how_.seed;
        learned.training.patterns = static_cast<std::int64_t>(data_.rows());
        learned.holdOut.every = TaskLearning::every;
        learned.holdOut.offset = TaskLearning::offset;
    }

    /// Parts are of whole trials.
    int partOf(std::uint32_t trial) const {
        return static_cast<int>((trial - trial / TaskLearning::every) % static_cast<std::uint32_t>(how_.members));
    }
    template <class Takes>
    Rows rowsWhere(const Takes& takes) const {
        std::vector<float> x;
        Rows rows;
        const std::size_t width = data_.inputs.size();
        const NetworkVariable& output = network_.learned.outputs[0];
        for (std::size_t row = 0; row < data_.rows(); ++row) {
            if (!takes(row)) continue;
            for (std::size_t i = 0; i < width; ++i) {
                const NetworkVariable& input = network_.learned.inputs[i];
                x.push_back(static_cast<float>((data_.inputsOf(row)[i] - input.mean) / input.scale));
            }
            const double y = how_.logarithmic ? logarithm(data_.y[row]) : data_.y[row];
            rows.targets.push_back(static_cast<float>((y - output.mean) / output.scale));
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

    std::optional<Regressor> ensemble() {
        std::vector<Mlp> members;
        const bool many = data_.rows() > manyRows;
        TrainingOptions options;
        options.method = many ? TrainingMethod::irpropPlus : TrainingMethod::levenbergMarquardt;
        options.epochs = many ? 3000 : 500;
        options.validateEvery = many ? 10 : 1;
        options.patience = many ? 300 : 60;
        // Of few rows all count for the matrix.
        if (data_.rows() <= someRows) options.levenbergMarquardt.matrixEvery = 1;
        network_.learned.training.method = nameOf(options.method);
        for (int member = 0; member < how_.members; ++member) {
            const PatternSet learned = part(member, false).patterns(), held = part(member, true).patterns();
            const MlpShape shape{static_cast<int>(data_.inputs.size()), how_.hidden, 1};
            SquaredError objective(shape, learned, held);
            Mlp network = randomMlp(shape, {.seed = 64 * how_.seed + static_cast<std::uint64_t>(member)});
            TrainingResult result = train(objective, network.parameters, options, [&](const TrainingProgress& at) {
                return goesOn((member + static_cast<double>(at.epoch) / options.epochs) / how_.members);
            });
            if (result.end == TrainingEnd::stopped) return std::nullopt;
            if (!result.parameters.empty()) network.parameters = std::move(result.parameters);
            network_.learned.training.epochs += result.epochs;
            members.push_back(std::move(network));
        }
        network_.learned.members = membersOf(members);
        return mergedMean(members);
    }

    /// A sum of grids: of each input alone, and of each pair.
    LookupTable grids() const {
        const int width = static_cast<int>(data_.inputs.size());
        LookupTable table{width, 1, {}};
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
            grid.values.assign(grid.points(), 0.0f);
            table.grids.push_back(std::move(grid));
        };
        for (int i = 0; i < width; ++i) add({axis(i, knotsAlone)});
        for (int i = 0; i < width; ++i)
            for (int k = i + 1; k < width; ++k) add({axis(i, knotsInPairs), axis(k, knotsInPairs)});
        return table;
    }

    std::optional<Regressor> table() {
        const auto dataOf = [](const Rows& rows) {
            LikelihoodData data{rows.inputs, {{"y", "1", 0, 1}}, {}};
            data.loss = [&rows](std::size_t p, std::span<const double> values, double* gradient) {
                const double off = values[0] - static_cast<double>(rows.targets[p]);
                gradient[0] = 2 * off;
                return off * off;
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
        const std::vector<double> target(rows.targets.begin(), rows.targets.end());
        return growMeanTrees(rows.inputs, std::span(&target, 1),
                             {.trees = how_.trees, .depth = 20, .leaf = 3, .seed = how_.seed});
    }

    /// With as many neighbours as predict one part best.
    std::optional<Regressor> neighbours() {
        const auto remember = [&](const Rows& rows) {
            NearestNeighbours of{static_cast<int>(data_.inputs.size()), 1, 1, {}, rows.inputs.toRows(), rows.targets};
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
            std::vector<double> squares(held.targets.size());
            parallelFor(squares.size(), [&](std::size_t row) {
                float y = 0;
                trial.evaluate(asked.data() + row * data_.inputs.size(), &y);
                const double off = static_cast<double>(y) - static_cast<double>(held.targets[row]);
                squares[row] = off * off;
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

Expected<TaskNetwork> learnTask(const TaskData& data, const TaskLearning& how, const Progress& progress) {
    auto network = TaskLearner(data, how, progress).learn();
    if (!network) return network;
    const TaskData held = data.part(TaskLearning::every, TaskLearning::offset, true);
    if (held.rows() > 0) network->heldOutError = scoreOf("", held, predictions(*network, held)).share;
    return network;
}

std::vector<double> predictions(const TaskNetwork& network, const TaskData& data) {
    const TaskInference inference(network);
    std::vector<double> predicted(data.rows());
    parallelFor(predicted.size(), [&](std::size_t row) { inference.evaluate(data.inputsOf(row), &predicted[row]); });
    return predicted;
}

TaskScore scoreOf(const std::string& name, const TaskData& judged, const std::vector<double>& predicted) {
    constexpr std::uint32_t draws = 1000;
    struct Sums {
        double error = 0, value = 0;
    };
    std::map<std::uint32_t, Sums> trials;
    TaskScore score{.name = name};
    Sums all;
    for (std::size_t row = 0; row < judged.rows(); ++row) {
        const double off = predicted[row] - judged.y[row];
        if (std::isnan(off)) continue;
        ++score.rows;
        score.bias += off;
        score.rootMeanSquare += off * off;
        all.error += std::abs(off), all.value += std::abs(judged.y[row]);
        Sums& of = trials[judged.trial[row]];
        of.error += std::abs(off), of.value += std::abs(judged.y[row]);
    }
    if (score.rows == 0) return score;
    const auto count = static_cast<double>(score.rows);
    score.bias /= count;
    score.rootMeanSquare = std::sqrt(score.rootMeanSquare / count);
    score.absolute = all.error / count;
    score.share = all.error / all.value;
    std::vector<Sums> each;
    for (const auto& [trial, sums] : trials) each.push_back(sums);
    std::vector<double> shares(draws);
    parallelFor(draws, [&](std::size_t draw) {
        Sums drawn;
        for (std::size_t i = 0; i < each.size(); ++i) {
            const double u = uniformNoise({0, static_cast<std::int64_t>(i), static_cast<std::uint32_t>(draw), 0});
            const Sums& one = each[static_cast<std::size_t>(u * static_cast<double>(each.size()))];
            drawn.error += one.error, drawn.value += one.value;
        }
        shares[draw] = drawn.error / drawn.value;
    });
    std::sort(shares.begin(), shares.end());
    score.shareLow = shares[static_cast<std::size_t>(0.025 * draws)];
    score.shareHigh = shares[static_cast<std::size_t>(0.975 * draws)];
    return score;
}

std::vector<TaskScore> heldOutScores(const TaskData& data, const std::vector<TaskNetwork>& learned) {
    const TaskData held = data.part(TaskLearning::every, TaskLearning::offset, true);
    const TaskData others = data.part(TaskLearning::every, TaskLearning::offset, false);
    std::vector<TaskScore> scores;
    for (const TaskNetwork& network : learned)
        scores.push_back(
            scoreOf(std::string(nameOf(familyOf(network.learned.regressor))), held, predictions(network, held)));
    for (const TaskData::Guess& guess : held.beside) scores.push_back(scoreOf(guess.name, held, guess.of));
    const double mean = std::accumulate(others.y.begin(), others.y.end(), 0.0) /
                        static_cast<double>(std::max<std::size_t>(others.rows(), 1));
    scores.push_back(scoreOf("mean of all", held, std::vector<double>(held.rows(), mean)));
    return scores;
}

}  // namespace mrose
