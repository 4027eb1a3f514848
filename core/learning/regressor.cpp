#include "learning/regressor.h"

#include <algorithm>
#include <cassert>
#include <type_traits>

namespace mrose {
namespace {

Mlp withOutputs(const Mlp& mlp, int first, int count) {
    const auto [inputs, hidden, outputs] = mlp.shape;
    const float* const weights = mlp.parameters.data();
    const float* const biases = weights + hidden * inputs;
    const float* const outputWeights = biases + hidden;
    std::vector<int> needed;
    for (int j = 0; j < hidden; ++j)
        for (int k = first; k < first + count; ++k)
            if (outputWeights[k * hidden + j] != 0) {
                needed.push_back(j);
                break;
            }
    if (needed.empty()) needed.push_back(0);
    Mlp part{{inputs, static_cast<int>(needed.size()), count}, {}};
    for (const int j : needed)
        part.parameters.insert(part.parameters.end(), weights + j * inputs, weights + (j + 1) * inputs);
    for (const int j : needed) part.parameters.push_back(biases[j]);
    for (int k = first; k < first + count; ++k)
        for (const int j : needed) part.parameters.push_back(outputWeights[k * hidden + j]);
    for (int k = first; k < first + count; ++k) part.parameters.push_back(outputWeights[outputs * hidden + k]);
    return part;
}

LookupTable withOutputs(const LookupTable& table, int first, int count) {
    LookupTable part{table.inputs, count, table.grids};
    const auto width = static_cast<std::size_t>(count), all = static_cast<std::size_t>(table.outputs);
    for (std::size_t g = 0; g < part.grids.size(); ++g) {
        std::vector<float>& values = part.grids[g].values;
        values.resize(table.grids[g].points() * width);
        for (std::size_t point = 0; point < table.grids[g].points(); ++point)
            std::copy_n(table.grids[g].values.begin() + static_cast<std::ptrdiff_t>(point * all) + first, width,
                        values.begin() + static_cast<std::ptrdiff_t>(point * width));
    }
    std::erase_if(part.grids, [](const LookupTable::Grid& grid) {
        return std::all_of(grid.values.begin(), grid.values.end(), [](float value) { return value == 0; });
    });
    return part;
}

DecisionTrees withOutputs(const DecisionTrees& trees, int first, int count) {
    DecisionTrees part{trees.inputs, count, {}};
    for (const DecisionTrees::Tree& tree : trees.trees)
        if (tree.output >= first && tree.output < first + count)
            part.trees.push_back({tree.output - first, tree.nodes});
    return part;
}

NearestNeighbours withOutputs(const NearestNeighbours& of, int first, int count) {
    NearestNeighbours part{of.inputs, count, of.neighbours, of.read, of.points, {}};
    for (std::size_t p = 0; p < of.patterns(); ++p) {
        const auto from = of.values.begin() + static_cast<std::ptrdiff_t>(p) * of.outputs + first;
        part.values.insert(part.values.end(), from, from + count);
    }
    return part;
}

std::vector<bool> readInputs(const Mlp& mlp) {
    const auto [inputs, hidden, outputs] = mlp.shape;
    std::vector<bool> read(static_cast<std::size_t>(inputs));
    for (int j = 0; j < hidden; ++j)
        for (int i = 0; i < inputs; ++i)
            if (mlp.parameters[static_cast<std::size_t>(j * inputs + i)] != 0) read[static_cast<std::size_t>(i)] = true;
    return read;
}

std::vector<bool> readInputs(const LookupTable& table) {
    std::vector<bool> read(static_cast<std::size_t>(table.inputs));
    for (const LookupTable::Grid& grid : table.grids)
        for (const LookupTable::Axis& axis : grid.axes) read[static_cast<std::size_t>(axis.input)] = true;
    return read;
}

std::vector<bool> readInputs(const DecisionTrees& trees) {
    std::vector<bool> read(static_cast<std::size_t>(trees.inputs));
    for (const DecisionTrees::Tree& tree : trees.trees)
        for (const DecisionTrees::Node& node : tree.nodes)
            if (node.input >= 0) read[static_cast<std::size_t>(node.input)] = true;
    return read;
}

std::vector<bool> readInputs(const NearestNeighbours& of) {
    std::vector<bool> read(static_cast<std::size_t>(of.inputs));
    for (const int input : of.read) read[static_cast<std::size_t>(input)] = true;
    return read;
}

Mlp withInputs(const Mlp& mlp, std::span<const int> kept) {
    const auto [inputs, hidden, outputs] = mlp.shape;
    Mlp part{{static_cast<int>(kept.size()), hidden, outputs}, {}};
    for (int j = 0; j < hidden; ++j)
        for (const int i : kept) part.parameters.push_back(mlp.parameters[static_cast<std::size_t>(j * inputs + i)]);
    part.parameters.insert(part.parameters.end(), mlp.parameters.begin() + hidden * inputs, mlp.parameters.end());
    return part;
}

Mlp amongInputs(const Mlp& mlp, int inputs, std::span<const int> own) {
    const int hidden = mlp.shape.hidden;
    Mlp wide{{inputs, hidden, mlp.shape.outputs}, std::vector<float>(static_cast<std::size_t>(hidden * inputs))};
    const float* from = mlp.parameters.data();
    for (int j = 0; j < hidden; ++j)
        for (const int i : own) wide.parameters[static_cast<std::size_t>(j * inputs + i)] = *from++;
    wide.parameters.insert(wide.parameters.end(), from, mlp.parameters.data() + mlp.parameters.size());
    return wide;
}

/// With inputs by other numbers.
template <class NumberOf>
LookupTable renumbered(LookupTable table, int inputs, const NumberOf& numberOf) {
    table.inputs = inputs;
    for (LookupTable::Grid& grid : table.grids)
        for (LookupTable::Axis& axis : grid.axes) axis.input = numberOf(axis.input);
    return table;
}
template <class NumberOf>
DecisionTrees renumbered(DecisionTrees trees, int inputs, const NumberOf& numberOf) {
    trees.inputs = inputs;
    for (DecisionTrees::Tree& tree : trees.trees)
        for (DecisionTrees::Node& node : tree.nodes)
            if (node.input >= 0) node.input = numberOf(node.input);
    return trees;
}

template <class NumberOf>
NearestNeighbours renumbered(NearestNeighbours of, int inputs, const NumberOf& numberOf) {
    of.inputs = inputs;
    for (int& input : of.read) input = numberOf(input);
    return of;
}

template <class Family>
Family withInputs(const Family& of, std::span<const int> kept) {
    return renumbered(of, static_cast<int>(kept.size()), [&](int input) {
        return static_cast<int>(std::lower_bound(kept.begin(), kept.end(), input) - kept.begin());
    });
}

template <class Family>
Family amongInputs(const Family& of, int inputs, std::span<const int> own) {
    return renumbered(of, inputs, [&](int input) { return own[static_cast<std::size_t>(input)]; });
}

Mlp sideBySide(const Mlp& a, const Mlp& b) {
    const int inputs = a.shape.inputs, hidden = a.shape.hidden + b.shape.hidden;
    Mlp both{{inputs, hidden, a.shape.outputs + b.shape.outputs}, {}};
    std::vector<float>& to = both.parameters;
    const auto append = [&](const Mlp& mlp, int from, int count) {
        to.insert(to.end(), mlp.parameters.begin() + from, mlp.parameters.begin() + from + count);
    };
    for (const Mlp* mlp : {&a, &b}) append(*mlp, 0, mlp->shape.hidden * inputs);
    for (const Mlp* mlp : {&a, &b}) append(*mlp, mlp->shape.hidden * inputs, mlp->shape.hidden);
    for (const Mlp* mlp : {&a, &b})
        for (int k = 0; k < mlp->shape.outputs; ++k) {
            to.insert(to.end(), static_cast<std::size_t>(mlp == &a ? 0 : a.shape.hidden), 0.0f);
            append(*mlp, mlp->shape.hidden * (inputs + 1 + k), mlp->shape.hidden);
            to.insert(to.end(), static_cast<std::size_t>(mlp == &a ? b.shape.hidden : 0), 0.0f);
        }
    for (const Mlp* mlp : {&a, &b})
        append(*mlp, mlp->shape.hidden * (inputs + 1 + mlp->shape.outputs), mlp->shape.outputs);
    return both;
}

LookupTable sideBySide(const LookupTable& a, const LookupTable& b) {
    LookupTable both{a.inputs, a.outputs + b.outputs, {}};
    for (const LookupTable* table : {&a, &b})
        for (const LookupTable::Grid& grid : table->grids) {
            const std::size_t points = grid.points(), own = static_cast<std::size_t>(table->outputs);
            const std::size_t width = static_cast<std::size_t>(both.outputs);
            LookupTable::Grid wide{grid.axes, std::vector<float>(points * width)};
            for (std::size_t point = 0; point < points; ++point)
                std::copy_n(&grid.values[point * own], own,
                            &wide.values[point * width + static_cast<std::size_t>(table == &a ? 0 : a.outputs)]);
            both.grids.push_back(std::move(wide));
        }
    return both;
}

DecisionTrees sideBySide(const DecisionTrees& a, const DecisionTrees& b) {
    DecisionTrees both{a.inputs, a.outputs + b.outputs, a.trees};
    for (const DecisionTrees::Tree& tree : b.trees) both.trees.push_back({tree.output + a.outputs, tree.nodes});
    return both;
}

NearestNeighbours sideBySide(const NearestNeighbours& a, const NearestNeighbours& b) {
    assert(a.points == b.points && a.read == b.read && a.neighbours == b.neighbours);
    NearestNeighbours both{a.inputs, a.outputs + b.outputs, a.neighbours, a.read, a.points, {}};
    for (std::size_t p = 0; p < a.patterns(); ++p)
        for (const NearestNeighbours* of : {&a, &b}) {
            const auto from = of->values.begin() + static_cast<std::ptrdiff_t>(p) * of->outputs;
            both.values.insert(both.values.end(), from, from + of->outputs);
        }
    return both;
}

template <class Family>
constexpr bool isMlp = std::is_same_v<std::remove_cvref_t<Family>, Mlp>;

}  // namespace

int inputsOf(const Regressor& regressor) {
    return std::visit(
        [](const auto& of) {
            if constexpr (isMlp<decltype(of)>)
                return of.shape.inputs;
            else
                return of.inputs;
        },
        regressor);
}

int outputsOf(const Regressor& regressor) {
    return std::visit(
        [](const auto& of) {
            if constexpr (isMlp<decltype(of)>)
                return of.shape.outputs;
            else
                return of.outputs;
        },
        regressor);
}

Regressor withOutputs(const Regressor& regressor, int first, int count) {
    return std::visit([&](const auto& of) -> Regressor { return withOutputs(of, first, count); }, regressor);
}

std::vector<int> inputsReadBy(const Regressor& regressor) {
    const std::vector<bool> read = std::visit([](const auto& of) { return readInputs(of); }, regressor);
    std::vector<int> which;
    for (std::size_t i = 0; i < read.size(); ++i)
        if (read[i]) which.push_back(static_cast<int>(i));
    return which;
}

Regressor withInputs(const Regressor& regressor, std::span<const int> kept) {
    return std::visit([&](const auto& of) -> Regressor { return withInputs(of, kept); }, regressor);
}

Regressor amongInputs(const Regressor& regressor, int inputs, std::span<const int> own) {
    return std::visit([&](const auto& of) -> Regressor { return amongInputs(of, inputs, own); }, regressor);
}

Regressor sideBySide(const Regressor& first, const Regressor& second) {
    assert(first.index() == second.index() && inputsOf(first) == inputsOf(second));
    return std::visit(
        [&]<class Family>(const Family& of) -> Regressor { return sideBySide(of, std::get<Family>(second)); }, first);
}

RegressorInference::RegressorInference(const Regressor& regressor)
    : inputs_(inputsOf(regressor)),
      outputs_(outputsOf(regressor)),
      ready_(std::visit(
          [](const auto& of) -> decltype(ready_) {
              if constexpr (isMlp<decltype(of)>)
                  return MlpInference(of);
              else
                  return of;
          },
          regressor)) {}

void RegressorInference::batch(const float* rows, float* out, std::size_t n) const {
    if (const auto* const network = std::get_if<MlpInference>(&ready_)) return network->batch(rows, out, n);
    std::visit(
        [&](const auto& of) {
            if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(of)>, MlpInference>)
                for (std::size_t i = 0; i < n; ++i, rows += inputs_, out += outputs_) of.evaluate(rows, out);
        },
        ready_);
}

}  // namespace mrose
