#pragma once

#include <QObject>
#include <vector>

#include "debug/plotted_value.h"

namespace mrose {
class FieldView;
}

namespace mrose::gui {

class Overlay;
class PlotPanel;
class Session;

/// Plots a robot's commands, its velocity and the real one's: of the selected one, otherwise of the one that the
/// overlay speaks of. They change with the robot, until the user removes one of them.
class SpeedPlot final : public QObject {
    Q_OBJECT

public:
    SpeedPlot(const Session& session, const FieldView& field, PlotPanel& plots, const Overlay& overlay);

    /// Plots them, or no longer; false: nothing real is known beside that robot.
    bool toggle();

private:
    void follow();
    std::vector<ValueKey> speeds() const;

    const Session& session_;
    const FieldView& field_;
    PlotPanel& plots_;
    const Overlay& overlay_;
    std::vector<ValueKey> own_;  ///< plotted by this
    bool changing_ = false;      ///< what is plotted changes by this alone
};

}  // namespace mrose::gui
