#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <vector>

#include "assessment/reality.h"
#include "frame/window_frame.h"
#include "widgets/timeline_bar.h"

namespace mrose {
class FieldView;
}

namespace mrose::gui {

class Overlay;
class PlotPanel;

/// Fills the timeline: what is known of the shown branch and its events, where reality is unknown, where the overlay's
/// robots leave it. The latter is said to the plots, too.
class RunTimeline final : public QObject {
    Q_OBJECT

public:
    RunTimeline(const WindowFrame& frame, TimelineBar& timeline, FieldView& field, PlotPanel& plots, Overlay& overlay);

    /// Marks that the run does not know of, for as long as it is open.
    void note(std::vector<TimelineBar::Content::Noted> marks);

private:
    void refresh();
    void markDivergences();
    /// Of the selected robot, or of all of them.
    void addUnknown(TimelineBar::Content& content, const Shown& shown);

    const WindowFrame& frame_;
    TimelineBar& timeline_;
    FieldView& field_;
    PlotPanel& plots_;
    Overlay& overlay_;
    std::int64_t plannedEnd_ = 0;
    std::vector<TimelineBar::Content::Noted> noted_;
    // What was reported last, and for which robot: finding it reads the whole log.
    std::shared_ptr<const Reality> reality_;
    const Reality::Robot* robot_ = nullptr;
    std::vector<Reality::Robot::Stretch> unknown_;
};

}  // namespace mrose::gui
