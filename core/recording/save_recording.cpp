#include "recording/save_recording.h"

#include <cassert>
#include <optional>

#include "io/file.h"
#include "io/pending_file.h"
#include "recording/playback.h"
#include "recording/recording_writer.h"
#include "scenario/first_version.h"

namespace mrose {
namespace {

class RecordingSaver {
public:
    RecordingSaver(std::span<const Branch> branches, std::span<const std::shared_ptr<const Scenario>> scenarios,
                   const ScenarioValuePointer& run, const SaveRecordingOptions& options)
        : branches_(branches), scenarios_(scenarios), run_(run), options_(options) {
        trace_.asksUnread = true;
        for (const Branch& branch : branches) ticks_ += branch.timeline.last() - branch.timeline.first();
    }

    /// False: progress() ended it.
    Expected<bool> writeTo(const std::filesystem::path& path) {
        for (std::uint32_t branch = 0; branch < branches_.size(); ++branch) {
            if (auto begun = begin(path, branch); !begun) return tl::unexpected(begun.error());
            auto written = writeTicks(branch);
            if (!written || !*written) return written;
        }
        if (options_.shown) writer_->keepShown(*options_.shown);
        if (auto closed = writer_->close(); !closed) return tl::unexpected(closed.error());
        return true;
    }

private:
    const ScenarioValuePointer& valueOf(std::uint32_t branch) const {
        return branches_[branch].value ? branches_[branch].value : run_;
    }

    Expected<void> begin(const std::filesystem::path& path, std::uint32_t branch) {
        const Branch& own = branches_[branch];
        const Scenario& scenario = *scenarios_[branch];
        auto state = parseStateOf(scenario, own.timeline.blocks().front().keyframe, "the beginning of a branch");
        if (!state) return tl::unexpected(state.error());
        if (const std::string wrong = validate(scenario, *state); !wrong.empty())
            return fail(
                {}, "the beginning of branch " + std::to_string(branch) + " is none of its scenario: it has " + wrong);
        if (branch == 0) {
            auto writer = RecordingWriter::create(path, scenario, *state, run_, options_.commandLine,
                                                  {true, 0, options_.origin, own.name});
            if (!writer) return tl::unexpected(writer.error());
            writer_.emplace(std::move(*writer));
        } else if (scenarios_[own.parent] == scenarios_[branch] && valueOf(own.parent) == valueOf(branch)) {
            writer_->beginBranch(own.parent, *state, own.name);
        } else {
            writer_->beginBranch(own.parent, *state, own.name, scenario, valueOf(branch));
        }
        return {};
    }

    Expected<bool> writeTicks(std::uint32_t branch) {
        const Timeline& timeline = branches_[branch].timeline;
        Playback playback(*scenarios_[branch]);
        auto reached = playback.reach(timeline, timeline.first());
        if (!reached) return tl::unexpected(reached.error());
        for (const TimelineBlock& block : timeline.blocks()) {
            while (reached->state.tick < block.last()) {
                if (auto next = playback.advance(timeline, *reached, trace_); !next)
                    return tl::unexpected(next.error());
                writer_->show(reached->state, trace_, branch);
                if (++done_ % ticksBetweenProgress == 0 && !goOn()) return false;
            }
            writer_->add(block, branch);
            if (!writer_->state()) return tl::unexpected(writer_->state().error());
        }
        return goOn();
    }

    bool goOn() const { return !options_.progress || options_.progress(done_, ticks_); }

    static constexpr std::int64_t ticksBetweenProgress = 64;

    std::span<const Branch> branches_;
    std::span<const std::shared_ptr<const Scenario>> scenarios_;
    const ScenarioValuePointer& run_;
    const SaveRecordingOptions& options_;
    std::optional<RecordingWriter> writer_;
    StepTrace trace_;
    std::int64_t done_ = 0, ticks_ = 0;
};

}  // namespace

Expected<bool> saveRecording(const std::filesystem::path& path, std::span<const Branch> branches,
                             std::span<const std::shared_ptr<const Scenario>> scenarios,
                             const ScenarioValuePointer& run, const SaveRecordingOptions& options) {
    assert(!branches.empty() && scenarios.size() == branches.size());
    if (auto writable = checkWritable(path, options.overwrite); !writable) return tl::unexpected(writable.error());
    PendingFile file(path);
    if (auto begun = file.write({}); !begun) return tl::unexpected(begun.error());
    auto written = RecordingSaver(branches, scenarios, run, options).writeTo(file.beside());
    if (!written) {
        // Files beside it do not matter.
        Error error = written.error();
        error.file = path.string();
        return tl::unexpected(error);
    }
    if (!*written) return false;
    if (auto replaced = file.replace(); !replaced) return tl::unexpected(replaced.error());
    return true;
}

}  // namespace mrose
