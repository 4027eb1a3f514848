#pragma once

#include <string>

#include "control/learned_mapping.h"
#include "io/toml_table.h"
#include "learning/learned_network.h"
#include "learning/regressor.h"

namespace mrose {

/// A network of a task as controllers call it.
class NetworkMapping final : public LearnedMapping {
public:
    static constexpr const char* kind = "task";  ///< of its network files

    explicit NetworkMapping(LearnedNetwork network) : network_(std::move(network)), inference_(network_.regressor) {}

    std::size_t inputs() const override { return network_.inputs.size(); }
    std::size_t outputs() const override { return network_.outputs.size(); }
    MappingVariable input(std::size_t index) const override { return of(network_.inputs[index]); }
    MappingVariable output(std::size_t index) const override { return of(network_.outputs[index]); }
    void evaluate(std::span<const double> from, std::span<double> to) const override;

private:
    static MappingVariable of(const NetworkVariable& variable) {
        return {variable.name.c_str(), variable.unit.c_str()};
    }

    LearnedNetwork network_;
    RegressorInference inference_;
};

/// From the text of a network file. Error: as of readNetworkFile(), in a file called `name`.
Expected<NetworkMapping> parseMapping(const std::string& text, const std::string& name);

}  // namespace mrose
