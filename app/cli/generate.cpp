#include <cstdio>

#include "common.h"
#include "workflow/generate_logs.h"

namespace mrose::cli {
namespace {

/// Shows how far driving is.
class DrivingDisplay {
public:
    explicit DrivingDisplay(bool quiet) : line_(quiet), shown_(line_.terminal() ? -1 : 0) {}

    bool operator()(double share) {
        const int percent = static_cast<int>(100 * share);
        const bool worth = line_.terminal() ? percent > shown_ : percent >= shown_ + 25 && percent < 100;
        if (worth) line_.show("driving: " + std::to_string(shown_ = percent) + " %");
        return !wasInterrupted();
    }
    void clear() { line_.clear(); }

private:
    ProgressLine line_;
    int shown_;  ///< %
};

void print(const std::vector<GeneratedLog>& logs, const CommonFlags& common) {
    nlohmann::json json{{"synthetic", true}, {"seed", common.seed}, {"files", nlohmann::json::array()}};
    for (const GeneratedLog& log : logs) {
        const std::string path = log.file.string();
        if (!common.json && !common.quiet)
            std::printf("%s: synthetic, %zu trajector%s, %.0f s\n", path.c_str(), log.trajectories,
                        log.trajectories == 1 ? "y" : "ies", log.seconds);
        json["files"].push_back({{"file", path},
                                 {"pattern", log.pattern},
                                 {"trajectories", log.trajectories},
                                 {"repeats", log.repeats},
                                 {"seconds", log.seconds}});
    }
    if (common.json) std::puts(json.dump(2).c_str());
}

int runGenerate(GenerateRequest request, const CommonFlags& common) {
    request.seed = common.seed;
    request.overwrite = common.overwrite;
    watchInterrupts();
    DrivingDisplay display(common.quiet);
    const auto logs = generateLogs(request, std::ref(display));
    display.clear();
    if (!logs && wasInterrupted()) return reportInterrupted();
    if (!logs) return report(logs.error());
    print(*logs, common);
    return success;
}

std::vector<std::string> setNames() {
    std::vector<std::string> names;
    for (const SyntheticSet& set : syntheticSets()) names.emplace_back(set.name);
    return names;
}

std::vector<std::string> patternNames() {
    std::vector<std::string> names;
    for (int i = 0; i < patternCount; ++i) names.emplace_back(name(DrivePattern(i)));
    return names;
}

std::string setsText() {
    std::string text;
    for (const SyntheticSet& set : syntheticSets())
        text.append("  ").append(set.name).append(": ").append(set.purpose).append("\n");
    return text;
}

}  // namespace

Subcommand addGenerate(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<GenerateRequest>();
    CLI::App* sub = addSubcommand(
        app, common, "generate", "Write synthetic logs, driven by the reference robot (no real robot drove them)",
        "  mrose generate --set training -o training\n"
        "  mrose generate --set held-out --seed 2 -o held-out\n"
        "  mrose generate --pattern ellipse --repeats 10 -o ellipse\n"
        "  mrose generate --set training --sensors -o sensors\n"
        "Sets:\n" +
            setsText() +
            "The files are CSV logs, one for each drive pattern, and say that they are synthetic. "
            "The folder is made if need be.");
    addSeed(*sub, common);
    addOverwrite(*sub, common);
    sub->add_option("-o,--output", request->folder, "The folder to write to")->required()->check(someName());
    sub->add_option("--set", request->set, "What to drive: " + CLI::detail::join(setNames(), ", "))
        ->check(CLI::IsMember(setNames()));
    sub->add_option("--pattern", request->pattern, "One drive pattern only: " + CLI::detail::join(patternNames(), ", "))
        ->check(CLI::IsMember(patternNames()));
    sub->add_option("--trajectories", request->trajectories, "Different trajectories in each file")
        ->check(CLI::Range(1, 100'000));
    sub->add_option("--duration", request->duration,
                    "Length of a trajectory in s; the jink and the ellipse take as long as they take")
        ->check(numberRange(5.0, 36'000.0));
    sub->add_option("--repeats", request->repeats, "Runs of each trajectory's commands")->check(CLI::Range(1, 1000));
    sub->add_flag("--sensors", request->sensors,
                  "Also what sensors of the robot report: its own localisation (\"localisation\") and a camera that "
                  "sees landmarks (\"camera\")");
    return {sub, [request, &common] { return runGenerate(*request, common); }};
}

}  // namespace mrose::cli
