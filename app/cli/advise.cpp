#include <cstdio>

#include "common.h"
#include "io/format.h"
#include "workflow/advise_drive.h"
#include "workflow/resources.h"

namespace mrose::cli {
namespace {

void printJson(const Advice& advice, const AdviseRequest& request) {
    const AdvisedDrive& drive = advice.drive;
    nlohmann::json json{{"duration_s", drive.duration},
                        {"manoeuvres", drive.manoeuvres.size()},
                        {"rest_s", advice.rest},
                        {"limits",
                         {{"forward_mps", advice.limits.mostV},
                          {"backward_mps", 0 - advice.limits.leastV},
                          {"turn_radps", advice.limits.mostW}}},
                        {"needs_m", {drive.most.x - drive.least.x, drive.most.y - drive.least.y}},
                        {"far_before", drive.farBefore},
                        {"far_after", drive.farAfter},
                        {"notices", advice.notices}};
    if (!request.output.empty()) json["script"] = request.output;
    for (const AdviceReason& reason : advice.reasons)
        json["reasons"].push_back({{"what", reason.what},
                                   {"seconds", reason.seconds},
                                   {"unfamiliar", drive.familiarKnown ? nlohmann::json(reason.unfamiliar) : nullptr},
                                   {"disagreement", drive.membersKnown ? nlohmann::json(reason.doubt) : nullptr}});
    std::puts(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

void print(const Advice& advice, const AdviseRequest& request) {
    const AdvisedDrive& drive = advice.drive;
    if (request.output.empty()) {  // whose comments say the rest
        std::fputs(advice.script.c_str(), stdout);
        return;
    }
    std::printf("%s: %s of %.0f s in all\nlimits: %s\n", request.output.c_str(),
                counted(drive.manoeuvres.size(), "manoeuvre").c_str(), drive.duration,
                limitsText(advice.limits).c_str());
    std::printf("needs %s; leave room, for that is a guess where the network has not learned\n",
                spaceText(drive).c_str());
    for (const std::string& part : partTexts(advice)) std::printf("  %s\n", part.c_str());
    std::printf(
        "a random drive within the limits is %.2f from the nearest that is known, and %.2f once this one is (1: the "
        "standard deviation of commands spread evenly over the limits)\n",
        drive.farBefore, drive.farAfter);
    for (const std::string& notice : advice.notices) std::printf("Note: %s\n", notice.c_str());
}

int runAdvise(AdviseRequest request, const CommonFlags& common) {
    request.overwrite = common.overwrite;
    request.seed = common.seed;
    watchInterrupts();
    ProgressLine line(common.quiet);
    const auto advice = advise(request, [&](double share) {
        if (line.terminal()) line.show("choosing: " + std::to_string(static_cast<int>(100 * share)) + " %");
        return !wasInterrupted();
    });
    line.clear();
    if (!advice && wasInterrupted()) return reportInterrupted();
    if (!advice) return report(advice.error());
    if (common.json)
        printJson(*advice, request);
    else if (!common.quiet)
        print(*advice, request);
    return success;
}

}  // namespace

Subcommand addAdvise(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<AdviseRequest>();
    CLI::App* sub = addSubcommand(
        app, common, "advise", "Say what to drive next, so that a network learns most from it",
        "  mrose advise mine.net --log logs -o next.csv\n"
        "  mrose advise mine.net --log logs --forward 0.4 --backward 0.2 --turn 1.7 --radius 2 -o next.toml\n"
        "A velocity script: .csv has the columns of a log's commands (t,v_cmd,w_cmd), .toml a robot's controller for "
        "a scenario. It\nbegins and ends at rest. Manoeuvres are chosen one after the other, each for what neither the "
        "logs nor those before\nit have, and for how much the networks of an ensemble disagree there. How far the "
        "robot "
        "comes is by the network's own\nrollout: watch it, and stop it where it goes elsewhere.");
    addSeed(*sub, common);
    addOverwrite(*sub, common);
    sub->add_option("NET", request->network, "Network file, or the name of one that ships")
        ->required()
        ->transform(placeOfNetwork);
    sub->add_option("--log", request->logs, "Logs that it was learned from")->required();
    sub->add_option("--robots", request->robots, "These robots of the logs only, by name: 1,2")->delimiter(',');
    sub->add_option("-o,--output", request->output, "The script to write, .csv or .toml; without it, it is printed")
        ->check(someName());
    sub->add_option("--forward", request->forward, "Fastest forward in m/s; default: the logs'")
        ->check(numberRange(0.0, 100.0));
    sub->add_option("--backward", request->backward, "Fastest backward in m/s, 0: never; default: the logs'")
        ->check(numberRange(0.0, 100.0));
    sub->add_option("--turn", request->turn, "Fastest turn in rad/s, either way; default: the logs'")
        ->check(numberRange(0.0, 100.0));
    sub->add_option("--duration", request->duration, "Length in s")
        ->check(numberRange(10.0, 3600.0))
        ->capture_default_str();
    sub->add_option("--radius", request->radius, "Stay within so many m of where it begins")
        ->check(numberRange(0.2, 1000.0))
        ->capture_default_str();
    return {sub, [request, &common] { return runAdvise(*request, common); }};
}

}  // namespace mrose::cli
