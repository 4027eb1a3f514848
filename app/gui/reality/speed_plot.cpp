#include "reality/speed_plot.h"

#include <algorithm>

#include "panels/plot_panel.h"
#include "reality/overlay.h"
#include "session/session.h"
#include "widgets/field_view.h"

namespace mrose::gui {

std::vector<ValueKey> SpeedPlot::speeds() const {
    if (session_.current() == nullptr || !session_.current()->frame->reality) return {};
    const FieldFrame& frame = *session_.current()->frame;
    std::string robot;
    if (const auto asked = overlay_.rollouts().robot()) robot = overlay_.rollouts().world().robots()[*asked].name;
    if (const auto body = field_.selected()) robot = frame.nameOf(*body);
    if (frame.reality->robotNamed(robot) == nullptr) return {};
    std::vector<ValueKey> keys;
    for (const char* const quantity : {"v", "command_v", "real_v", "w", "command_w", "real_w"})
        keys.push_back({quantity, robot});
    return keys;
}

SpeedPlot::SpeedPlot(const Session& session, const FieldView& field, PlotPanel& plots, const Overlay& overlay)
    : QObject(&plots), session_(session), field_(field), plots_(plots), overlay_(overlay) {
    connect(&overlay, &Overlay::changed, this, &SpeedPlot::follow);
    connect(&session, &Session::shown, this, &SpeedPlot::follow);
    connect(&field, &FieldView::bodySelected, this, &SpeedPlot::follow);
    connect(&plots, &PlotPanel::changed, this, [this] {
        const std::vector<ValueKey>& keys = plots_.keys();
        const auto isThere = [&](const ValueKey& key) {
            return std::find(keys.begin(), keys.end(), key) != keys.end();
        };
        if (!changing_ && !std::all_of(own_.begin(), own_.end(), isThere)) own_.clear();
    });
}

bool SpeedPlot::toggle() {
    follow();
    const std::vector<ValueKey> speeds = this->speeds();
    if (speeds.empty()) return false;
    own_.clear();
    plots_.toggleAll(speeds);
    if (plots_.plotted().count(speeds.front()) > 0) own_ = speeds;
    return true;
}

/// Until the robot of another rollout is known, nothing changes.
void SpeedPlot::follow() {
    if (own_.empty()) return;
    std::vector<ValueKey> speeds = this->speeds();
    if (speeds.empty() || speeds == own_) return;
    changing_ = true;
    plots_.replace(own_, speeds);
    changing_ = false;
    own_ = std::move(speeds);
}

}  // namespace mrose::gui
