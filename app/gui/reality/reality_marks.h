#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assessment/reality.h"
#include "debug/shown.h"
#include "widgets/timeline_bar.h"

namespace mrose::gui {

/// Instants between which it is not known where a real robot is, from the run's start on; without a robot those in
/// which it is not known of any. What has not been measured at the end is unknown to the end.
std::vector<Reality::Robot::Stretch> unknownTruth(const Reality& reality, const Reality::Robot* robot);

/// What reality adds to the timeline: where it is unknown, and the marks of those who compare it with the run.
class RealityMarks {
public:
    void setNoted(std::vector<TimelineBar::Content::Noted> noted) { noted_ = std::move(noted); }
    const std::vector<TimelineBar::Content::Noted>& noted() const { return noted_; }
    /// Of the selected robot, where there is one.
    void addTo(TimelineBar::Content& content, const Shown& shown, std::optional<std::size_t> selected);

private:
    std::vector<TimelineBar::Content::Noted> noted_;
    // What was reported last, and for which robot: finding it reads the whole log.
    std::shared_ptr<const Reality> reality_;
    const Reality::Robot* robot_ = nullptr;
    std::vector<Reality::Robot::Stretch> unknown_;
};

}  // namespace mrose::gui
