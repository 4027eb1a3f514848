#include "identification/tree_growing.h"

#include <algorithm>
#include <cmath>

#include <opencv2/ml.hpp>

#include "geometry/normal_distribution.h"
#include "learning/parallel_for.h"
#include "world/noise.h"

namespace mrose {
namespace {

using Tree = DecisionTrees::Tree;

/// Which patterns a tree is grown from: how often each is drawn.
std::vector<int> drawn(std::size_t patterns, std::uint64_t seed, int tree) {
    std::vector<int> times(patterns);
    for (std::size_t i = 0; i < patterns; ++i) {
        const double u = uniformNoise({seed, static_cast<std::int64_t>(i), static_cast<std::uint32_t>(tree), 0});
        ++times[std::min(static_cast<std::size_t>(u * static_cast<double>(patterns)), patterns - 1)];
    }
    return times;
}

cv::Mat matrixOf(const PatternMatrix& inputs) {
    cv::Mat rows(static_cast<int>(inputs.patterns()), inputs.features(), CV_32F);
    const std::vector<float> values = inputs.toRows();
    std::copy(values.begin(), values.end(), rows.ptr<float>());
    return rows;
}

/// OpenCV's nodes in an order in which children come after their parents.
void append(const cv::ml::DTrees& from, int node, Tree& to) {
    const cv::ml::DTrees::Node& n = from.getNodes()[static_cast<std::size_t>(node)];
    const std::size_t here = to.nodes.size();
    to.nodes.push_back({});
    if (n.split < 0) return;
    const cv::ml::DTrees::Split& split = from.getSplits()[static_cast<std::size_t>(n.split)];
    to.nodes[here].input = split.varIdx;
    to.nodes[here].value = split.c;
    const int left = static_cast<int>(to.nodes.size());
    append(from, split.inversed ? n.right : n.left, to);
    const int right = static_cast<int>(to.nodes.size());
    append(from, split.inversed ? n.left : n.right, to);
    to.nodes[here].left = left;
    to.nodes[here].right = right;
}

std::size_t leafOf(const Tree& tree, const float* x) {
    std::size_t node = 0;
    while (tree.nodes[node].input >= 0) {
        const DecisionTrees::Node& at = tree.nodes[node];
        node = static_cast<std::size_t>(x[at.input] <= at.value ? at.left : at.right);
    }
    return node;
}

/// Grows trees of one target and gives their leaves values.
class Grower {
public:
    Grower(const PatternMatrix& inputs, const TreeOptions& options)
        : options_(options),
          rows_(inputs.toRows()),
          width_(static_cast<std::size_t>(inputs.features())),
          matrix_(matrixOf(inputs)),
          patterns_(inputs.patterns()) {
        for (int t = 0; t < options.trees; ++t) drawn_.push_back(drawn(patterns_, options.seed, t));
    }

    /// `leafValue` of the sum of weights, of values and of squared values of a leaf's patterns.
    template <class LeafValue>
    void grow(const std::vector<double>& target, int output, const LeafValue& leafValue, DecisionTrees& to) const {
        std::vector<Tree> grown(static_cast<std::size_t>(options_.trees));
        parallelFor(grown.size(), [&](std::size_t t) {
            grown[t] = growOne(target, drawn_[t]);
            grown[t].output = output;
            setLeaves(grown[t], target, drawn_[t], leafValue);
        });
        to.trees.insert(to.trees.end(), grown.begin(), grown.end());
    }

    /// What those trees say of each pattern that were grown without it.
    std::vector<double> unseen(std::span<const Tree> trees) const {
        std::vector<double> means(patterns_);
        parallelFor(patterns_, [&](std::size_t i) {
            double own = 0, all = 0;
            int ownCount = 0;
            for (std::size_t t = 0; t < trees.size(); ++t) {
                const double value = static_cast<double>(trees[t].evaluate(&rows_[i * width_]));
                all += value;
                if (drawn_[t][i] > 0) continue;
                own += value;
                ++ownCount;
            }
            means[i] = ownCount > 0 ? own / ownCount : all / static_cast<double>(trees.size());
        });
        return means;
    }

private:
    Tree growOne(const std::vector<double>& target, const std::vector<int>& times) const {
        cv::Mat responses(static_cast<int>(patterns_), 1, CV_32F);
        std::vector<int> chosen;
        for (std::size_t i = 0; i < patterns_; ++i) {
            responses.at<float>(static_cast<int>(i)) = static_cast<float>(target[i]);
            for (int k = 0; k < times[i]; ++k) chosen.push_back(static_cast<int>(i));
        }
        const auto data = cv::ml::TrainData::create(matrix_, cv::ml::ROW_SAMPLE, responses, cv::noArray(), chosen);
        const auto tree = cv::ml::DTrees::create();
        tree->setMaxDepth(options_.depth);
        tree->setMinSampleCount(2 * options_.leaf);
        tree->setCVFolds(0);
        tree->setUseSurrogates(false);
        tree->setRegressionAccuracy(0);
        tree->train(data);
        Tree grown;
        append(*tree, tree->getRoots().front(), grown);
        return grown;
    }

    template <class LeafValue>
    void setLeaves(Tree& tree, const std::vector<double>& target, const std::vector<int>& times,
                   const LeafValue& leafValue) const {
        struct Sums {
            double weight = 0, value = 0, square = 0;
        };
        std::vector<Sums> sums(tree.nodes.size());
        for (std::size_t i = 0; i < patterns_; ++i) {
            if (times[i] == 0) continue;
            Sums& at = sums[leafOf(tree, &rows_[i * width_])];
            at.weight += times[i];
            at.value += times[i] * target[i];
            at.square += times[i] * target[i] * target[i];
        }
        for (std::size_t n = 0; n < tree.nodes.size(); ++n)
            if (tree.nodes[n].input < 0)
                tree.nodes[n].value = static_cast<float>(leafValue(sums[n].weight, sums[n].value, sums[n].square));
    }

    const TreeOptions& options_;
    std::vector<float> rows_;
    std::size_t width_;
    cv::Mat matrix_;
    std::size_t patterns_;
    std::vector<std::vector<int>> drawn_;  ///< by tree
};

}  // namespace

DecisionTrees growMeanTrees(const PatternMatrix& inputs, std::span<const std::vector<double>> targets,
                            const TreeOptions& options) {
    const Grower grower(inputs, options);
    DecisionTrees trees{inputs.features(), static_cast<int>(targets.size()), {}};
    for (std::size_t output = 0; output < targets.size(); ++output)
        grower.grow(
            targets[output], static_cast<int>(output),
            [](double weight, double value, double) { return value / weight; }, trees);
    return trees;
}

DecisionTrees growReportTrees(const LikelihoodData& data, const std::vector<bool>& reports,
                              const TreeOptions& options) {
    const Grower grower(data.inputs, options);
    DecisionTrees trees{data.inputs.features(), 1, {}};
    const NetworkVariable& output = data.outputs.front();
    const std::vector<double> target(reports.begin(), reports.end());
    grower.grow(
        target, 0,
        [&](double weight, double value, double) {
            return (normalQuantile((value + 0.5) / (weight + 1)) - output.mean) / output.scale;
        },
        trees);
    return trees;
}

DecisionTrees growErrorTrees(const LikelihoodData& data, const std::vector<std::vector<double>>& errors,
                             const TreeOptions& options) {
    const Grower grower(data.inputs, options);
    const auto dimensions = errors.size();
    DecisionTrees trees{data.inputs.features(), static_cast<int>(2 * dimensions), {}};
    for (std::size_t d = 0; d < dimensions; ++d) {
        const NetworkVariable &mean = data.outputs[d], &spread = data.outputs[dimensions + d];
        std::vector<double> target = errors[d];
        for (double& error : target) error = std::clamp((error - mean.mean) / mean.scale, -8.0, 8.0);
        const std::size_t first = trees.trees.size();
        grower.grow(
            target, static_cast<int>(d), [](double weight, double value, double) { return value / weight; }, trees);
        const std::vector<double> means = grower.unseen(std::span(trees.trees).subspan(first));
        for (std::size_t i = 0; i < target.size(); ++i) target[i] = std::abs(target[i] - means[i]);
        grower.grow(
            target, static_cast<int>(dimensions + d),
            [&](double weight, double, double square) {
                const double deviation = std::sqrt((square + 1e-6) / weight) * mean.scale;
                return (logarithm(deviation) - spread.mean) / spread.scale;
            },
            trees);
    }
    return trees;
}

}  // namespace mrose
