#pragma once

#include <optional>
#include <vector>

#include "widgets/plot_view.h"
#include "widgets/timeline_bar.h"

namespace mrose::gui {

class Overlay;

/// Where the shown rollout's robots leave the real ones, for the timeline; and for plots the bound of the robot that is
/// asked about, in the units of plotted errors, with the instant at which it leaves.
struct OverlayMarks {
    std::vector<TimelineBar::Content::Noted> noted;
    std::vector<PlotLevel> levels;
    std::optional<std::int64_t> instant;
};
OverlayMarks marksOf(const Overlay& overlay, const Scene& scene);

}  // namespace mrose::gui
