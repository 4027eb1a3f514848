#include <cstdio>
#include <exception>

#include <tbb/global_control.h>

#include "common.h"
#include "learning/instruction_set.h"
#include "plugins.h"
#include "workflow/version.h"

namespace {

using namespace mrose::cli;

std::string versionText() {
    std::string text =
        "mrose " MROSE_VERSION "\n" MROSE_BUILD_TYPE " build, " MROSE_COMPILER "; instruction sets here:";
    for (const mrose::InstructionSet set : mrose::availableInstructionSets()) text += std::string(" ") + name(set);
    return text;
}

int runProgram(int argc, char** argv) {
    CLI::App app(
        "Learns how a team's robots move and what they perceive from their logs, says how far that can be trusted, and "
        "simulates them.",
        "mrose");
    app.set_version_flag("--version", versionText());
    app.require_subcommand(0, 1);  // none is refused below: an unknown one is then named
    app.failure_message([](const CLI::App*, const CLI::Error& error) {
        return std::string("mrose: ") + error.what() + " (mrose --help, or mrose SUBCOMMAND --help, has more)\n";
    });
    CommonFlags flags;
    const Subcommand subcommands[] = {addInspect(app, flags),      addTrain(app, flags),    addEvaluate(app, flags),
                                      addPredict(app, flags),      addAdvise(app, flags),   addSheet(app, flags),
                                      addIdentifyBall(app, flags), addGenerate(app, flags), addShapes(app, flags),
                                      addRun(app, flags),          addReplay(app, flags),   addBatch(app, flags),
                                      addExperiment(app, flags),   addLearn(app, flags),    addTune(app, flags),
                                      addValidate(app, flags),     addCompare(app, flags),  addPluginHost(app)};
    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? success : usage;
    }
    const auto threads = flags.threads > 0
                             ? static_cast<std::size_t>(flags.threads)
                             : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    for (const auto& [subcommand, run] : subcommands)
        if (subcommand->parsed()) return run();
    return usage;
}

}  // namespace

int main(int argc, char** argv) {
    rememberCommandLine(argc, argv);
    try {
        return runProgram(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mrose: %s\n", error.what());
        return failure;
    }
}
