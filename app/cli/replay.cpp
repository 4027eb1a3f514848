#include <algorithm>
#include <cstdio>

#include "common.h"
#include "plugins.h"
#include "report/program_json.h"
#include "workflow/replay_recording.h"

namespace mrose::cli {
namespace {

void print(const ReplayedRecording& replayed, bool decided) {
    const ReplayReport& result = replayed.report;
    if (const auto& difference = result.difference) {
        const double time = toSeconds(difference->tick * replayed.recording.layouts[difference->branch].tickLength);
        std::printf("differs first at tick %lld (%.3f s)%s: %s\n", static_cast<long long>(difference->tick), time,
                    difference->branch == 0 ? "" : (" of branch " + std::to_string(difference->branch)).c_str(),
                    difference->what.c_str());
    } else if (!result.cancelled) {
        std::printf("%lld ticks replayed, %s: the same to the last bit\n", static_cast<long long>(result.ticks),
                    decided ? "the controllers deciding again" : "the recorded decisions in force");
    }
}

int runReplay(const ReplayRequest& request, const CommonFlags& common) {
    ProgressLine line(common.quiet);
    std::int64_t shown = -1;
    ReplayWatch watch;
    watch.opened = [](const std::vector<Error>& notes) {
        for (const Error& note : notes) report(note);
        watchInterrupts();
    };
    watch.progress = [&](std::int64_t done, std::int64_t all) {
        const std::int64_t percent = 100 * done / std::max<std::int64_t>(1, all);
        if (line.terminal() && percent != shown) line.show(std::to_string(shown = percent) + " % replayed");
        return !wasInterrupted();
    };
    const auto replayed = replayRecording(request, watch);
    line.clear();
    if (!replayed) return report(replayed.error());
    if (common.json)
        std::puts(replayJson(replayed->recording, replayed->report).c_str());
    else
        print(*replayed, request.decide);
    if (replayed->report.cancelled) return interruptedStatus();
    return replayed->report.difference ? failure : success;
}

}  // namespace

Subcommand addReplay(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<ReplayRequest>();
    CLI::App* sub = addSubcommand(app, common, "replay", "Run a recording again and compare every tick",
                                  "  mrose replay game.mcap\n"
                                  "  mrose replay game.mcap --decide\n"
                                  "The recording holds all that the run was made from but logs and plug-ins.");
    sub->add_option("RECORDING", request->recording, "Recording (MCAP)")->required();
    sub->add_flag("--decide", request->decide, "Let the controllers decide again, and compare what they remember too");
    addPluginFlags(*sub, request->plugins);
    return {sub, [request, &common] { return runReplay(*request, common); }};
}

}  // namespace mrose::cli
