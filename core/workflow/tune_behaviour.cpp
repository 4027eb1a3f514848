#include "workflow/tune_behaviour.h"

#include "experiment/trial.h"
#include "io/file.h"
#include "io/format.h"
#include "io/shell_quoted.h"
#include "io/value_bytes.h"
#include "recording/origin.h"
#include "report/tuning_report.h"
#include "scenario/description_library.h"
#include "workflow/resources.h"
#include "workflow/version.h"

namespace mrose {
namespace {

std::string programText() { return std::string("mrose ") + MROSE_VERSION + ' ' + thisOrigin().commit; }

/// What repeats a run, but for the candidate, trial and seed.
std::string repeatedBy(const std::string& program, const std::string& experiment) {
    return program + ' ' + shellQuoted(experiment);
}

/// How many evaluations there are is no part of it: more of them may be added.
BatchIdentity identityOfTuning(const Tuning& tuning) {
    const std::string of(contentOf);
    BatchIdentity identity{{"mrose", programText()}};
    identity["tuning"] = tuning.name;
    identity[of + "the tuning"] = hexadecimal(hashOf(tuning.content.without("evaluations")));
    identity[of + "the experiment"] = hexadecimal(hashOf(tuning.experimentFile->content.without("trials")));
    for (const Value::File& file : tuning.experiment.scenario.files())
        identity[of + file->name] = hexadecimal(hashOf(file->content));
    for (const Value::File& file : tuning.experiment.settings)
        identity[of + file->name] = hexadecimal(hashOf(file->content));
    return identity;
}

constexpr const char* tuningFiles[] = {"settings.toml", "candidates.csv", "report.html"};

/// In a folder where nothing was tuned yet they are somebody else's.
Expected<void> checkTuningFiles(const std::filesystem::path& folder) {
    std::error_code ignored;
    if (std::filesystem::exists(folder / "batch.txt", ignored)) return {};
    for (const char* const name : tuningFiles)
        if (std::filesystem::exists(folder / name, ignored))
            return fail((folder / name).string(), "is there already, and of no tuning; expected an empty folder");
    return {};
}

Expected<void> writeFiles(const Tuning& tuning, const TuningSummary& summary, const TuneRequest& request) {
    ReportContext context;
    context.program = std::string("mrose ") + MROSE_VERSION;
    context.commandLine = request.command;
    const TuningEvidence evidence = evidenceOf(summary.result);
    if (summary.result.best == 0)
        context.notices.push_back("Nothing better than what is now was found.");
    else if (evidence.change.high >= 0)
        context.notices.push_back("The interval of the change holds 0: these trials do not show a gain.");
    if (summary.unfamiliar)
        if (std::string note = summary.unfamiliar->note(); !note.empty()) context.notices.push_back(std::move(note));
    const std::filesystem::path folder = request.folder;
    const NamedFile files[] = {
        {folder / tuningFiles[0],
         settingsText(tuning, summary.result, {{"command", request.command}, {"mrose", programText()}})},
        {folder / tuningFiles[1], candidatesText(tuning, summary.result)},
        {folder / tuningFiles[2], tuningReport(tuning, summary, context)}};
    return writeFilesAtomically(files);
}

}  // namespace

Expected<TunedBehaviour> tuneBehaviour(const TuneRequest& request, const TuneWatch& watch) {
    constexpr std::string_view folders[] = {"resources/experiments"};
    DiskDescriptions source = openDescriptions();
    const auto file = DescriptionLibrary(source).file(request.file, folders);
    if (!file) return tl::unexpected(file.error());
    TuningOptions options;
    // What is in their files is part of what the rows depend on: reading the tuning loads them.
    HashingLoader plugins(request.plugins);
    options.loading.plugins = plugins.loader();
    options.loaded = request.plugins.loaded;
    auto tuning = readTuning(*file, source, options.loading);  // plug-ins, too, say what of a range does not fit
    if (!tuning) return tl::unexpected(tuning.error());
    if (const auto free = checkTuningFiles(request.folder); !free) return tl::unexpected(free.error());
    if (watch.opened) watch.opened(*tuning);
    {
        TrialExpressions expressions(tuning->experiment);
        if (const auto first = TrialMaker(tuning->experiment, expressions, options.loading).make(1); !first)
            return tl::unexpected(first.error());
    }
    options.command = repeatedBy("mrose run", tuning->experimentCalled);
    options.window = repeatedBy("mrose-gui", tuning->experimentCalled);
    options.identity = identityOfTuning(*tuning);
    for (const auto& [path, hash] : plugins.hashes()) options.identity[std::string(contentOf) + path] = hash;
    options.begins = watch.runBegins;
    options.progress = watch.progress;
    options.goesOn = watch.goesOn;
    auto summary = runTuning(*tuning, options, request.folder);
    if (!summary) return tl::unexpected(summary.error());
    if (summary->result.complete)
        if (const auto written = writeFiles(*tuning, *summary, request); !written)
            return tl::unexpected(written.error());
    return TunedBehaviour{std::move(*tuning), std::move(*summary)};
}

}  // namespace mrose
