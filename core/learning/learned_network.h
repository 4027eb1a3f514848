#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "learning/ensemble.h"
#include "learning/hold_out.h"
#include "learning/regressor.h"

namespace mrose {

/// An input or an output of a learned network: what it is, and how it is standardised. The network reads
/// (value - mean) / scale, and gives (value - mean) / scale.
struct NetworkVariable {
    std::string name;            ///< unique among the inputs, and among the outputs
    std::string unit;            ///< "m/s"; "1" of what has none
    double mean = 0, scale = 1;  ///< in that unit
    bool operator==(const NetworkVariable&) const = default;
};

/// A file that was learned from.
struct NetworkSource {
    std::string path, hash;  ///< as given; contentHash of its bytes
    bool operator==(const NetworkSource&) const = default;
};

/// How a network came about.
struct NetworkTraining {
    std::string command;  ///< the command line that made it
    std::string method;   ///< a name of trainingMethodNames
    std::string loss;     ///< "one-step", "rollout"
    std::uint64_t seed = 0;
    std::int64_t patterns = 0, epochs = 0;
    std::vector<NetworkSource> logs;
    bool operator==(const NetworkTraining&) const = default;
};

/// A learned mapping as a value: what is the same in all network files, whatever the mapping is for.
struct LearnedNetwork {
    static constexpr std::size_t maxInputs = 256, maxOutputs = 256, maxHidden = 4096, maxTrees = 4096;

    std::string kind;        ///< what it is a mapping of: "motion"
    bool synthetic = false;  ///< learned from data that no real robot made
    std::vector<NetworkVariable> inputs, outputs;
    Regressor regressor;
    std::vector<EnsembleMember> members;  ///< of an Mlp; empty where it is one network, or they are not known
    NetworkTraining training;
    HoldOut holdOut;
    bool operator==(const LearnedNetwork&) const = default;
};

}  // namespace mrose
