#include "plugin/network_mapping.h"

#include <stdexcept>

namespace mrose {

MappingVariable NetworkMapping::input(std::size_t index) const {
    MappingVariable variable = of(network_.learned.inputs[index]);
    if (!network_.seen.empty()) {
        variable.least = network_.seen[index].least;
        variable.most = network_.seen[index].most;
    }
    return variable;
}

void NetworkMapping::check(std::size_t from, std::size_t to) const {
    if (from == inputs() && to == outputs()) return;
    throw std::invalid_argument("a mapping of " + std::to_string(inputs()) + " numbers to " +
                                std::to_string(outputs()) + " was called with " + std::to_string(from) + " to " +
                                std::to_string(to));
}

void NetworkMapping::evaluate(std::span<const double> from, std::span<double> to) const {
    check(from.size(), to.size());
    inference_.evaluate(from.data(), to.data());
}

double NetworkMapping::beyond(std::span<const double> from) const {
    check(from.size(), outputs());
    return inference_.beyond(from.data());
}

Expected<NetworkMapping> parseMapping(const std::string& text, const std::string& name) {
    auto network = parseTask(text, name);
    if (!network) return tl::unexpected(network.error());
    return NetworkMapping(std::move(*network));
}

}  // namespace mrose
