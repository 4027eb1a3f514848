#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "debug/time_travel.h"
#include "io/progress.h"
#include "recording/playback.h"
#include "recording/recording_writer.h"

namespace mrose {

/// Writes a run and all its branches to a file while they grow: what was before it began, too. It reads what the run
/// keeps, so that it needs no notification.
class RunRecorder {
public:
    /// Error: there is such a file already, unless it may be replaced; what the system says.
    static Expected<RunRecorder> begin(const std::filesystem::path& path, const TimeTravel& run,
                                       const std::string& commandLine, bool overwrite);

    const std::filesystem::path& path() const { return path_; }
    /// At most `ticks` of what is not yet written; whether there are more. Error: the first thing that went wrong; the
    /// file ends before it, and nothing further is written.
    Expected<bool> follow(const TimeTravel& run, std::int64_t ticks);
    /// Onto the disk; about once a second, so that a kill loses no more. Error: as of follow(); or the file is not
    /// where it was begun any more.
    Expected<void> flush();
    /// Error: as of follow().
    Expected<void> finish(const TimeTravel& run);

private:
    RunRecorder(std::filesystem::path path, RecordingWriter writer)
        : path_(std::move(path)), writer_(std::move(writer)) {
        trace_.asksUnread = true;
    }
    struct Written {
        Written(BranchSetupPointer of, ReachedState start)
            : setup(std::move(of)), playback(*setup->scenario), at(std::move(start)) {}
        BranchSetupPointer setup;  ///< which the writer needs
        Playback playback;
        ReachedState at;
    };
    /// A branch and those that it departs from; not those that are written already.
    Expected<void> open(const TimeTravel& run, std::uint32_t branch);
    bool opened(std::uint32_t branch) const { return branch < places_.size() && places_[branch]; }
    Expected<void> writeTick(const Timeline& timeline, std::uint32_t place);

    std::filesystem::path path_;
    RecordingWriter writer_;
    std::deque<Written> branches_;
    std::vector<std::optional<std::uint32_t>> places_;  ///< of the run's branches among those
    StepTrace trace_;
};

/// All that a run keeps, with its branches and the place that is shown, as a file that replaces what is there. False:
/// `progress`, called with the share that is done, ended it. Error: as of saveRecording().
Expected<bool> saveRun(const std::filesystem::path& path, const TimeTravel& run, const std::string& commandLine,
                       const Progress& progress);

}  // namespace mrose
