#include "reality/overlay_marks.h"

#include <algorithm>
#include <numbers>

#include "panels/plot_panel.h"
#include "reality/overlay.h"
#include "widgets/qt_text.h"
#include "widgets/real_robots.h"
#include "window/main_window.h"

namespace mrose::gui {
namespace {

using Noted = TimelineBar::Content::Noted;

/// In the units of the errors that are plotted.
std::vector<PlotLevel> levelsOf(const DivergenceBound& bound, Nanoseconds tickLength) {
    PlotLevel position{"cm", {}}, heading{QString::fromUtf8("\u00b0"), {}};
    const auto add = [&](double tick, const DivergenceBound::At& at) {
        position.points.append({tick, 100 * at.position});
        heading.points.append({tick, at.heading * 180 / std::numbers::pi});
    };
    if (bound.bySteps.empty()) add(0, bound.constant);
    for (std::size_t k = 0; k < bound.bySteps.size(); ++k)
        add(static_cast<double>(k + 1) * toSeconds(WindowOptions{}.step) / toSeconds(tickLength), bound.bySteps[k]);
    return {position, heading};
}

}  // namespace

void markDivergences(MainWindow& window, const Overlay& overlay) {
    std::vector<Noted> noted;
    std::vector<PlotLevel> levels;
    std::optional<std::int64_t> instant;
    if (overlay.shownRollout() && window.shown() != nullptr) {
        const Scene& scene = window.shown()->frame->scene();
        const std::vector<ComparedRobot>& robots = overlay.world()->world().robots();
        for (std::size_t i = 0; i < robots.size(); ++i) {
            const OverlayRow* const row = overlay.rowOf(*overlay.shownRollout(), i);
            if (row == nullptr || !row->divergence) continue;
            const Divergence& divergence = *row->divergence;
            noted.push_back({{scene.ticksOf(divergence.time), TimelineMark::Kind::divergence, 0, 0},
                             qtText(robots[i].name) + ", " + errorText({divergence.position, divergence.heading}),
                             qtText(robots[i].name),
                             overlay.shownRobot() != i});
        }
        std::stable_sort(noted.begin(), noted.end(),
                         [](const Noted& a, const Noted& b) { return a.mark.tick < b.mark.tick; });
        if (const OverlayRow* const row = overlay.shownRow()) {
            levels = levelsOf(row->bound, scene.tickLength);
            if (row->divergence) instant = scene.ticksOf(row->divergence->time);
        }
    }
    window.note(std::move(noted));
    window.plots().setReferences(std::move(levels), instant);
}

}  // namespace mrose::gui
