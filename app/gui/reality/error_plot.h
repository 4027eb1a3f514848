#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assessment/compare.h"
#include "frame/window_frame.h"
#include "panels/plot_panel.h"
#include "session/job_queue.h"
#include "simulation/motion_bands.h"

class QDockWidget;

namespace mrose {
class FieldView;
}

namespace mrose::gui {

class FieldBands;
class Overlay;

/// Position and heading errors of a robot that really drove, of the run first and then of each model.
std::vector<ValueKey> errorKeysOf(const Reality& reality, const std::string& robot);

/// Plots the errors of the shown rollout of a log, the whole of it at once: of the selected robot, otherwise of the one
/// that is farthest off. They change with rollout, robot and models, until the user removes one of them. Plots that the
/// user closed are not opened again by themselves.
class ErrorPlot final : public QObject {
    Q_OBJECT

public:
    ErrorPlot(const WindowFrame& frame, const FieldView& field, PlotPanel& plots, QDockWidget& dock, Overlay& overlay,
              FieldBands& bands);

    void setOn(bool on);  ///< of the log that is open
    /// Shows the plots' dock, unless it was closed.
    void showDock();
    void settle();  ///< the shown rollout and where robots may be are computed and shown; for scripts and tests

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void follow();
    void lookAtRollout();
    std::optional<std::size_t> robot() const;
    void plot();
    PlotPanel::Foresight foresight(std::optional<std::size_t> robot) const;

    const WindowFrame& frame_;
    const FieldView& field_;
    PlotPanel& plots_;
    QDockWidget& dock_;
    Overlay& overlay_;
    FieldBands& bands_;
    bool on_ = true;
    bool changing_ = false;                      ///< what is plotted changes by this alone
    const void* world_ = nullptr;                ///< the log that is open
    std::uint64_t run_ = 0;                      ///< in which the rollout is shown
    std::vector<ValueKey> own_;                  ///< plotted by this
    std::shared_ptr<const Comparison> rollout_;  ///< of the shown rollout alone; null: not yet
    /// What was plotted last.
    struct Plotted {
        std::shared_ptr<const Comparison> rollout;
        std::shared_ptr<const Reality> reality;
        std::optional<std::size_t> robot;
        bool compared = false;  ///< the shown branch is what `rollout` describes
        bool on = false;
        std::shared_ptr<const MotionBands> bands = {};  ///< of that branch
        bool operator==(const Plotted&) const = default;
    };
    std::optional<Plotted> plotted_;
    JobQueue computing_;
};

}  // namespace mrose::gui
