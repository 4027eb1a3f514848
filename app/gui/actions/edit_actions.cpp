#include "actions/window_actions.h"
#include "window/main_window.h"

namespace mrose::gui {

void addEditActions(MainWindow& window) {
    Actions& actions = window.actions();
    const QString menu = QObject::tr("&Edit");
    actions.add(menu,
                {"undo", QObject::tr("&Undo"), QKeySequence("Ctrl+Z"), QObject::tr("Back to before the last change")},
                [&](bool) { window.session().ask(&Debugger::undo); });
    actions.add(menu, {"redo", QObject::tr("&Redo"), QKeySequence("Ctrl+Shift+Z"), QObject::tr("The change again")},
                [&](bool) { window.session().ask(&Debugger::redo); });
}

}  // namespace mrose::gui
