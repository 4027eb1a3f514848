#pragma once

#include <cstddef>
#include <vector>

namespace mrose {

/// Decision trees of standardised inputs and outputs: an output is the mean of its trees, 0 where it has none.
struct DecisionTrees {
    static constexpr std::size_t maxNodes = 1 << 20;  ///< of all trees

    struct Node {
        int input = -1;  ///< which input it asks for; -1: a leaf
        float value =
            0;  ///< it goes on at `left` where the input is at most this, else at `right`; of a leaf the result
        int left = 0, right = 0;  ///< greater than the node's own index
        bool operator==(const Node&) const = default;
    };
    struct Tree {
        int output = 0;           ///< which output
        std::vector<Node> nodes;  ///< the root first
        bool operator==(const Tree&) const = default;

        float evaluate(const float* x) const;
    };

    int inputs = 0, outputs = 0;
    std::vector<Tree> trees;
    bool operator==(const DecisionTrees&) const = default;

    /// x: `inputs` floats, y: `outputs` floats. They may not overlap.
    void evaluate(const float* x, float* y) const;

    std::size_t nodeCount() const;
};

}  // namespace mrose
