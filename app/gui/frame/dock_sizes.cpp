#include "frame/dock_sizes.h"

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QMainWindow>

namespace mrose::gui {

DockSizes::DockSizes(QMainWindow& window) : QObject(&window), window_(window) {
    window.installEventFilter(this);
    for (QDockWidget* dock : window.findChildren<QDockWidget*>()) dock->installEventFilter(this);
}

/// The layout has done its work before a filter sees that the window has another size.
bool DockSizes::eventFilter(QObject* watched, QEvent* event) {
    const bool resized = event->type() == QEvent::Resize;
    auto* dock = qobject_cast<QDockWidget*>(watched);
    if (watched == &window_ && resized) restore();
    if (dock != nullptr && (resized || event->type() == QEvent::Show)) note(*dock);
    return false;
}

/// What becomes smaller is squeezed, unless the mouse does it; and so is at first what is no larger than it must be.
void DockSizes::note(QDockWidget& dock) {
    if (dock.isFloating() || !dock.isVisible()) return;
    const QSize now = dock.size(), least = dock.minimumSizeHint(), usual = dock.sizeHint();
    const auto [known, first] = wanted_.try_emplace(&dock, now);
    QSize& wanted = known->second;
    if (QApplication::mouseButtons().testFlag(Qt::LeftButton)) wanted = now;
    wanted = wanted.expandedTo(now);
    if (!first) return;
    if (now.width() <= least.width()) wanted.setWidth(usual.width());
    if (now.height() <= least.height()) wanted.setHeight(usual.height());
}

void DockSizes::restore() {
    QList<QDockWidget*> beside, below;
    QList<int> widths, heights;
    for (const auto& [dock, size] : wanted_) {
        if (dock->isFloating() || !dock->isVisible()) continue;
        const Qt::DockWidgetArea area = window_.dockWidgetArea(dock);
        if (area == Qt::LeftDockWidgetArea || area == Qt::RightDockWidgetArea) {
            beside << dock;
            widths << size.width();
        } else {
            below << dock;
            heights << size.height();
        }
    }
    window_.resizeDocks(beside, widths, Qt::Horizontal);
    window_.resizeDocks(below, heights, Qt::Vertical);
}

}  // namespace mrose::gui
