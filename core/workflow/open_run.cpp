#include "workflow/open_run.h"

#include <filesystem>

#include "io/caught.h"
#include "io/file_lock.h"
#include "recording/playback.h"
#include "recording/recording.h"
#include "scenario/scenario_file.h"
#include "workflow/file_kind.h"
#include "workflow/open_scenario.h"
#include "workflow/plugins.h"
#include "workflow/resources.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// Larger texts are no descriptions.
constexpr std::uintmax_t mostDescriptionBytes = std::uintmax_t{256} << 20;

/// Descriptions on disk, read so that it can be ended between two files and never waits for a pipe.
class WatchedDescriptions final : public DescriptionSource {
public:
    WatchedDescriptions(DiskDescriptions disk, const OpenProgress& progress)
        : disk_(std::move(disk)), progress_(progress) {}

    Expected<std::optional<std::string>> text(const std::string& name) override {
        const std::string path = disk_.shown(name);
        if (!progress_.goesOn()) return fail(path, "was not opened: cancelled");
        std::error_code ignored;
        const auto status = std::filesystem::status(path, ignored);
        if (std::filesystem::is_directory(status)) return fail(path, "is a folder; expected a file");
        if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
            return fail(path, "is no regular file; expected a description");
        if (std::filesystem::is_regular_file(status) &&
            std::filesystem::file_size(path, ignored) > mostDescriptionBytes)
            return fail(path, "is larger than any description");
        progress_.reads(path);
        return disk_.text(name);
    }
    Expected<std::optional<ExcerptContent>> excerpt(const LogExcerpt& excerpt) override {
        if (!progress_.goesOn()) return fail(excerpt.log, "was not opened: cancelled");
        progress_.reads(excerpt.log);
        return disk_.excerpt(excerpt);
    }
    std::string shown(const std::string& name) const override { return disk_.shown(name); }
    const std::map<std::string, std::string>& hashes() const { return disk_.hashes(); }

private:
    DiskDescriptions disk_;
    const OpenProgress& progress_;
};

/// Plug-ins run in processes of their own, so that one which hangs or crashes stops its robot and not the window.
PluginLoader isolating(const OpenRequest& request, const OpenProgress& progress) {
    return [&request, &progress](const std::string& path,
                                 const std::string& options) -> Expected<std::shared_ptr<const Controller>> {
        if (!progress.goesOn()) return fail(path, "was not opened: cancelled");
        progress.reads(path);
        return startPluginProcess(path, options, request.pluginLimit);
    };
}

Expected<OpenedRun> openToRun(const OpenRequest& request, const OpenProgress& progress) {
    WatchedDescriptions source(openDescriptions(request.log), progress);
    ScenarioRequest wanted{request.file};
    wanted.trial = request.trial;
    wanted.variant = request.variant;
    wanted.overrides = request.overrides;
    wanted.settings = request.settings;
    wanted.plugins.isolate = false;  // who loads it does that
    wanted.plugins.load = [load = isolating(request, progress)](const std::string& path, const std::string& options,
                                                                double) { return load(path, options); };
    auto opened = openScenario(wanted, source);
    if (!opened) return tl::unexpected(opened.error());
    auto& [loaded, plugins, scenario, notes, trial] = *opened;
    OpenedRun run{scenario->parts().name, request, nullptr, opened->initialState(request.seed), {}, {},
                  std::move(notes),       {}};
    const std::uint32_t number = trial ? trial->number : request.trial;
    if (number > 0) run.name += ", trial " + std::to_string(number);
    if (trial && !trial->variant.empty()) run.name += ", " + trial->variant;
    run.setup = std::make_shared<const BranchSetup>(
        BranchSetup{std::make_shared<const ScenarioValue>(std::move(loaded.value)), std::move(scenario)});
    run.files = std::move(plugins);
    for (const auto& [path, hash] : source.hashes()) run.files[path] = hash;
    return run;
}

/// What a plug-in once did can be looked at even where it cannot be loaded.
class AbsentPlugin final : public Controller {
public:
    Attention attention() const override { return Attention::ofItself(); }
    void decide(const Observation&, std::span<std::byte>, Decision&) const override {}
};

/// What a branch of a recording runs in. Robots whose controllers are not at hand, or need other memory than they did,
/// get stand-ins: they do as recorded, and decide nothing beyond that.
Expected<BranchSetupPointer> setupOf(const Recording& recording, std::uint32_t branch, const PluginLoader& load,
                                     std::vector<std::string>& notes) {
    const PluginLoader tolerant = [&](const std::string& path,
                                      const std::string& options) -> Expected<std::shared_ptr<const Controller>> {
        auto controller = load(path, options);
        if (controller) return controller;
        notes.push_back(controller.error().message() + "; its robots do as recorded and decide nothing new");
        return std::make_shared<const AbsentPlugin>();
    };
    auto parts = recordedScenario(recording, branch, tolerant);
    if (!parts) return tl::unexpected(parts.error());
    const std::vector<RecordingHeader::ControllerNeeds>& needs = recording.layouts[branch].controllers;
    if (parts->controllers.size() != needs.size())
        return fail("", "was recorded with " + std::to_string(needs.size()) + " controllers and describes " +
                            std::to_string(parts->controllers.size()) + " robots");
    for (std::size_t i = 0; i < needs.size(); ++i) {
        const Controller& controller = *parts->controllers[i];
        if (controller.memorySize() != needs[i].memorySize ||
            controller.commandsPerPeriod(parts->scene.modelOf(i).period()) != needs[i].commandsPerPeriod)
            parts->controllers[i] = std::make_shared<const RecordedController>(needs[i]);
    }
    auto scenario = std::make_shared<const Scenario>(std::move(*parts));
    return std::make_shared<const BranchSetup>(BranchSetup{recording.valueOf(branch), std::move(scenario)});
}

/// Branches of the same scenario share a setup.
Expected<std::vector<OpenedRun::Recorded>> branchesOf(const Recording& recording, const PluginLoader& load,
                                                      std::vector<std::string>& notes) {
    std::map<ScenarioValuePointer, BranchSetupPointer> setups;
    std::vector<OpenedRun::Recorded> branches;
    for (std::uint32_t i = 0; i < recording.branches.size(); ++i) {
        const Branch& branch = recording.branches[i];
        BranchSetupPointer& setup = setups[branch.value];
        if (!setup) {
            auto opened = setupOf(recording, i, load, notes);
            if (!opened) return tl::unexpected(opened.error());
            setup = std::move(*opened);
        }
        auto start = Playback(*setup->scenario).reach(branch.timeline, branch.timeline.first());
        if (!start) return tl::unexpected(start.error());
        branches.push_back({branch, setup, std::move(start->state)});
    }
    return branches;
}

std::string lengthText(const Recording& recording) {
    const Timeline& run = recording.branches.front().timeline;
    return plainSeconds((run.last() - run.first()) * recording.header.tickLength) + " s";
}

/// What is wrong with a file, and how far it is shown. One without an end may be as it should be, and grow.
std::vector<std::string> damageText(const std::string& file, const Recording& recording) {
    std::vector<std::string> sentences;
    for (const std::string& damage : recording.damage)
        sentences.push_back(file + ": " + damage + "; it is shown up to there: " + lengthText(recording));
    if (!recording.endless || recording.damage.size() > 1) return sentences;
    const std::optional<bool> written = isBeingWritten(file);
    if (!written.value_or(true)) return sentences;
    return {file + ": is still being written" + (written ? "" : ", or was cut off") +
            "; it is shown as far as it goes: " + lengthText(recording) + ". Reload (F5) reads on"};
}

Expected<OpenedRun> openRecorded(const OpenRequest& request, const OpenProgress& progress) {
    auto recording = openRecording(request.file);
    if (!recording) return tl::unexpected(recording.error());
    OpenedRun run;
    run.source = request;
    run.name = std::filesystem::path(request.file).filename().string();
    run.notes = damageText(request.file, *recording);
    for (std::string& sentence : differences(recording->header.origin, thisOrigin()))
        run.notes.push_back(std::move(sentence));
    if (request.trial > 0 || request.seed)
        run.notes.push_back(request.file + ": is a recording; trial and seed are those that it was made with");
    const PluginLoader load = findingLoader(request.file, isolating(request, progress));
    auto branches = branchesOf(*recording, load, run.notes);
    if (!branches) {
        branches.error().file = request.file + (branches.error().file.empty() ? "" : ": ") + branches.error().file;
        return tl::unexpected(branches.error());
    }
    run.branches = std::move(*branches);
    run.shown = recording->shown;
    run.origin = recording->header.origin;
    run.setup = run.branches.front().setup;
    run.start = run.branches.front().start;
    return run;
}

Expected<OpenedRun> openAny(const OpenRequest& request, const OpenProgress& progress) {
    std::error_code ignored;
    if (!std::filesystem::exists(request.file, ignored)) return openToRun(request, progress);  // it may ship
    const auto kind = fileKind(request.file);
    if (!kind) return tl::unexpected(kind.error());
    switch (*kind) {
        case FileKind::scenario:
            return openToRun(request, progress);
        case FileKind::recording:
            return openRecorded(request, progress);
        case FileKind::network:
            return fail(request.file, "is a network; open a scenario, select a robot, then open the network for it");
        case FileKind::log:
            return fail(request.file, "is a log; open it as a real log, or name it by --log");
        case FileKind::results:
            break;
    }
    return fail(request.file,
                "lists the runs of a batch, to choose from in the window on a display; without one, open a run by its "
                "scenario, trial and seed, which its column command names");
}

}  // namespace

Expected<OpenedRun> openRun(const OpenRequest& request, const OpenProgress& progress) {
    auto run = caught([&] { return openAny(request, progress); });
    if (!run && run.error().file.empty()) run.error().file = request.file;
    return run;
}

}  // namespace mrose
