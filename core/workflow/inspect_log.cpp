#include "workflow/inspect_log.h"

#include "workflow/log_files.h"

namespace mrose {

Expected<LogInspection> inspectLog(const InspectRequest& request, const Progress& progress) {
    const auto log = openLog(request.log, request.robots);
    if (!log) return tl::unexpected(log.error());
    if (!mayGoOn(progress, 0)) return fail(log->source, "was not inspected: cancelled");
    LogInspection found = inspect(*log);
    if (!mayGoOn(progress, 1)) return fail(log->source, "was not inspected: cancelled");
    return found;
}

}  // namespace mrose
