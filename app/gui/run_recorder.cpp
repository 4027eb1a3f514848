#include "run_recorder.h"

#include <algorithm>

#include "recording/save_recording.h"

namespace mrose::gui {

Expected<RunRecorder> RunRecorder::begin(const std::filesystem::path& path, const TimeTravel& run,
                                         const std::string& commandLine, bool overwrite) {
    const Course& course = run.record(0).course();
    const Timeline& timeline = run.branches().front().timeline;
    auto start = Playback(*course.scenario).reach(timeline, timeline.first());
    if (!start) return tl::unexpected(start.error());
    auto writer = RecordingWriter::create(path, *course.scenario, start->state, course.descriptions, commandLine,
                                          {.overwrite = overwrite});
    if (!writer) return tl::unexpected(writer.error());
    RunRecorder recorder(path, std::move(*writer));
    recorder.branches_.emplace_back(run.record(0).coursePointer(), std::move(*start));
    return recorder;
}

Expected<void> RunRecorder::open(const TimeTravel& run, std::uint32_t branch) {
    const Branch& begun = run.branches()[branch];
    const CoursePointer& course = run.record(branch).coursePointer();
    auto start = Playback(*course->scenario).reach(begun.timeline, begun.timeline.first());
    if (!start) return tl::unexpected(start.error());
    if (course == run.record(begun.parent).coursePointer())
        writer_.beginBranch(begun.parent, start->state, begun.name);
    else
        writer_.beginBranch(begun.parent, start->state, begun.name, *course->scenario, course->descriptions);
    branches_.emplace_back(course, std::move(*start));
    return {};
}

Expected<void> RunRecorder::writeTick(const Timeline& timeline, std::uint32_t branch) {
    Written& written = branches_[branch];
    if (auto done = written.playback.advance(timeline, written.at, trace_); !done) return done;
    writer_.add(written.at.state, trace_, branch);
    return writer_.state();
}

Expected<bool> RunRecorder::follow(const TimeTravel& run, std::int64_t ticks) {
    for (std::uint32_t branch = 0; branch < run.branches().size(); ++branch) {
        if (branch == branches_.size())
            if (auto opened = open(run, branch); !opened) return tl::unexpected(opened.error());
        const Timeline& timeline = run.branches()[branch].timeline;
        for (; branches_[branch].at.state.tick < timeline.last(); --ticks) {
            if (ticks <= 0) return true;
            if (auto done = writeTick(timeline, branch); !done) return tl::unexpected(done.error());
        }
    }
    if (!writer_.state()) return tl::unexpected(writer_.state().error());
    return false;
}

Expected<void> RunRecorder::finish(const TimeTravel& run) {
    for (;;) {
        const auto more = follow(run, 1000);
        if (!more) return tl::unexpected(more.error());
        if (!*more) break;
    }
    for (std::uint32_t branch = 0; branch < branches_.size(); ++branch)
        writer_.keep(branches_[branch].at.state, branch);
    return writer_.close();
}

Expected<bool> saveRun(const std::filesystem::path& path, const TimeTravel& run, const std::string& commandLine,
                       const std::function<bool(double share)>& progress) {
    std::vector<std::shared_ptr<const Scenario>> scenarios;
    for (std::uint32_t branch = 0; branch < run.branches().size(); ++branch)
        scenarios.push_back(run.record(branch).course().scenario);
    SaveRecordingOptions options;
    options.overwrite = true;
    options.commandLine = commandLine;
    options.progress = [&](std::int64_t done, std::int64_t all) {
        return progress(static_cast<double>(done) / static_cast<double>(std::max<std::int64_t>(1, all)));
    };
    return saveRecording(path, run.branches(), scenarios, run.record(0).course().descriptions, options);
}

}  // namespace mrose::gui
