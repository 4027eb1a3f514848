#include "learning/decision_trees.h"

#include <algorithm>
#include <array>

#include "learning/learned_network.h"

namespace mrose {

float DecisionTrees::Tree::evaluate(const float* x) const {
    const Node* node = nodes.data();
    while (node->input >= 0) node = nodes.data() + (x[node->input] <= node->value ? node->left : node->right);
    return node->value;
}

void DecisionTrees::evaluate(const float* x, float* y) const {
    std::array<int, LearnedNetwork::maxOutputs> count{};
    std::fill_n(y, outputs, 0.0f);
    for (const Tree& tree : trees) {
        y[tree.output] += tree.evaluate(x);
        ++count[static_cast<std::size_t>(tree.output)];
    }
    for (int k = 0; k < outputs; ++k)
        if (const int trees = count[static_cast<std::size_t>(k)]; trees > 1) y[k] /= static_cast<float>(trees);
}

std::size_t DecisionTrees::nodeCount() const {
    std::size_t count = 0;
    for (const Tree& tree : trees) count += tree.nodes.size();
    return count;
}

}  // namespace mrose
