#include "frame/status_line.h"

#include "frame/actions.h"
#include "session/session.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr int saidFor = 6000;  // ms

}  // namespace

StatusLine::StatusLine(Session& session, const Actions& actions, QWidget& over)
    : session_(session), actions_(actions), quiet_(*new QuietMessage(over)) {
    setTextInteractionFlags(Qt::TextSelectableByMouse);
    connect(&session, &Session::opening, this, [this] { say(reported_ = QString()); });
    connect(&session, &Session::shown, this, &StatusLine::follow);
    end_.setSingleShot(true);
    end_.setInterval(saidFor);
    connect(&end_, &QTimer::timeout, this, [this] { say(reported_); });
}

void StatusLine::follow() {
    if (const QString message = qtText(session_.current()->message); message != reported_)
        say(reported_ = message);
    else if (session_.current()->tick() != saidAt_ && said_ != reported_ &&
             !(session_.current()->playing && quiet_.isVisible()))
        say(reported_);
}

void StatusLine::ask(const QString& text) {
    say(text);
    asked_ = true;
}

void StatusLine::done() {
    if (asked_) say(reported_);
}

void StatusLine::say(const QString& text) {
    saidAt_ = session_.current() ? session_.current()->tick() : 0;
    // While a script runs it is not shown, so that pictures are the same at any speed.
    if (text.isEmpty()) quiet_.hide();
    if (!text.isEmpty() && (text != said_ || !quiet_.isVisible()) && !actions_.unattended()) quiet_.say(text);
    said_ = text;
    asked_ = false;
    // What the debugger says holds for as long as the tick is shown.
    if (text == reported_ || actions_.unattended())
        end_.stop();
    else
        end_.start();
    setText(text);
    setToolTip(text);
}

}  // namespace mrose::gui
