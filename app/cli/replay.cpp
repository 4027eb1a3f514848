#include "recording/replay.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "recording/recording.h"
#include "scenario/scenario_file.h"
#include "scenarios.h"
#include "world/plain_seconds.h"

namespace mrose::cli {
namespace {

struct ReplayCommandFlags {
    std::string recording;
    bool decide = false;
    PluginFlags plugins;
};

/// Where a plug-in that a recording names may be: as it was named, seen from the current folder; the same seen from the
/// recording's; beside the recording.
std::vector<std::filesystem::path> placesOf(const std::filesystem::path& named,
                                            const std::filesystem::path& recording) {
    const std::filesystem::path folder = recording.parent_path();
    std::vector<std::filesystem::path> places{named};
    for (const std::filesystem::path& place : {folder / named, folder / named.filename()})
        if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
    return places;
}

/// Loads plug-ins from wherever they are found.
PluginLoader findingLoader(const ReplayCommandFlags& flags) {
    return [recording = flags.recording, load = pluginLoader(flags.plugins)](
               const std::string& path, const std::string& options) -> Expected<std::shared_ptr<const Controller>> {
        std::error_code ignored;
        std::string looked;
        for (const std::filesystem::path& place : placesOf(path, recording)) {
            if (std::filesystem::exists(place, ignored)) return load(place.string(), options);
            looked += (looked.empty() ? "" : ", nor ") +
                      std::filesystem::absolute(place, ignored).lexically_normal().string();
        }
        return fail("", "the plug-in is neither " + looked);
    };
}

/// The recorded scenario, from the texts in the recording. Without its controllers their stand-ins keep the states'
/// layout.
Expected<Scenario> recordedScenario(const Recording& recording, const ReplayCommandFlags& flags) {
    KeptDescriptions source(recording.header.descriptions.texts);
    auto loaded = loadScenario(recording.header.descriptions.scenario, source,
                               {flags.decide ? findingLoader(flags) : PluginLoader()});
    if (!loaded) return tl::unexpected(loaded.error());
    if (!flags.decide)
        for (std::size_t i = 0; i < loaded->parts.controllers.size() && i < recording.header.controllers.size(); ++i)
            loaded->parts.controllers[i] = std::make_shared<const RecordedController>(recording.header.controllers[i]);
    watchPlugins(loaded->parts);
    return Scenario(std::move(loaded->parts));
}

/// "; kept: 900 ticks, 18.0 s"
std::string keptText(const Recording& recording) {
    std::int64_t ticks = 0;
    for (const Branch& branch : recording.branches) ticks += branch.timeline.last() - branch.timeline.first();
    return "; kept: " + std::to_string(ticks) + (ticks == 1 ? " tick, " : " ticks, ") +
           plainSeconds(ticks * recording.header.tickLength) + " s";
}

void sayNotes(const Recording& recording, const std::string& file) {
    for (const std::string& sentence : recording.damage) report({file, 0, 0, "", sentence + keptText(recording)});
    for (const std::string& sentence : differences(recording.header.origin, thisOrigin()))
        std::fprintf(stderr, "mrose: %s\n", sentence.c_str());
}

int replayRecording(const ReplayCommandFlags& flags, const CommonFlags& common) {
    const auto recording = openRecording(flags.recording);
    if (!recording) return report(recording.error(), flags.recording);
    sayNotes(*recording, flags.recording);
    const auto scenario = recordedScenario(*recording, flags);
    if (!scenario) return report(scenario.error(), flags.recording);
    watchInterrupts();
    ProgressLine line(common.quiet);
    ReplayOptions options;
    options.decide = flags.decide;
    std::int64_t shown = -1;
    options.progress = [&](std::int64_t done, std::int64_t all) {
        const std::int64_t percent = 100 * done / std::max<std::int64_t>(1, all);
        if (line.terminal() && percent != shown) line.show(std::to_string(shown = percent) + " % replayed");
        return !wasInterrupted();
    };
    const auto replayed = replay(recording->branches, *scenario, options);
    if (!replayed) return report(replayed.error(), flags.recording);
    const auto& difference = replayed->difference;
    if (common.json) {
        nlohmann::json json{{"ticks", replayed->ticks},
                            {"branches", recording->branches.size()},
                            {"same", !difference && !replayed->cancelled},
                            {"damage", recording->damage}};
        if (difference)
            json["difference"] = {
                {"branch", difference->branch}, {"tick", difference->tick}, {"what", difference->what}};
        std::puts(json.dump(2).c_str());
    } else if (difference) {
        const double time = toSeconds(difference->tick * recording->header.tickLength);
        std::printf("differs first at tick %lld (%.3f s)%s: %s\n", static_cast<long long>(difference->tick), time,
                    difference->branch == 0 ? "" : (" of branch " + std::to_string(difference->branch)).c_str(),
                    difference->what.c_str());
    } else if (!replayed->cancelled) {
        std::printf("%lld ticks replayed, %s: the same to the last bit\n", static_cast<long long>(replayed->ticks),
                    flags.decide ? "the controllers deciding again" : "the recorded decisions in force");
    }
    return replayed->cancelled ? interrupted : difference ? failure : success;
}

}  // namespace

Subcommand addReplay(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<ReplayCommandFlags>();
    CLI::App* sub = addSubcommand(app, common, "replay", "Run a recording again and compare every tick",
                                  "  mrose replay game.mcap\n"
                                  "  mrose replay game.mcap --decide\n"
                                  "The recording holds all that the run was made from but logs and plug-ins.");
    sub->add_option("RECORDING", flags->recording, "Recording (MCAP)")->required();
    sub->add_flag("--decide", flags->decide, "Let the controllers decide again, and compare what they remember too");
    addPluginFlags(*sub, flags->plugins);
    return {sub, [flags, &common] { return replayRecording(*flags, common); }};
}

}  // namespace mrose::cli
