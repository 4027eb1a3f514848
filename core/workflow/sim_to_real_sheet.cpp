#include "workflow/sim_to_real_sheet.h"

#include "io/file.h"
#include "report/sheet.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"

namespace mrose {

Expected<NetworkEvaluation> writeSheet(const SheetRequest& request, const Progress& progress) {
    if (auto can = checkOutput(request.output, {request.network, placeOfLog(request.log)}, request.overwrite); !can)
        return tl::unexpected(can.error());
    EvaluateRequest asked{.network = request.network, .log = request.log, .robots = request.robots};
    asked.heldOut = request.heldOut;
    asked.withFloor = false;
    asked.withAdvice = true;
    asked.command = request.command;
    auto evaluated = evaluateNetwork(asked, progress);
    if (!evaluated) return evaluated;
    if (auto written = writeFileAtomically(request.output, sheetHtml(evaluated->evaluation, evaluated->context));
        !written)
        return tl::unexpected(written.error());
    return evaluated;
}

}  // namespace mrose
