#include "workflow/identify_ball.h"

#include <cstdio>

#include "common.h"
#include "io/format.h"
#include "report/ball_text.h"

namespace mrose::cli {
namespace {

void printBall(const BallIdentification& found, const IdentifyBallRequest& request) {
    std::printf("%s%s: %s of %s, which moved for %s s; %s; tracker noise %s mm\n", request.log.c_str(),
                found.synthetic ? " (synthetic)" : "", counted(found.positions, "position").c_str(),
                counted(found.tracks, "tracked ball").c_str(), fixed(found.moved, 1).c_str(),
                counted(found.kicks, "kick").c_str(), fixed(1000 * found.noise, 1).c_str());
    TextTable table({found.synthetic ? "synthetic" : "", "value", "± 1 s.e.", "unit", "events", "key"});
    std::string missing;
    bool any = false;
    for (const BallLine& line : ballLines(found)) {
        const BallEstimate& of = *line.estimate;
        any = any || of.identified;
        if (of.identified)
            table.add({line.name, fixed(of.value, 4), fixed(of.error, 4), line.unit, std::to_string(of.events),
                       line.key.empty() ? "-" : line.key});
        else
            missing += line.name + ": not identified: " + of.reason + '\n';
    }
    std::printf("%s%s", any ? table.text().c_str() : "", missing.c_str());
    for (const std::string& note : ballNotes(found)) std::printf("Note: %s\n", note.c_str());
    if (!request.output.empty()) std::printf("%s: written\n", request.output.c_str());
}

int runIdentifyBall(IdentifyBallRequest request, const CommonFlags& common) {
    request.overwrite = common.overwrite;
    watchInterrupts();
    const auto found = identifyBall(request, goesOn);
    if (!found && wasInterrupted()) return reportInterrupted();
    if (!found) return report(found.error());
    if (common.json)
        std::puts(ballJson(*found, request.log).c_str());
    else if (!common.quiet)
        printBall(*found, request);
    return success;
}

}  // namespace

Subcommand addIdentifyBall(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<IdentifyBallRequest>();
    CLI::App* sub =
        addSubcommand(app, common, "identify-ball",
                      "How a ball rolls, slides and bounces, from the tracked ball of a log, with standard errors",
                      "  mrose identify-ball mylogs --environment my_hall.toml -o ball_found.toml\n"
                      "  mrose generate --set kicks -o kicks && mrose identify-ball kicks\n"
                      "The file has the keys that environment, scenario and robot files take. Without --environment "
                      "only touches count "
                      "after which the ball comes back nearly the way it came.");
    addOverwrite(*sub, common);
    sub->add_option("LOG", request->log, "CSV file or folder of CSV files with the columns ball_x and ball_y")
        ->required();
    sub->add_option("--robots", request->robots, "Only these robots, by name: 1,2")->delimiter(',');
    sub->add_option("--environment", request->environment, "An environment file: where walls and obstacles are");
    sub->add_option("-o,--output", request->output, "A file for the keys")->check(someName());
    return {sub, [request, &common] { return runIdentifyBall(*request, common); }};
}

}  // namespace mrose::cli
