#include "plugin/network_mapping.h"

#include <array>
#include <stdexcept>

#include "learning/network_file.h"

namespace mrose {

void NetworkMapping::evaluate(std::span<const double> from, std::span<double> to) const {
    if (from.size() != inputs() || to.size() != outputs())
        throw std::invalid_argument("a mapping of " + std::to_string(inputs()) + " numbers to " +
                                    std::to_string(outputs()) + " was called with " + std::to_string(from.size()) +
                                    " to " + std::to_string(to.size()));
    std::array<float, LearnedNetwork::maxInputs> x;
    std::array<float, LearnedNetwork::maxOutputs> y;
    for (std::size_t i = 0; i < from.size(); ++i)
        x[i] = static_cast<float>((from[i] - network_.inputs[i].mean) / network_.inputs[i].scale);
    inference_.one(x.data(), y.data());
    for (std::size_t i = 0; i < to.size(); ++i)
        to[i] = network_.outputs[i].mean + network_.outputs[i].scale * static_cast<double>(y[i]);
}

Expected<NetworkMapping> parseMapping(const std::string& text, const std::string& name) {
    TomlTable root(text, name);
    auto network = readNetworkFile(root, NetworkMapping::kind, [](TomlTable&, const LearnedNetwork&) {});
    if (!network) return tl::unexpected(network.error());
    return NetworkMapping(std::move(*network));
}

}  // namespace mrose
