#include "debug/run_recorder.h"

#include <algorithm>

#include "recording/save_recording.h"

namespace mrose {

Expected<RunRecorder> RunRecorder::begin(const std::filesystem::path& path, const TimeTravel& run,
                                         const std::string& commandLine, bool overwrite) {
    const BranchSetup& setup = run.branches().record(0).setup();
    const Timeline& timeline = run.branches()[0].timeline;
    auto start = Playback(*setup.scenario).reach(timeline, timeline.first());
    if (!start) return tl::unexpected(start.error());
    auto writer = RecordingWriter::create(path, *setup.scenario, start->state, setup.value, commandLine,
                                          {.overwrite = overwrite});
    if (!writer) return tl::unexpected(writer.error());
    RunRecorder recorder(path, std::move(*writer));
    recorder.branches_.emplace_back(run.branches().record(0).setupPointer(), std::move(*start));
    recorder.places_.emplace_back(0);
    return recorder;
}

Expected<void> RunRecorder::open(const TimeTravel& run, std::uint32_t branch) {
    if (opened(branch)) return {};
    const Branch& begun = run.branches()[branch];
    if (auto parent = open(run, begun.parent); !parent) return parent;
    const BranchSetupPointer& setup = run.branches().record(branch).setupPointer();
    auto start = Playback(*setup->scenario).reach(begun.timeline, begun.timeline.first());
    if (!start) return tl::unexpected(start.error());
    const std::uint32_t parent = *places_[begun.parent];
    places_.resize(std::max<std::size_t>(places_.size(), branch + 1));
    if (setup == run.branches().record(begun.parent).setupPointer())
        places_[branch] = writer_.beginBranch(parent, start->state, begun.name);
    else
        places_[branch] = writer_.beginBranch(parent, start->state, begun.name, *setup->scenario, setup->value);
    branches_.emplace_back(setup, std::move(*start));
    return {};
}

Expected<void> RunRecorder::writeTick(const Timeline& timeline, std::uint32_t place) {
    Written& written = branches_[place];
    if (auto done = written.playback.advance(timeline, written.at, trace_); !done) return done;
    writer_.add(written.at.state, trace_, place);
    return writer_.state();
}

/// A branch in which nothing has happened yet may still be taken back, and is written in the end.
Expected<bool> RunRecorder::follow(const TimeTravel& run, std::int64_t ticks) {
    for (std::uint32_t branch = 0; branch < run.branches().size(); ++branch) {
        const Timeline& timeline = run.branches()[branch].timeline;
        if (timeline.first() == timeline.last() || (run.hidden(branch) && !opened(branch))) continue;
        if (auto done = open(run, branch); !done) return tl::unexpected(done.error());
        const std::uint32_t place = *places_[branch];
        for (; branches_[place].at.state.tick < timeline.last(); --ticks) {
            if (ticks <= 0) return true;
            if (auto done = writeTick(timeline, place); !done) return tl::unexpected(done.error());
        }
    }
    if (!writer_.state()) return tl::unexpected(writer_.state().error());
    return false;
}

Expected<void> RunRecorder::flush() {
    writer_.flush();
    return writer_.state();
}

Expected<void> RunRecorder::finish(const TimeTravel& run) {
    for (;;) {
        const auto more = follow(run, 1000);
        if (!more) return tl::unexpected(more.error());
        if (!*more) break;
    }
    for (std::uint32_t branch = 0; branch < run.branches().size(); ++branch)
        if (!run.hidden(branch))
            if (auto done = open(run, branch); !done) return done;
    for (std::uint32_t place = 0; place < branches_.size(); ++place) writer_.keep(branches_[place].at.state, place);
    if (opened(run.branch())) writer_.keepShown({*places_[run.branch()], run.tick()});
    return writer_.close();
}

Expected<bool> saveRun(const std::filesystem::path& path, const TimeTravel& run, const std::string& commandLine,
                       const Progress& progress) {
    std::vector<Branch> branches;
    std::vector<std::shared_ptr<const Scenario>> scenarios;
    std::vector<std::uint32_t> places(run.branches().size());  // a parent comes before what departs from it
    for (std::uint32_t branch = 0; branch < run.branches().size(); ++branch) {
        if (run.hidden(branch)) continue;
        places[branch] = static_cast<std::uint32_t>(branches.size());
        branches.push_back(run.branches()[branch]);
        branches.back().parent = places[branches.back().parent];
        scenarios.push_back(run.branches().record(branch).setup().scenario);
    }
    SaveRecordingOptions options;
    options.overwrite = true;
    options.commandLine = commandLine;
    if (run.recordedBy()) options.origin = *run.recordedBy();  // its ticks are kept as they are
    options.shown = {places[run.branch()], run.tick()};
    options.progress = [&](std::int64_t done, std::int64_t all) {
        return mayGoOn(progress, static_cast<double>(done) / static_cast<double>(std::max<std::int64_t>(1, all)));
    };
    return saveRecording(path, branches, scenarios, run.branches().record(0).setup().value, options);
}

}  // namespace mrose
