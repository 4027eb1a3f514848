#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/error.h"
#include "recording/history.h"
#include "recording/origin.h"
#include "recording/recording.h"
#include "scenario/scenario.h"

namespace mrose {

struct SaveRecordingOptions {
    bool overwrite = false;  ///< false: an Error where there is a file already
    std::string commandLine;
    Origin origin = thisOrigin();          ///< of a recording that was opened: its own
    std::optional<ShownPlace> shown = {};  ///< where it is to be opened
    /// Called now and then with how many ticks are done of how many; false ends the saving.
    std::function<bool(std::int64_t, std::int64_t)> progress;
};

/// Writes what a running program kept (History) as a recording: each branch as it is, tick by tick, from the earliest
/// that is still kept. `scenarios` are those of the branches, one each, and `run` the descriptions of those that have
/// none of their own. The file is written beside its place and replaces what is there in the end: after an error, or
/// where progress() ended it, all is as it was. False: progress() did. Error: what the system says; a branch is none of
/// its scenario.
Expected<bool> saveRecording(const std::filesystem::path& path, std::span<const Branch> branches,
                             std::span<const std::shared_ptr<const Scenario>> scenarios,
                             const ScenarioValuePointer& run, const SaveRecordingOptions& options = {});

}  // namespace mrose
