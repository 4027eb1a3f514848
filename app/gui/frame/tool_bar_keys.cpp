#include "frame/tool_bar_keys.h"

#include <QComboBox>
#include <QKeyEvent>
#include <QToolBar>
#include <QToolButton>

namespace mrose::gui {

ToolBarKeys::ToolBarKeys(QToolBar& bar) : QObject(&bar) {
    for (QAction* action : bar.actions()) {
        QWidget* tool = bar.widgetForAction(action);
        if (qobject_cast<QToolButton*>(tool) == nullptr && qobject_cast<QComboBox*>(tool) == nullptr) continue;
        tool->setFocusPolicy(Qt::TabFocus);
        tool->installEventFilter(this);
    }
}

bool ToolBarKeys::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress) return false;
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool vertical = qobject_cast<QComboBox*>(watched) != nullptr && (key == Qt::Key_Up || key == Qt::Key_Down);
    const bool use = key == Qt::Key_Space || key == Qt::Key_Return || key == Qt::Key_Enter;
    if (!use && !vertical) return false;
    if (event->type() == QEvent::ShortcutOverride) {
        event->accept();
        return true;
    }
    if (!use) return false;
    if (auto* button = qobject_cast<QToolButton*>(watched))
        button->click();
    else
        static_cast<QComboBox*>(watched)->showPopup();
    return true;
}

}  // namespace mrose::gui
