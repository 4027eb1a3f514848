#include "recording/replay.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "recording/recording.h"
#include "scenarios.h"
#include "workflow/opening.h"
#include "world/seconds_text.h"

namespace mrose::cli {
namespace {

struct ReplayCommandFlags {
    std::string recording;
    bool decide = false;
    PluginFlags plugins;
};

/// The scenarios of all branches; those of the same value are one.
Expected<std::vector<std::shared_ptr<const Scenario>>> recordedScenarios(const Recording& recording,
                                                                         const ReplayCommandFlags& flags) {
    std::map<ScenarioValuePointer, std::shared_ptr<const Scenario>> loaded;
    std::vector<std::shared_ptr<const Scenario>> scenarios;
    for (std::uint32_t i = 0; i < recording.branches.size(); ++i) {
        std::shared_ptr<const Scenario>& scenario = loaded[recording.branches[i].value];
        if (!scenario) {
            auto parts = recordedScenario(
                recording, i,
                flags.decide ? findingLoader(flags.recording, pluginLoader(flags.plugins)) : PluginLoader());
            if (!parts) return tl::unexpected(parts.error());
            watchPlugins(*parts);
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

void sayNotes(const Recording& recording, const std::string& file) {
    for (const std::string& sentence : recording.damage) report({file, 0, 0, "", sentence + keptText(recording)});
    for (const std::string& sentence : differences(recording.header.origin, thisOrigin()))
        std::fprintf(stderr, "mrose: %s\n", sentence.c_str());
}

int replayRecording(const ReplayCommandFlags& flags, const CommonFlags& common) {
    const auto recording = openRecording(flags.recording);
    if (!recording) return report(recording.error(), flags.recording);
    sayNotes(*recording, flags.recording);
    const auto scenarios = recordedScenarios(*recording, flags);
    if (!scenarios) return report(scenarios.error(), flags.recording);
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
    const auto replayed = replay(recording->branches, *scenarios, options);
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
        const double time = toSeconds(difference->tick * recording->layouts[difference->branch].tickLength);
        std::printf("differs first at tick %lld (%.3f s)%s: %s\n", static_cast<long long>(difference->tick), time,
                    difference->branch == 0 ? "" : (" of branch " + std::to_string(difference->branch)).c_str(),
                    difference->what.c_str());
    } else if (!replayed->cancelled) {
        std::printf("%lld ticks replayed, %s: the same to the last bit\n", static_cast<long long>(replayed->ticks),
                    flags.decide ? "the controllers deciding again" : "the recorded decisions in force");
    }
    if (replayed->cancelled) return interruptedStatus();
    return difference ? failure : success;
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
