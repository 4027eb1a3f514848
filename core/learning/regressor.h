#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "learning/decision_trees.h"
#include "learning/lookup_table.h"
#include "learning/mlp.h"
#include "learning/mlp_inference.h"
#include "learning/nearest_neighbours.h"

namespace mrose {

/// What maps the standardised inputs of something learned to its standardised outputs, by family.
using Regressor = std::variant<Mlp, LookupTable, DecisionTrees, NearestNeighbours>;

enum class RegressorFamily { network, table, trees, neighbours };
/// By RegressorFamily, which is the variant's index: as command lines and network files name them.
constexpr std::array<std::string_view, 4> regressorFamilyNames{"network", "table", "trees", "neighbours"};
/// Of what can be learned of logs: sensors.
constexpr std::span<const std::string_view> sensorFamilyNames = std::span(regressorFamilyNames).first(3);
inline RegressorFamily familyOf(const Regressor& regressor) { return static_cast<RegressorFamily>(regressor.index()); }
constexpr std::string_view nameOf(RegressorFamily family) {
    return regressorFamilyNames[static_cast<std::size_t>(family)];
}

int inputsOf(const Regressor& regressor);
int outputsOf(const Regressor& regressor);

/// The same mapping to `count` of its outputs from `first` on, without what none of them needs.
Regressor withOutputs(const Regressor& regressor, int first, int count);

/// Which inputs it depends on at all, ascending.
std::vector<int> inputsReadBy(const Regressor& regressor);

/// The same mapping of `kept` of its inputs, ascending, which hold all that it reads.
Regressor withInputs(const Regressor& regressor, std::span<const int> kept);

/// The reverse: of `inputs` inputs it reads those that are listed, ascending, as its own.
Regressor amongInputs(const Regressor& regressor, int inputs, std::span<const int> own);

/// One mapping to the outputs of both, the first's before the second's: they are of one family and have equal inputs;
/// neighbours have the same points, too.
Regressor sideBySide(const Regressor& first, const Regressor& second);

/// A regressor made ready for evaluation; const, so that threads may share it. A row's outputs have the same bits
/// alone, in any batch, and on every processor.
class RegressorInference {
public:
    explicit RegressorInference(const Regressor& regressor);

    int inputs() const { return inputs_; }
    int outputs() const { return outputs_; }

    /// x: inputs() floats, y: outputs() floats. They may not overlap.
    void one(const float* x, float* y) const { batch(x, y, 1); }
    /// rows: n x inputs(), out: n x outputs(), both by rows. They may not overlap.
    void batch(const float* rows, float* out, std::size_t n) const;

private:
    int inputs_, outputs_;
    std::variant<MlpInference, LookupTable, DecisionTrees, NearestNeighbours> ready_;
};

}  // namespace mrose
