#pragma once

#include <string>

#include "control/learned_mapping.h"
#include "learning/task_network.h"

namespace mrose {

/// A network of a task as controllers call it.
class NetworkMapping final : public LearnedMapping {
public:
    explicit NetworkMapping(TaskNetwork network) : network_(std::move(network)), inference_(network_) {}

    std::size_t inputs() const override { return inference_.inputs(); }
    std::size_t outputs() const override { return inference_.outputs(); }
    MappingVariable input(std::size_t index) const override;
    MappingVariable output(std::size_t index) const override { return of(network_.learned.outputs[index]); }
    void evaluate(std::span<const double> from, std::span<double> to) const override;
    double beyond(std::span<const double> from) const override;

private:
    static MappingVariable of(const NetworkVariable& variable) {
        return {variable.name.c_str(), variable.unit.c_str()};
    }
    void check(std::size_t from, std::size_t to) const;

    TaskNetwork network_;
    TaskInference inference_;
};

/// From the text of a network file. Error: as of parseTask(), in a file called `name`.
Expected<NetworkMapping> parseMapping(const std::string& text, const std::string& name);

}  // namespace mrose
