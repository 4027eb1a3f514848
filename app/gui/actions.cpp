#include "actions.h"

#include <QMenu>
#include <QMenuBar>
#include <algorithm>

namespace mrose::gui {

QAction* Actions::add(const QString& menu, const Text& text, std::function<void(bool)> run) {
    auto* action = new QAction(text.text, &window_);
    action->setObjectName(text.name);
    action->setShortcut(text.key);
    action->setToolTip(text.key.isEmpty() ? text.tip
                                          : text.tip + " (" + text.key.toString(QKeySequence::NativeText) + ')');
    action->setStatusTip(text.tip);
    action->setCheckable(text.checkable);
    action->setChecked(text.checked);
    QObject::connect(action, &QAction::triggered, &window_, [run = std::move(run)](bool checked) { run(checked); });
    window_.addAction(action);
    Group& in = group(menu);
    in.menu->addAction(action);
    in.actions.push_back(action);
    byName_[text.name] = action;
    return action;
}

void Actions::addSeparator(const QString& menu) { group(menu).menu->addSeparator(); }

QMenu* Actions::menu(const QString& title) { return group(title).menu; }

QAction* Actions::find(const QString& name) const {
    const auto found = byName_.find(name);
    return found == byName_.end() ? nullptr : found->second;
}

Actions::Group& Actions::group(const QString& title) {
    const auto found =
        std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) { return group.title == title; });
    if (found != groups_.end()) return *found;
    QMenu* menu = window_.menuBar()->addMenu(title);
    menu->setToolTipsVisible(true);
    groups_.push_back({title, menu, {}});
    return groups_.back();
}

}  // namespace mrose::gui
