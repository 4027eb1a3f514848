#pragma once

#include <QString>

#include "io/error.h"
#include "workflow/compare_log.h"
#include "workflow/evaluate_network.h"

namespace mrose::gui {

class MainWindow;

/// Writes the report that `mrose evaluate --report` writes, in the background; see exportInBackground(). Error: a
/// report is there already, without `overwrite`; the folder cannot be written.
Expected<void> exportReport(MainWindow& window, EvaluateRequest request, const QString& folder, bool overwrite = false);
/// That of `mrose compare --report`.
Expected<void> exportComparison(MainWindow& window, CompareRequest request, const QString& folder,
                                bool overwrite = false);

}  // namespace mrose::gui
