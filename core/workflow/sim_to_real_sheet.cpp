#include "workflow/sim_to_real_sheet.h"

#include "io/file.h"
#include "io/format.h"
#include "workflow/advise_drive.h"
#include "workflow/evaluate_network.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

/// What to drive next, beside this log; what keeps it from being said is said.
Expected<void> addAdvice(const SheetRequest& request, const Progress& progress, Sheet& sheet) {
    const auto advice = advise({.network = request.network, .logs = {request.log}, .robots = request.robots}, progress);
    if (!mayGoOn(progress, 1)) return fail(request.log, "the sheet was ended before its end");
    if (!advice) {
        sheet.withoutAdvice = advice.error().message();
        return {};
    }
    SheetAdvice& said = sheet.advice.emplace();
    said.drive =
        fixed(advice->drive.duration, 0) + " s, in " + spaceText(advice->drive) + ", " + limitsText(advice->limits);
    for (const AdviceReason& reason : advice->reasons) said.reasons.push_back(reasonText(*advice, reason));
    said.command = "mrose advise " + request.network + " --log " + request.log + " -o next.csv";
    return {};
}

}  // namespace

Expected<Sheet> writeSheet(const SheetRequest& request, const Progress& progress) {
    if (auto can = checkOutput(request.output, {request.network, placeOfLog(request.log)}, request.overwrite); !can)
        return tl::unexpected(can.error());
    const auto part = [&](double from, double to) -> Progress {
        return [&progress, from, to](double share) { return mayGoOn(progress, from + (to - from) * share); };
    };
    EvaluateRequest asked{.network = request.network, .log = request.log, .robots = request.robots};
    asked.heldOut = request.heldOut;
    asked.withFloor = false;
    asked.command = request.command;
    auto evaluated = evaluateNetwork(asked, part(0, 0.6));
    if (!evaluated) return tl::unexpected(evaluated.error());
    Sheet sheet{std::move(evaluated->evaluation),
                std::move(evaluated->context),
                std::move(evaluated->unfamiliar),
                std::nullopt,
                {}};
    if (auto advised = addAdvice(request, part(0.6, 1), sheet); !advised) return tl::unexpected(advised.error());
    if (auto written = writeFileAtomically(request.output, sheetHtml(sheet)); !written)
        return tl::unexpected(written.error());
    return sheet;
}

}  // namespace mrose
