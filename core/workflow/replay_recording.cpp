#include "workflow/replay_recording.h"

#include <map>

#include "world/seconds_text.h"

namespace mrose {
namespace {

/// The scenarios of all branches; those of the same value are one.
Expected<std::vector<std::shared_ptr<const Scenario>>> recordedScenarios(const Recording& recording,
                                                                         const ReplayRequest& request) {
    const PluginLoader load =
        request.decide ? findingLoader(request.recording, pluginLoader(request.plugins)) : PluginLoader();
    std::map<ScenarioValuePointer, std::shared_ptr<const Scenario>> loaded;
    std::vector<std::shared_ptr<const Scenario>> scenarios;
    for (std::uint32_t i = 0; i < recording.branches.size(); ++i) {
        std::shared_ptr<const Scenario>& scenario = loaded[recording.branches[i].value];
        if (!scenario) {
            auto parts = recordedScenario(recording, i, load);
            if (!parts) return tl::unexpected(parts.error());
            if (request.plugins.loaded) request.plugins.loaded(*parts);
            scenario = std::make_shared<const Scenario>(std::move(*parts));
        }
        scenarios.push_back(scenario);
    }
    return scenarios;
}

/// "; kept: 900 ticks, 18.0 s"
std::string keptText(const Recording& recording) {
    std::int64_t ticks = 0;
    Nanoseconds time = 0;
    for (std::size_t i = 0; i < recording.branches.size(); ++i) {
        const Timeline& timeline = recording.branches[i].timeline;
        ticks += timeline.last() - timeline.first();
        time += (timeline.last() - timeline.first()) * recording.layouts[i].tickLength;
    }
    return "; kept: " + std::to_string(ticks) + (ticks == 1 ? " tick, " : " ticks, ") + plainSeconds(time) + " s";
}

std::vector<Error> notesOf(const Recording& recording, const std::string& file) {
    std::vector<Error> notes;
    for (const std::string& sentence : recording.damage)
        notes.push_back({file, 0, 0, "", sentence + keptText(recording)});
    for (std::string& sentence : differences(recording.header.origin, thisOrigin()))
        notes.push_back({"", 0, 0, "", std::move(sentence)});
    return notes;
}

}  // namespace

Expected<ReplayedRecording> replayRecording(const ReplayRequest& request, const ReplayWatch& watch) {
    auto recording = openRecording(request.recording);
    if (!recording) return atFile(recording.error(), request.recording);
    std::vector<Error> notes = notesOf(*recording, request.recording);
    if (watch.opened) watch.opened(notes);
    const auto scenarios = recordedScenarios(*recording, request);
    if (!scenarios) return atFile(scenarios.error(), request.recording);
    ReplayOptions options;
    options.decide = request.decide;
    options.progress = watch.progress;
    auto report = replay(recording->branches, *scenarios, options);
    if (!report) return atFile(report.error(), request.recording);
    return ReplayedRecording{std::move(*recording), std::move(*report), std::move(notes)};
}

}  // namespace mrose
