#include <cstdio>

#include "io/format.h"
#include "report/program_json.h"
#include "workflow/learn_task.h"

namespace mrose::cli {
namespace {

std::string decimals(double value, int digits) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

/// What it comes to when a variant is chosen by what was learned.
void printChoice(const TaskData& data, const TaskJudgement& judgement) {
    const VariantChoice& choice = *judgement.predictors.front().choice;
    TextTable table(
        {data.target + " of the variants", "mean", "sum of |d| / sum", "chosen in", "gain by choosing", "95 %"});
    for (const VariantChoice::Variant& variant : choice.variants)
        table.add({variant.name, decimals(variant.mean, 3), fixed(100 * variant.share, 2) + " %",
                   std::to_string(variant.chosen), decimals(variant.gain, 3),
                   decimals(variant.gainInterval.low, 3) + " to " + decimals(variant.gainInterval.high, 3)});
    for (const TaskJudgement::Predictor& predictor : judgement.predictors)
        if (predictor.choice)
            table.add({"chosen by " + predictor.name, decimals(predictor.choice->mean, 3), "", "", "", ""});
    if (choice.oracle) table.add({"best of each trial", decimals(choice.oracle->mean, 3), "", "", "", ""});
    std::fputs(table.text().c_str(), stdout);
    std::printf("%s every variant alone by more than chance (95 %%); best alone, in the trials learned from: %s\n",
                choice.beatsAll() ? "better than" : "not better than", choice.variants[choice.best].name.c_str());
    if (choice.oracle)
        std::printf(
            "%.0f %% (95 %%: %.0f to %.0f) of the way from there to the best of each trial; the same as that "
            "in %.0f %% of the trials\n",
            100 * choice.oracle->closed, 100 * choice.oracle->closedInterval.low,
            100 * choice.oracle->closedInterval.high, 100 * choice.oracle->agrees);
}

/// "; 3 left out, not ended by `until`"; by variant "; 2 trials left out (runs not ended by `until`: 3)".
std::string leftOut(const TaskData& data) {
    std::string all;
    if (data.variants.empty()) {
        for (const auto& [count, why] :
             {std::pair(data.unfinished, "not ended by `until`"), std::pair(data.faulty, "ended by a fault"),
              std::pair(data.unknown, "as the target or an input is not a number")})
            if (count > 0) all += "; " + std::to_string(count) + " left out, " + why;
    } else if (data.unknown > 0) {
        all = "; " + counted(static_cast<std::size_t>(data.unknown), "trial") + " left out";
        std::string runs;
        if (data.unfinished > 0) runs = "runs not ended by `until`: " + std::to_string(data.unfinished);
        if (data.faulty > 0) runs += (runs.empty() ? "runs " : ", ") + ("with faults: " + std::to_string(data.faulty));
        all += " (" + (runs.empty() ? "the target or an input is not a number" : runs) + ')';
    }
    return all;
}

void print(const LearnedTask& learned, const LearnRequest& request) {
    const TaskData& data = learned.data;
    const bool choosing = !data.variants.empty();
    std::printf("%s, %zu of them held out%s%s\n", counted(data.rows(), choosing ? "trial" : "row").c_str(),
                learned.judgement.heldOut.rows(), choosing ? "" : " by trials", leftOut(data).c_str());
    TextTable table({data.target + ", held out", "sum of |d| / sum", "95 %", "mean |d|", "rms", "bias"});
    for (const TaskJudgement::Predictor& predictor : learned.judgement.predictors) {
        const TaskScore& score = predictor.score;
        table.add({predictor.name, decimals(100 * score.share, 2) + " %",
                   decimals(100 * score.shareInterval.low, 2) + "-" + decimals(100 * score.shareInterval.high, 2),
                   decimals(score.absolute, 3), decimals(score.rootMeanSquare, 3), decimals(score.bias, 3)});
    }
    std::fputs(table.text().c_str(), stdout);
    if (choosing) printChoice(data, learned.judgement);
    std::printf("%s written\n", request.output.c_str());
    if (!request.report.empty()) std::printf("%s/report.html written\n", request.report.c_str());
}

int runIt(const LearnRequest& request, const CommonFlags& common) {
    watchInterrupts();
    LearningDisplay display(common.quiet, "learning");
    const auto learned = learnTask(request, [&](double share) { return display(share) && !wasInterrupted(); });
    display.end();
    if (wasInterrupted()) return reportInterrupted();
    if (!learned) return report(learned.error());
    if (common.json)
        std::puts(learnedTaskJson(learned->data, learned->judgement, request.output).c_str());
    else
        print(*learned, request);
    return success;
}

}  // namespace

Subcommand addLearn(CLI::App& app, CommonFlags& common) {
    struct Flags {
        LearnRequest request;
        std::string family = "network";
    };
    auto flags = std::make_shared<Flags>();
    LearnRequest& request = flags->request;
    request.command = commandLine();
    CLI::App* sub = addSubcommand(
        app, common, "learn", "Learn a measure of an experiment from its features",
        "  mrose learn episodes --target time_s --log -o time.net\n"
        "  mrose learn episodes --target time_s --beside by_speed --families -o time.net\n"
        "  mrose learn problems --target time_s --by-variant --unfinished --report page -o method.net\n"
        "Every fifth trial is held out whole, and the figures are of these. A plug-in names the file in `mappings`\n"
        "and asks it by the names of the features.");
    addSeed(*sub, common);
    addThreads(*sub, common);
    addOverwrite(*sub, common);
    sub->add_option("RESULTS", request.results, "The experiment's folder, or its results.csv")
        ->required()
        ->check(someName());
    sub->add_option("--target", request.question.target, "The measure that is learned")->required();
    sub->add_option("--inputs", request.question.inputs,
                    "Features, draws as draw.NAME, or swept, with commas between them; otherwise all features")
        ->delimiter(',');
    sub->add_option("--beside", request.question.beside,
                    "Features that are guesses of the target: judged beside it, and no inputs")
        ->delimiter(',');
    sub->add_flag("--by-variant", request.question.byVariant,
                  "Learn what each variant comes to, one output for each, and judge choosing by it");
    sub->add_flag("--greatest", request.question.greatest, "By variant: the greatest target is best, not the least")
        ->needs("--by-variant");
    sub->get_option("--by-variant")->excludes("--beside");
    sub->add_flag("--log", request.learning.logarithmic, "Learn the target's logarithm: relative errors count");
    sub->add_flag("--unfinished", request.question.unfinished, "Learn from runs, too, that `until` did not end");
    sub->add_option("--family", flags->family, "What is learned: network, table, trees or neighbours")
        ->check(CLI::IsMember(std::vector<std::string>(regressorFamilyNames.begin(), regressorFamilyNames.end())))
        ->capture_default_str();
    sub->add_flag("--families", request.families, "Learn the other families, too, and judge them beside it");
    sub->add_option("--hidden", request.learning.hidden, "Units of each network's hidden layer")
        ->check(CLI::Range(1, 512))
        ->capture_default_str();
    sub->add_option("--members", request.learning.members, "Networks whose mean is learned, each without another part")
        ->check(CLI::Range(2, 8))
        ->capture_default_str();
    sub->add_option("--report", request.report, "A folder for a page about it, with what it says of what is held out")
        ->check(someName());
    sub->add_option("-o,--output", request.output, "The network file")->required()->check(someName());
    sub->callback([flags, &common] {
        const auto at = std::ranges::find(regressorFamilyNames, flags->family);
        flags->request.learning.family = static_cast<RegressorFamily>(at - regressorFamilyNames.begin());
        flags->request.learning.seed = common.seed;
        flags->request.overwrite = common.overwrite;
    });
    return {sub, [flags, &common] { return runIt(flags->request, common); }};
}

}  // namespace mrose::cli
