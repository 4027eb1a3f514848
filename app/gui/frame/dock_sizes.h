#pragma once

#include <QObject>
#include <QSize>
#include <map>

class QDockWidget;
class QMainWindow;

namespace mrose::gui {

/// Gives panels that a small window squeezed their room back when it grows: that which they had been given before, by
/// the user or by the layout.
class DockSizes final : public QObject {
    Q_OBJECT

public:
    explicit DockSizes(QMainWindow& window);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void note(QDockWidget& dock);
    void restore();

    QMainWindow& window_;
    std::map<QDockWidget*, QSize> wanted_;
};

}  // namespace mrose::gui
