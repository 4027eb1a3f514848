#include "reality/overlay_marks.h"

#include <algorithm>
#include <numbers>

#include "reality/overlay.h"
#include "widgets/qt_text.h"
#include "widgets/real_readout.h"

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
    add(0, bound.at(0));
    for (std::size_t k = 0; k < bound.bySteps.size(); ++k)
        add(static_cast<double>(k + 1) * toSeconds(WindowOptions{}.step) / toSeconds(tickLength), bound.bySteps[k]);
    return {position, heading};
}

}  // namespace

OverlayMarks marksOf(const Overlay& overlay, const Scene& scene) {
    OverlayMarks marks;
    if (!overlay.rollouts().shown()) return marks;
    const std::vector<ComparedRobot>& robots = overlay.rollouts().world().robots();
    for (std::size_t i = 0; i < robots.size(); ++i) {
        const RolloutRow* const row = overlay.rollouts().rowOf(*overlay.rollouts().shown(), i);
        if (row == nullptr || !row->divergence) continue;
        const Divergence& divergence = *row->divergence;
        const QString name = qtText(robots[i].name);
        marks.noted.push_back({{scene.ticksOf(divergence.time), TimelineMark::Kind::divergence, 0, 0},
                               name + ", " + errorText({divergence.position, divergence.heading}),
                               name,
                               overlay.rollouts().robot() != i});
    }
    std::stable_sort(marks.noted.begin(), marks.noted.end(),
                     [](const Noted& a, const Noted& b) { return a.mark.tick < b.mark.tick; });
    if (const RolloutRow* const row = overlay.rollouts().shownRow()) {
        marks.levels = levelsOf(row->bound, scene.tickLength);
        if (row->divergence) marks.instant = scene.ticksOf(row->divergence->time);
    }
    return marks;
}

}  // namespace mrose::gui
