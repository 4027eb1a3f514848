#pragma once

#include <QAction>
#include <QKeySequence>
#include <QMainWindow>
#include <QString>
#include <functional>
#include <map>
#include <variant>
#include <vector>

#include "io/error.h"

namespace mrose::gui {

/// All actions of the window, by name: menus, keys, the tool bar, the sheet of shortcuts and scripts all go through
/// these. An action lies in the menu that it is added to, in the order of adding.
class Actions {
public:
    explicit Actions(QMainWindow& window) : window_(window) {}

    struct Text {
        QString name;  ///< of lower-case words: "tick_forward"
        QString text;  ///< as the menu shows it, with & before its letter
        QKeySequence key;
        QString tip;
        bool checkable = false, checked = false;
    };
    /// `run` gets whether the action is checked now. `menu` as the menu bar shows it; it is made where there is none.
    QAction* add(const QString& menu, const Text& text, std::function<void(bool checked)> run);

    /// An action that needs a text, mostly a file's path; its text in the menu ends in an ellipsis. Chosen there it
    /// opens a dialogue by `ask`; a script gives the text instead: save_image("a.png").
    struct Asking {
        std::function<QString()> ask;  ///< empty: the user cancelled
        std::function<Expected<void>(const QString& answer)> run;
    };
    QAction* add(const QString& menu, const Text& text, Asking asking);

    /// One that was made elsewhere, a dock's own.
    void adopt(const QString& menu, const Text& text, QAction* action);
    void addSeparator(const QString& menu);
    QMenu* menu(const QString& title);

    /// nullptr: there is none of that name.
    QAction* find(const QString& name) const;
    QAction& operator[](const QString& name) const { return *find(name); }
    /// Those of each menu, in order.
    struct Group {
        QString title;
        QMenu* menu;
        std::vector<QAction*> actions;
    };
    const std::vector<Group>& groups() const { return groups_; }

    /// Nothing, on or off of a checkable action, how often, or the text that an action asks for.
    using Argument = std::variant<std::monostate, bool, int, QString>;
    /// As a script does it. Error: there is no such action, it is disabled now, the argument is not of its kind, or
    /// what the action said.
    Expected<void> perform(const QString& name, const Argument& argument);

    /// Opens the dialogue of an action that asks for a text; empty: the user cancelled.
    QString ask(const QString& name) const { return asking_.at(name).ask(); }

    /// Called with what went wrong with an action that a user chose.
    void setErrorHandler(std::function<void(const Error&)> handler) { onError_ = std::move(handler); }
    /// Unattended: a script is at work, and no user answers questions. No action opens a modal dialogue then.
    bool unattended() const { return unattended_; }
    void setUnattended(bool unattended) { unattended_ = unattended; }

private:
    QAction* make(const QString& menu, const Text& text);
    void place(const QString& menu, const Text& text, QAction* action);
    Group& group(const QString& title);
    Error unknown(const QString& name) const;

    QMainWindow& window_;
    std::vector<Group> groups_;
    std::map<QString, QAction*> byName_;
    std::map<QString, Asking> asking_;
    std::function<void(const Error&)> onError_;
    bool unattended_ = false;
};

}  // namespace mrose::gui
