#include <QFontMetrics>

#include "actions/window_actions.h"
#include "frame/actions.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// With what it would do.
void nameIt(const WindowFrame& frame, const char* action, const QString& does, bool possible, const QString& what) {
    constexpr int widestName = 400;  // pixels
    QString quoted = frame.window.fontMetrics().elidedText(what, Qt::ElideMiddle, widestName);
    frame.actions[action].setText(
        possible && !what.isEmpty() ? QObject::tr("%1: %2").arg(does, quoted.replace('&', "&&")) : does);
}

}  // namespace

void addEditActions(const WindowFrame& frame, FieldView& field) {
    const QString menu = QObject::tr("&Edit");
    frame.actions.add(
        menu, {"undo", QObject::tr("&Undo"), QKeySequence("Ctrl+Z"), QObject::tr("Back to before the last change")},
        [&](bool) { frame.session.ask(&Debugger::undo); });
    frame.actions.add(menu,
                      {"redo", QObject::tr("&Redo"), QKeySequence("Ctrl+Shift+Z"), QObject::tr("The change again")},
                      [&](bool) { frame.session.ask(&Debugger::redo); });
    QObject::connect(&frame.session, &Session::shown, &frame.window, [&frame] {
        const Shown& shown = *frame.shown();
        nameIt(frame, "undo", QObject::tr("&Undo"), shown.canUndo, qtText(shown.undoName));
        nameIt(frame, "redo", QObject::tr("&Redo"), shown.canRedo, qtText(shown.redoName));
    });
    QObject::connect(&field, &FieldView::bodyMoved, &frame.window, [&frame](std::size_t body, const Pose& pose) {
        if (!frame.shown()) return;
        if (const auto edit = putBody(*frame.shown()->frame, body, pose))
            frame.session.branchOff(*edit);
        else
            frame.say(qtText(edit.error().message()));
    });
    QObject::connect(&field, &FieldView::dragRefused, &frame.window, [&frame] {
        frame.whenStanding(QObject::tr("Stopped, since bodies are moved while the run stands: drag it now"));
    });
}

}  // namespace mrose::gui
