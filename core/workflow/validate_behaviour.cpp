#include "workflow/validate_behaviour.h"

#include "experiment/results_table.h"
#include "io/format.h"
#include "report/validation_report.h"
#include "scenario/description_library.h"
#include "workflow/resources.h"
#include "workflow/version.h"

namespace mrose {

Expected<ValidatedBehaviour> validateBehaviour(const ValidateRequest& request, const ExperimentWatch& watch) {
    DiskDescriptions source = openDescriptions();
    constexpr std::string_view folders[] = {"resources/experiments"};
    const auto file = DescriptionLibrary(source).file(request.file, folders);
    if (!file) return tl::unexpected(file.error());
    auto validation = readValidation(*file, source);
    if (!validation) return tl::unexpected(validation.error());
    Experiment& experiment = validation->experiment;
    if (request.trials && *request.trials > experiment.trials)
        return fail("",
                    "is more than the " + counted(static_cast<std::size_t>(experiment.trials), "trial") + " that " +
                        request.file + " has; expected fewer, which its `trials` says to be unused",
                    0, "--trials");
    if (request.trials) experiment.trials = *request.trials;
    ExperimentRequest runs{request.file, request.folder};
    runs.trials = experiment.trials;
    runs.plugins = request.plugins;
    ExperimentWatch checked = watch;
    checked.fits = [&](const RunKey& key, const RowOutcome& outcome) {
        return checkOutcome(*validation, key, outcome);
    };
    auto summary = runExperiment(runs, checked);
    if (!summary) return tl::unexpected(summary.error());
    ValidatedBehaviour validated{std::move(*validation), std::move(*summary), {}};
    if (!validated.summary.complete) return validated;
    const auto results = readResultsTable(request.folder);
    if (!results) return tl::unexpected(results.error());
    auto result = validationResult(validated.validation, *results);
    if (!result) return tl::unexpected(result.error());
    ValidationContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = request.commandLine;
    context.window = "mrose-gui";
    context.folder = request.folder;
    if (request.seconds) context.seconds = request.seconds();
    context.resumed = validated.summary.resumed;
    if (const auto written = writeValidationReport(validated.validation, *result, *results, context, request.folder);
        !written)
        return tl::unexpected(written.error());
    validated.result = std::move(*result);
    return validated;
}

}  // namespace mrose
