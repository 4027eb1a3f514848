#include "experiment/batch.h"

#include <charconv>
#include <chrono>
#include <cstdio>

#include "scenarios.h"

namespace mrose::cli {
namespace {

struct BatchCommandFlags {
    RunFlags run;
    std::uint32_t trials = 100;
    std::string seeds, out;
};

/// "3..7", or "5" alone.
bool parseSeeds(const std::string& text, BatchOptions& options) {
    const auto number = [](const std::string& digits, std::uint64_t& value) {
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc() && end == digits.data() + digits.size();
    };
    const std::size_t dots = text.find("..");
    if (dots == std::string::npos) {
        if (!number(text, options.firstSeed)) return false;
        options.lastSeed = options.firstSeed;
        return true;
    }
    return number(text.substr(0, dots), options.firstSeed) && number(text.substr(dots + 2), options.lastSeed) &&
           options.firstSeed <= options.lastSeed && options.lastSeed - options.firstSeed < 1'000'000'000;
}

std::string progressText(std::int64_t done, std::int64_t all, double seconds, std::int64_t atBegin) {
    const double each = seconds / static_cast<double>(std::max<std::int64_t>(1, done - atBegin));
    return std::to_string(done) + " of " + std::to_string(all) + " runs, " +
           durationText(each * static_cast<double>(all - done)) + " left";
}

int runAll(const BatchCommandFlags& flags, const CommonFlags& common) {
    BatchOptions options;
    if (!parseSeeds(flags.seeds, options)) {
        std::fprintf(stderr, "mrose: --seeds: %s; expected one seed or a range: 1..20\n", flags.seeds.c_str());
        return usage;
    }
    const auto open = openScenario(flags.run.scenario, 0, flags.run.log, flags.run.plugins);
    if (!open) return report(open.error());
    const ScenarioParts& parts = open->scenario->parts();
    options.trials = flags.trials;
    options.duration = flags.run.duration ? fromSeconds(*flags.run.duration) : parts.duration;
    options.until = flags.run.until;
    options.command = "mrose run " + flags.run.scenario + (flags.run.log.empty() ? "" : " --log " + flags.run.log);
    options.scenarioHash = hashOf(open->loaded);
    watchInterrupts();
    ProgressLine line(common.quiet);
    const auto began = std::chrono::steady_clock::now();
    auto nextShown = began;
    std::int64_t atBegin = -1;
    options.progress = [&](std::int64_t done, std::int64_t all) {
        const auto now = std::chrono::steady_clock::now();
        if (atBegin < 0) atBegin = done - 1;
        if (now >= nextShown) {
            nextShown = now + (line.terminal() ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
            line.show(progressText(done, all, std::chrono::duration<double>(now - began).count(), atBegin));
        }
        return !wasInterrupted();
    };
    const auto summary = runBatch(parts, options, flags.out);
    if (!summary) return report(summary.error());
    if (common.json)
        std::puts(nlohmann::json{{"runs", summary->runs},
                                 {"resumed", summary->resumed},
                                 {"ended_by_condition", summary->ended},
                                 {"faulty", summary->faulty},
                                 {"complete", summary->complete},
                                 {"results", flags.out + "/results.csv"}}
                      .dump(2)
                      .c_str());
    else if (summary->complete)
        std::printf(
            "%lld runs%s; results in %s/results.csv\n", static_cast<long long>(summary->runs),
            summary->resumed > 0 ? (", " + std::to_string(summary->resumed) + " of them done before").c_str() : "",
            flags.out.c_str());
    else
        std::printf("interrupted; what is done is kept, and the same command goes on with the rest\n");
    return summary->complete ? success : interrupted;
}

}  // namespace

Subcommand addBatch(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<BatchCommandFlags>();
    CLI::App* sub = addSubcommand(
        app, common, "batch", "Run many trials of a scenario, one row of results each",
        "  mrose batch soccer.toml --trials 1000 -o games\n"
        "  mrose batch soccer.toml --trials 50 --seeds 1..20 --until 'goals[1] + goals[2] > 0' -o goals\n"
        "Every trial starts elsewhere, as [variation] in the scenario says; every seed has another noise. Killed or\n"
        "interrupted, the same command goes on where it was. Each row has the command that runs its trial alone.");
    addRunFlags(*sub, flags->run);
    flags->seeds = "1";
    sub->add_option("--trials", flags->trials, "How many starts")
        ->check(CLI::Range(1, 100'000'000))
        ->capture_default_str();
    sub->add_option("--seeds", flags->seeds, "Seeds of the noise, each with every start: 1..20")->capture_default_str();
    sub->add_option("-o,--output", flags->out, "The folder for results.csv")->required();
    return {sub, [flags, &common] { return runAll(*flags, common); }};
}

}  // namespace mrose::cli
