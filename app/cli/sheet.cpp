#include <cstdio>

#include "common.h"
#include "report/evaluation_files.h"
#include "workflow/resources.h"
#include "workflow/sim_to_real_sheet.h"

namespace mrose::cli {
namespace {

int runSheet(SheetRequest request, const CommonFlags& common) {
    request.overwrite = common.overwrite;
    watchInterrupts();
    ProgressLine line(common.quiet);
    const auto sheet = writeSheet(request, [&](double share) {
        if (line.terminal()) line.show("judging: " + std::to_string(static_cast<int>(100 * share)) + " %");
        return !wasInterrupted();
    });
    line.clear();
    if (!sheet && wasInterrupted()) return reportInterrupted();
    if (!sheet) return report(sheet.error());
    if (common.json)
        std::puts(resultsJson(sheet->evaluation, sheet->context).c_str());
    else if (!common.quiet)
        std::printf("%s: one page on %s\n", request.output.c_str(),
                    counted(sheet->evaluation.log.windows.size(), "window").c_str());
    return success;
}

}  // namespace

Subcommand addSheet(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<SheetRequest>();
    request->command = commandLine();
    CLI::App* sub = addSubcommand(
        app, common, "sheet", "One page of a robot and its log: how true, how certain, where not to trust, what next",
        "  mrose train mine.csv --hold-out 0.2 -o mine.net\n"
        "  mrose sheet mine.net --log mine.csv --held-out -o sheet.html\n"
        "  mrose sheet create.net --log MRCLAM_Dataset7 --robots 1,2 -o sheet.html");
    addOverwrite(*sub, common);
    sub->add_option("NET", request->network, "Network file of a motion, or the name of one that ships")
        ->required()
        ->transform(placeOfNetwork);
    sub->add_option("--log", request->log, "The log to compare with")->required();
    sub->add_option("--robots", request->robots, "Only these robots, by name: 1,2")->delimiter(',');
    sub->add_flag("--held-out", request->heldOut,
                  "Only the part of the log that mrose train --hold-out kept from learning");
    sub->add_option("-o,--output", request->output, "The page to write")->required()->check(someName());
    return {sub, [request, &common] { return runSheet(*request, common); }};
}

}  // namespace mrose::cli
