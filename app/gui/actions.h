#pragma once

#include <QAction>
#include <QKeySequence>
#include <QMainWindow>
#include <QString>
#include <functional>
#include <map>
#include <vector>

namespace mrose::gui {

/// Everything that the window can be told to do, by name: menus, keys, the tool bar, the sheet of shortcuts and scripts
/// all go through these. An action lies in the menu that it is added to, in the order of adding.
class Actions {
public:
    explicit Actions(QMainWindow& window) : window_(window) {}

    struct Text {
        const char* name;  ///< of lower-case words: "tick_forward"
        QString text;      ///< as the menu shows it, with & before its letter
        QKeySequence key;
        QString tip;
        bool checkable = false, checked = false;
    };
    /// `run` is told whether the action is checked now. `menu` as the menu bar shows it; it is made where there is
    /// none.
    QAction* add(const QString& menu, const Text& text, std::function<void(bool checked)> run);
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

private:
    Group& group(const QString& title);

    QMainWindow& window_;
    std::vector<Group> groups_;
    std::map<QString, QAction*> byName_;
};

}  // namespace mrose::gui
