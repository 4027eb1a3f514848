#pragma once

#include <functional>
#include <string>
#include <vector>

#include "recording/recording.h"
#include "recording/replay.h"
#include "workflow/plugins.h"

namespace mrose {

/// Which recording is run again and compared tick by tick.
struct ReplayRequest {
    std::string recording;
    bool decide = false;  ///< see ReplayOptions
    PluginUse plugins = {};
};

/// How a replay is watched and ended. Each may be empty.
struct ReplayWatch {
    /// What must be known of the recording, as soon as it is read: damage, by the file's name; another origin.
    std::function<void(const std::vector<Error>& notes)> opened = {};
    std::function<bool(std::int64_t done, std::int64_t all)> progress = {};  ///< in ticks
};

struct ReplayedRecording {
    Recording recording;
    ReplayReport report;
    std::vector<Error> notes;
};

/// Error: as of openRecording() and recordedScenario(), and of the replay() of recording/replay.h; a plug-in.
Expected<ReplayedRecording> replayRecording(const ReplayRequest& request, const ReplayWatch& watch = {});

}  // namespace mrose
