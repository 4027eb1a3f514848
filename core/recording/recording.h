#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/controller.h"
#include "io/error.h"
#include "recording/history.h"
#include "recording/origin.h"
#include "scenario/scenario.h"

namespace mrose {

/// What a scenario was made from, as its loader gave it and takes it again.
struct Descriptions {
    std::string scenario;                      ///< name of the scenario's own text
    std::map<std::string, std::string> texts;  ///< all of them by their names
    bool operator==(const Descriptions&) const = default;
};

/// What a run was, besides its ticks.
struct RecordingHeader {
    Descriptions descriptions;
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
    bool operator==(const RecordingHeader&) const = default;
};

/// Stands in for a recorded robot's controller that is not at hand, so that the states' layout stays: decides nothing.
class RecordedController final : public Controller {
public:
    explicit RecordedController(const RecordingHeader::ControllerNeeds& needs) : needs_(needs) {}
    std::size_t memorySize() const override { return needs_.memorySize; }
    std::size_t commandsPerPeriod(Nanoseconds) const override { return needs_.commandsPerPeriod; }
    Attention attention() const override { return {.robots = false, .objects = false}; }
    void decide(const Observation&, std::span<std::byte>, Decision&) const override {}

private:
    RecordingHeader::ControllerNeeds needs_;
};

/// A run as it was recorded. Playback (playback.h) reaches its ticks, replay (replay.h) runs it again.
struct Recording {
    RecordingHeader header;
    std::vector<Branch> branches;     ///< the run itself first; never empty
    std::vector<std::string> damage;  ///< what is wrong with the file, a sentence each; the recording ends before it
};

/// Opens a recording. One that was cut off, or is damaged in its middle, opens up to there and says so. Error: it
/// cannot be read, is no recording of mrose, or not even its beginning is whole.
Expected<Recording> openRecording(const std::filesystem::path& path);
/// The same of a file's bytes; `name` is said in errors.
Expected<Recording> parseRecording(std::string_view bytes, const std::string& name);

}  // namespace mrose
