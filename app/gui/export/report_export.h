#pragma once

#include <QString>

#include "io/error.h"
#include "workflow/divergence_request.h"
#include "workflow/log_comparison.h"
#include "workflow/log_evaluation.h"

namespace mrose::gui {

class MainWindow;

/// Writes the report that `mrose evaluate --report` writes, in the background; see exportInBackground(). Error: a
/// report is there already, without `overwrite`; the folder cannot be written.
Expected<void> exportReport(MainWindow& window, const LogEvaluationRequest& request, const QString& folder,
                            bool overwrite = false);
/// What `mrose compare` is asked for.
struct ComparisonReport {
    LogComparisonRequest what;
    DivergenceRequest divergence = {};
};
/// That of `mrose compare --report`.
Expected<void> exportComparison(MainWindow& window, const ComparisonReport& report, const QString& folder,
                                bool overwrite = false);

}  // namespace mrose::gui
