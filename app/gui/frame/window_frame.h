#pragma once

#include <QMainWindow>
#include <functional>

#include "session/session.h"

namespace mrose {
class MessageBar;
}

namespace mrose::gui {

class Actions;
class StatusLine;
class WindowMemory;

/// What all parts of a window may use: the run's thread, what can be done, where something is said, what is kept from
/// one start to the next. It lives as long as the window.
struct WindowFrame {
    QMainWindow& window;  ///< above which dialogues open
    Session& session;
    Actions& actions;
    MessageBar& messages;
    StatusLine& status;
    WindowMemory& memory;

    const Shown* shown() const { return session.current().get(); }
    void say(const QString& text) const;
    void showDock(const char* name) const;  ///< to the front of those that it shares its place with
    /// Stops the run, if it plays, and says why; then, at once where it stands, does what needs that.
    void whenStanding(
        const QString& why, const std::function<void()>& then = [] {}) const;
    /// Asks the user for a line; empty: the user cancelled.
    QString askText(const QString& title, const QString& label, const QString& suggestion = {}) const;
};

}  // namespace mrose::gui
