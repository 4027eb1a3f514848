#include "frame/window_frame.h"

#include <QDockWidget>
#include <QInputDialog>
#include <QLineEdit>
#include <memory>

#include "frame/status_line.h"

namespace mrose::gui {

void WindowFrame::say(const QString& text) const { status.say(text); }

void WindowFrame::showDock(const char* name) const {
    auto* dock = window.findChild<QDockWidget*>(name);
    dock->show();
    dock->raise();
}

void WindowFrame::whenStanding(const QString& why, const std::function<void()>& then) const {
    if (shown() == nullptr || !shown()->playing) return then();
    session.pause();
    const auto once = std::make_shared<QMetaObject::Connection>();
    *once = QObject::connect(&session, &Session::shown, &window, [this, once, why, then] {
        if (shown()->playing) return;
        QObject::disconnect(*once);
        say(why);
        then();
    });
}

QString WindowFrame::askText(const QString& title, const QString& label, const QString& suggestion) const {
    return QInputDialog::getText(&window, title, label, QLineEdit::Normal, suggestion);
}

}  // namespace mrose::gui
