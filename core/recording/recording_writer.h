#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/error.h"
#include "recording/recording.h"
#include "recording/scene_topics.h"
#include "recording/timeline.h"

namespace mrose {

/// Writes a run to a file while it goes on, such that at every moment what was written so far can be opened, also after
/// a kill. Where the disk is full, the file is removed, moved or replaced, or anything else goes wrong, it stays as it
/// was after the last part written whole, `state()` says what happened, and everything further does nothing: the run
/// may go on.
///
/// A part is written when ticks for one keyframe interval are together, and at flush(): a program whose run keeps pace
/// with the clock calls it about once a second.
class RecordingWriter {
public:
    struct Options {
        bool overwrite = false;             ///< false: an Error where there is a file already
        std::int64_t keyframeInterval = 0;  ///< see Timeline
        Origin origin = thisOrigin();
        std::string name = {};  ///< of the run, as branches have names
    };
    /// The scenario must stay as long as the writer; `value` is what it was made from. Error: what the system says; a
    /// running program records there.
    static Expected<RecordingWriter> create(const std::filesystem::path& path, const Scenario& scenario,
                                            const WorldState& initial, const ScenarioValuePointer& value,
                                            const std::string& commandLine, const Options& options);
    static Expected<RecordingWriter> create(const std::filesystem::path& path, const Scenario& scenario,
                                            const WorldState& initial, const ScenarioValuePointer& value = {},
                                            const std::string& commandLine = {}) {
        return create(path, scenario, initial, value, commandLine, Options{});
    }

    /// One tick more at the end of a branch: the state after it and its trace.
    void add(const WorldState& after, const StepTrace& trace, std::uint32_t branch = 0);
    /// A new branch of its parent's scenario that begins with `state`, at its tick; its index.
    std::uint32_t beginBranch(std::uint32_t parent, const WorldState& state, const std::string& name);
    /// The same of a scenario of its own, which must stay as long as the writer.
    std::uint32_t beginBranch(std::uint32_t parent, const WorldState& state, const std::string& name,
                              const Scenario& scenario, const ScenarioValuePointer& value);
    /// Ticks that a timeline kept, which must go on where the branch ends; what other programs see of each of them is
    /// passed to show() before.
    void add(const TimelineBlock& kept, std::uint32_t branch);
    void show(const WorldState& after, const StepTrace& trace, std::uint32_t branch);
    /// Keeps the state added last, so that a replay which differs before it can say in what: for the end of a run.
    void keep(const WorldState& state, std::uint32_t branch = 0);

    /// Where the recording is to be opened.
    void keepShown(const ShownPlace& place);

    /// All ticks so far onto the disk; of what other programs see the last 128 KB may be kept back.
    void flush();
    /// The same, and the summary by which other programs find their way. Error: the first thing that went wrong.
    Expected<void> close();
    const Expected<void>& state() const { return mcap_.state(); }

private:
    RecordingWriter(mcap::Writer mcap, const Scenario& scenario, ScenarioValuePointer value,
                    std::int64_t keyframeInterval)
        : mcap_(std::move(mcap)),
          run_(std::move(value)),
          schemas_(SceneTopics::addSchemas(mcap_, scenario)),
          keyframeInterval_(keyframeInterval) {}
    void writeHeader(const RecordingHeader& header);
    void startBranch(std::uint32_t parent, const WorldState& state, const std::string& name, const Scenario& scenario,
                     const SceneTopics::Schemas& schemas);
    void writeBlock(std::uint32_t branch);

    struct OpenBranch {
        const Scenario* scenario;
        SceneTopics::Schemas schemas;
        TimelineBlock block;         ///< not yet written
        std::int64_t lastKeyframe;   ///< its tick
        std::int64_t keyframeEvery;  ///< ticks
        SceneTopics topics;
    };
    mcap::Writer mcap_;
    ScenarioValuePointer run_;
    SceneTopics::Schemas schemas_;
    std::int64_t keyframeInterval_;
    std::vector<OpenBranch> branches_;
};

}  // namespace mrose
