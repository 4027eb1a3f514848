#include "learning/ensemble.h"

#include <algorithm>
#include <cassert>

namespace mrose {
namespace {

/// Where the parts of a network's parameters begin.
struct Layout {
    explicit Layout(const MlpShape& shape)
        : inputs(static_cast<std::size_t>(shape.inputs)),
          hidden(static_cast<std::size_t>(shape.hidden)),
          biases(hidden * inputs),
          outWeights(biases + hidden),
          outBiases(outWeights + hidden * static_cast<std::size_t>(shape.outputs)) {}
    std::size_t inputs, hidden, biases, outWeights, outBiases;
};

/// A mean as mergedMean() rounds it.
float meanBias(std::span<const EnsembleMember> members, std::size_t output) {
    float mean = 0;
    for (const EnsembleMember& member : members) mean += member.outputBiases[output] / float(members.size());
    return mean;
}

}  // namespace

Mlp mergedMean(std::span<const Mlp> networks) {
    const std::vector<EnsembleMember> members = membersOf(networks);
    const auto count = static_cast<float>(networks.size());
    const int inputs = networks.front().shape.inputs, outputs = networks.front().shape.outputs;
    Mlp mean{{inputs, 0, outputs}, {}};
    for (const EnsembleMember& member : members) mean.shape.hidden += member.hidden;
    std::vector<float>& p = mean.parameters;
    p.reserve(mean.shape.parameterCount());
    for (const Mlp& network : networks) {
        assert(network.shape.inputs == inputs && network.shape.outputs == outputs);
        const float* const from = network.parameters.data();
        p.insert(p.end(), from, from + Layout(network.shape).biases);
    }
    for (const Mlp& network : networks) {
        const Layout at(network.shape);
        const float* const from = network.parameters.data();
        p.insert(p.end(), from + at.biases, from + at.outWeights);
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(outputs); ++k)
        for (const Mlp& network : networks) {
            const Layout at(network.shape);
            for (std::size_t j = 0; j < at.hidden; ++j)
                p.push_back(network.parameters[at.outWeights + k * at.hidden + j] / count);
        }
    for (std::size_t k = 0; k < static_cast<std::size_t>(outputs); ++k) p.push_back(meanBias(members, k));
    return mean;
}

std::vector<EnsembleMember> membersOf(std::span<const Mlp> networks) {
    std::vector<EnsembleMember> members;
    for (const Mlp& network : networks)
        members.push_back(
            {network.shape.hidden, {network.parameters.end() - network.shape.outputs, network.parameters.end()}});
    return members;
}

Mlp memberOf(const Mlp& ensemble, std::span<const EnsembleMember> members, std::size_t index) {
    assert(isMeanOf(ensemble, members) && index < members.size());
    const EnsembleMember& member = members[index];
    std::size_t first = 0;
    for (std::size_t i = 0; i < index; ++i) first += static_cast<std::size_t>(members[i].hidden);
    Mlp own{{ensemble.shape.inputs, member.hidden, static_cast<int>(member.outputBiases.size())}, {}};
    const Layout at(ensemble.shape), ownAt(own.shape);
    const float* const from = ensemble.parameters.data();
    std::vector<float>& p = own.parameters;
    p.insert(p.end(), from + first * at.inputs, from + (first + ownAt.hidden) * at.inputs);
    p.insert(p.end(), from + at.biases + first, from + at.biases + first + ownAt.hidden);
    for (std::size_t k = 0; k < member.outputBiases.size(); ++k)
        for (std::size_t j = 0; j < ownAt.hidden; ++j)
            p.push_back(from[at.outWeights + k * at.hidden + first + j] * float(members.size()));
    p.insert(p.end(), member.outputBiases.begin(), member.outputBiases.end());
    return own;
}

Mlp withMemberOutputs(const Mlp& ensemble, std::span<const EnsembleMember> members) {
    assert(isMeanOf(ensemble, members));
    const Layout at(ensemble.shape);
    const std::size_t own = members.front().outputBiases.size();
    Mlp all = ensemble;
    all.shape.outputs += static_cast<int>(members.size() * own);
    std::vector<float>& p = all.parameters;
    p.resize(at.outBiases);
    std::size_t first = 0;
    for (const EnsembleMember& member : members) {
        const std::size_t end = first + static_cast<std::size_t>(member.hidden);
        for (std::size_t k = 0; k < own; ++k)
            for (std::size_t j = 0; j < at.hidden; ++j) {
                const bool ofMember = j >= first && j < end;
                p.push_back(ofMember ? p[at.outWeights + k * at.hidden + j] * float(members.size()) : 0);
            }
        first = end;
    }
    p.insert(p.end(), ensemble.parameters.begin() + std::ptrdiff_t(at.outBiases), ensemble.parameters.end());
    for (const EnsembleMember& member : members)
        p.insert(p.end(), member.outputBiases.begin(), member.outputBiases.end());
    return all;
}

bool isMeanOf(const Mlp& ensemble, std::span<const EnsembleMember> members) {
    if (members.empty()) return false;
    const std::size_t outputs = members.front().outputBiases.size();
    int hidden = 0;
    for (const EnsembleMember& member : members) {
        if (member.hidden < 1 || member.outputBiases.size() != outputs) return false;
        hidden += member.hidden;
    }
    if (hidden != ensemble.shape.hidden || outputs < 1 || outputs > std::size_t(ensemble.shape.outputs)) return false;
    const float* const biases = ensemble.parameters.data() + Layout(ensemble.shape).outBiases;
    for (std::size_t k = 0; k < outputs; ++k)
        if (biases[k] != meanBias(members, k)) return false;
    return true;
}

}  // namespace mrose
