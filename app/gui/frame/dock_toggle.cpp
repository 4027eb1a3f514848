#include "frame/dock_toggle.h"

#include <QAction>
#include <QDockWidget>
#include <memory>

namespace mrose::gui {

void raiseInsteadOfHiding(QDockWidget& dock) {
    const auto behind = std::make_shared<bool>(false);
    // Before the panel hears of it.
    QObject::connect(dock.toggleViewAction(), &QAction::toggled, &dock,
                     [&dock, behind](bool on) { *behind = !on && dock.visibleRegion().isEmpty(); });
    QObject::connect(dock.toggleViewAction(), &QAction::triggered, &dock, [&dock, behind](bool on) {
        const bool wasBehind = *behind;
        if (wasBehind) dock.show();
        if (on || wasBehind) dock.raise();
    });
}

}  // namespace mrose::gui
