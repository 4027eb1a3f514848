#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assessment/reality.h"
#include "debug/branch_setup.h"
#include "recording/history.h"
#include "recording/recording.h"
#include "world/world_state.h"

namespace mrose {

/// What is to be opened, and how: as it can be opened again.
struct OpenRequest {
    std::string file;  ///< a scenario, one that ships by its name, or a recording
    std::uint32_t trial = 0;
    std::optional<std::uint64_t> seed = {};   ///< otherwise the scenario's
    std::string log = {};                     ///< read instead of those that the scenario names
    double pluginLimit = 2;                   ///< s, for each decision of a plug-in
    std::string variant = {};                 ///< of an experiment, whose trial it is; empty: the first
    std::vector<std::string> overrides = {};  ///< "PATH=VALUE", in the scenario
    std::vector<std::string> settings = {};   ///< files whose values are put into it before
};

/// What a debugger is given to go through.
struct OpenedRun {
    std::string name;  ///< for the title
    OpenRequest source;
    BranchSetupPointer setup;
    WorldState start;
    std::shared_ptr<const Reality> reality = nullptr;  ///< what it is laid over; null: nothing
    /// Of a recording, the run itself first. Empty: nothing has been yet.
    struct Recorded {
        Branch branch;
        BranchSetupPointer setup;
        WorldState start;
    };
    std::vector<Recorded> branches = {};
    std::vector<std::string> notes = {};
    /// Files that it was made from, with the hashes of what was read: descriptions, logs, plug-ins.
    std::map<std::string, std::string> files = {};
    std::optional<ShownPlace> shown = {};  ///< of a recording: what was shown when it was saved
    std::optional<Origin> origin = {};     ///< of a recording: what computed it

    bool recorded() const { return !branches.empty(); }
};

}  // namespace mrose
