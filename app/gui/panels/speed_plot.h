#pragma once

#include <QObject>
#include <vector>

#include "debug/plotted_value.h"

namespace mrose::gui {

class MainWindow;

/// Plots a robot's commands, its velocity and the real one's: of the selected one, otherwise of the one that the
/// overlay speaks of. They change with the robot, until the user removes one of them.
class SpeedPlot final : public QObject {
    Q_OBJECT

public:
    explicit SpeedPlot(MainWindow& window);

    /// Plots them, or no longer; false: nothing real is known beside that robot.
    bool toggle();

private:
    void follow();

    MainWindow& window_;
    std::vector<ValueKey> own_;  ///< plotted by this
    bool changing_ = false;      ///< what is plotted changes by this alone
};

}  // namespace mrose::gui
