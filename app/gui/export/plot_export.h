#pragma once

#include <QString>

#include "export/exports.h"
#include "io/error.h"

namespace mrose::gui {

/// What is plotted, over the stretch of time that the plots show, for paper: light, with a legend. PNG, SVG or PDF, as
/// the extension says. Waits in the background for numbers that are being computed; see exportInBackground().
Expected<void> exportPlots(const Exports& exports, const QString& path);

/// All numbers of what is plotted, a row for each tick that is known of the shown branch or the one beside: time_s,
/// tick, then a column for each curve with its unit, exactly as they were computed. Cells of what is unknown are empty.
/// Where curves go on ahead of what is simulated, so do the rows, one for each instant at which a number was compared:
/// "ahead" is 1 there. What the curves are held against, as it is drawn: "bound (UNIT)", and "leaves the real
/// trajectory" (of a synthetic log: "logged"), 1 at that instant.
Expected<void> exportValues(const Exports& exports, const QString& path);

}  // namespace mrose::gui
