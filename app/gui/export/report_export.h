#pragma once

#include <QString>

#include "export/exports.h"
#include "io/error.h"
#include "workflow/compare_log.h"
#include "workflow/evaluate_network.h"

namespace mrose::gui {

/// Writes the report that `mrose evaluate --report` writes, in the background; see exportInBackground(). Error: a
/// report is there already, without `overwrite`; the folder cannot be written.
Expected<void> exportReport(const Exports& exports, EvaluateRequest request, const QString& folder,
                            bool overwrite = false);
/// That of `mrose compare --report`.
Expected<void> exportComparison(const Exports& exports, CompareRequest request, const QString& folder,
                                bool overwrite = false);

}  // namespace mrose::gui
