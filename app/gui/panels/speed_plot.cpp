#include "panels/speed_plot.h"

#include <algorithm>

#include "panels/plot_panel.h"
#include "reality/overlay.h"
#include "widgets/field_view.h"
#include "window/main_window.h"

namespace mrose::gui {
namespace {

std::vector<ValueKey> speedsOf(const MainWindow& window) {
    const Overlay& overlay = window.overlay();
    if (window.shown() == nullptr || !window.shown()->frame->reality) return {};
    const FieldFrame& frame = *window.shown()->frame;
    std::string robot;
    if (const auto asked = overlay.shownRobot()) robot = overlay.world()->world().robots()[*asked].name;
    if (const auto body = window.field().selected()) robot = frame.nameOf(*body);
    if (frame.reality->robotNamed(robot) == nullptr) return {};
    std::vector<ValueKey> keys;
    for (const char* const quantity : {"command_v", "v", "real_v", "command_w", "w", "real_w"})
        keys.push_back({quantity, robot});
    return keys;
}

}  // namespace

SpeedPlot::SpeedPlot(MainWindow& window) : QObject(&window), window_(window) {
    connect(&window.overlay(), &Overlay::changed, this, &SpeedPlot::follow);
    connect(&window, &MainWindow::updated, this, &SpeedPlot::follow);
    connect(&window.field(), &FieldView::bodySelected, this, &SpeedPlot::follow);
    connect(&window.plots(), &PlotPanel::changed, this, [this] {
        const std::vector<ValueKey>& keys = window_.plots().keys();
        const auto isThere = [&](const ValueKey& key) {
            return std::find(keys.begin(), keys.end(), key) != keys.end();
        };
        if (!changing_ && !std::all_of(own_.begin(), own_.end(), isThere)) own_.clear();
    });
}

bool SpeedPlot::toggle() {
    follow();
    const std::vector<ValueKey> speeds = speedsOf(window_);
    if (speeds.empty()) return false;
    own_.clear();
    window_.plots().toggleAll(speeds);
    if (window_.plots().plotted().count(speeds.front()) > 0) own_ = speeds;
    return true;
}

/// Until the robot of another rollout is known, nothing changes.
void SpeedPlot::follow() {
    if (own_.empty()) return;
    std::vector<ValueKey> speeds = speedsOf(window_);
    if (speeds.empty() || speeds == own_) return;
    changing_ = true;
    window_.plots().replace(own_, speeds);
    changing_ = false;
    own_ = std::move(speeds);
}

}  // namespace mrose::gui
