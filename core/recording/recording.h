#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/controller.h"
#include "io/error.h"
#include "io/file.h"
#include "recording/history.h"
#include "recording/origin.h"
#include "scenario/scenario_file.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// What a run was, besides its ticks.
struct RecordingHeader {
    ScenarioValuePointer value;         ///< null: the recording does not hold it
    std::optional<Error> unknown = {};  ///< why, where it should
    std::string commandLine;
    Origin origin;
    std::string name;  ///< of the scenario
    std::uint64_t seed = 0;
    Nanoseconds tickLength = 0;
    /// What each robot's controller asked for: by it the arrays of commands and memory in a state are laid out.
    struct ControllerNeeds {
        std::uint64_t memorySize = 0, commandsPerPeriod = 1;
        bool operator==(const ControllerNeeds&) const = default;
    };
    std::vector<ControllerNeeds> controllers;
};

/// What was shown when a recording was saved.
struct ShownPlace {
    std::uint32_t branch = 0;
    std::int64_t tick = 0;  ///< of that branch, or of one that it came from
    bool operator==(const ShownPlace&) const = default;
};

/// Stands in for a recorded robot's controller that is not at hand, so that the states' layout stays: decides nothing.
class RecordedController final : public Controller {
public:
    explicit RecordedController(const RecordingHeader::ControllerNeeds& needs) : needs_(needs) {}
    std::size_t memorySize() const override { return needs_.memorySize; }
    std::size_t commandsPerPeriod(Nanoseconds) const override { return needs_.commandsPerPeriod; }
    Attention attention() const override { return Attention::ofItself(); }
    void decide(const Observation&, std::span<std::byte>, Decision&) const override {}

private:
    RecordingHeader::ControllerNeeds needs_;
};

/// A run as it was recorded. Playback (playback.h) reaches its ticks, replay (replay.h) runs it again.
struct Recording {
    RecordingHeader header;
    std::vector<Branch> branches;  ///< the run itself first; never empty
    /// Of each branch's scenario what the header says of the run's.
    struct Layout {
        Nanoseconds tickLength = 0;
        std::vector<RecordingHeader::ControllerNeeds> controllers;
    };
    std::vector<Layout> layouts;
    std::optional<ShownPlace> shown;
    std::vector<std::string> damage;  ///< what is wrong with the file, a sentence each; the recording ends before it
    bool endless = false;             ///< its end is missing, which is damage, too: perhaps it is still being written

    /// Of the scenario that a branch runs in; null: the recording does not hold it.
    const ScenarioValuePointer& valueOf(std::uint32_t branch) const {
        return branches[branch].value ? branches[branch].value : header.value;
    }
};

/// Opens a recording. One that was cut off, or is damaged in its middle, or unpacked takes more than mostBytesRead(),
/// opens up to there and says so. Error: it cannot be read, is no recording of mrose, or not even its beginning is
/// whole: its controllers ask for other memory than its first state has, too.
Expected<Recording> openRecording(const std::filesystem::path& path);
/// The same of a file's bytes; `name` is said in errors. `most`: bytes that it may take unpacked.
Expected<Recording> parseRecording(std::string_view bytes, const std::string& name,
                                   std::uint64_t most = mostBytesRead());

/// The scenario of a branch, from its value in the recording. Without a loader of plug-ins no controller is at hand,
/// and their stand-ins keep the states' layout. Error: as of loadScenario().
Expected<ScenarioParts> recordedScenario(const Recording& recording, std::uint32_t branch,
                                         const PluginLoader& plugins = {});

}  // namespace mrose
