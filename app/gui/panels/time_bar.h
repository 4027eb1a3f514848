#pragma once

#include <QToolBar>

#include "frame/window_frame.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace mrose {
struct Theme;
}

namespace mrose::gui {

/// The tool bar: the run's time, how fast it is played, and with which seed.
class TimeBar final : public QToolBar {
    Q_OBJECT

public:
    explicit TimeBar(const WindowFrame& frame);
    void addActions();  ///< once all of them are there

    void changeSpeed(int by);  ///< steps of the list of speeds
    /// Simulated seconds per second, one of the list from now on; 0: as fast as possible.
    void setSpeed(double speed);
    void setTheme(const Theme& theme);

private:
    void refresh();

    const WindowFrame& frame_;
    QComboBox* speed_;
    QLabel* factor_;
    QToolButton* seed_;
    QIcon play_, pause_;
};

}  // namespace mrose::gui
