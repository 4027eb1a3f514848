#include "actions.h"

#include <QMenu>
#include <QMenuBar>
#include <algorithm>
#include <utility>

namespace mrose::gui {

namespace {

/// How many letters must be changed, added or left out to make one name of the other.
std::size_t editDistance(const QString& from, const QString& to) {
    std::vector<std::size_t> row(static_cast<std::size_t>(to.size()) + 1);
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = i;
    for (int i = 0; i < from.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], row[0] + 1);
        for (std::size_t j = 1; j < row.size(); ++j) {
            const std::size_t changed = diagonal + (from[i] == to[static_cast<int>(j) - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, changed}));
        }
    }
    return row.back();
}

Error refusal(const QString& name, const char* cause) { return {"", 0, 0, name.toStdString(), cause}; }

}  // namespace

QAction* Actions::add(const QString& menu, const Text& text, std::function<void(bool)> run) {
    QAction* action = make(menu, text);
    QObject::connect(action, &QAction::triggered, &window_, [run = std::move(run)](bool checked) { run(checked); });
    return action;
}

QAction* Actions::add(const QString& menu, const Text& text, Asking asking) {
    QAction* action = make(menu, text);
    asking_[text.name] = asking;
    QObject::connect(action, &QAction::triggered, &window_, [this, asking = std::move(asking)] {
        if (unattended_) return;
        const QString answer = asking.ask();
        if (answer.isEmpty()) return;
        if (const auto done = asking.run(answer); !done && onError_) onError_(done.error());
    });
    return action;
}

QAction* Actions::make(const QString& menu, const Text& text) {
    auto* action = new QAction(text.text, &window_);
    action->setObjectName(text.name);
    action->setShortcut(text.key);
    action->setToolTip(text.key.isEmpty() ? text.tip
                                          : text.tip + " (" + text.key.toString(QKeySequence::NativeText) + ')');
    action->setStatusTip(text.tip);
    action->setCheckable(text.checkable);
    action->setChecked(text.checked);
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

Expected<void> Actions::perform(const QString& name, const Argument& argument) {
    QAction* action = find(name);
    if (action == nullptr) return tl::unexpected(unknown(name));
    if (!action->isEnabled()) return tl::unexpected(refusal(name, "cannot be done now"));
    if (const auto asking = asking_.find(name); asking != asking_.end()) {
        const QString* text = std::get_if<QString>(&argument);
        if (text == nullptr || text->isEmpty()) return tl::unexpected(refusal(name, "expected a text"));
        return asking->second.run(*text);
    }
    if (std::holds_alternative<QString>(argument)) return tl::unexpected(refusal(name, "expected no text"));
    if (const bool* on = std::get_if<bool>(&argument)) {
        if (!action->isCheckable()) return tl::unexpected(refusal(name, "is not switched on or off"));
        if (action->isChecked() != *on) action->trigger();
        return {};
    }
    const int* count = std::get_if<int>(&argument);
    for (int i = 0; i < (count != nullptr ? *count : 1); ++i) action->trigger();
    return {};
}

Error Actions::unknown(const QString& name) const {
    const auto nearest = std::min_element(byName_.begin(), byName_.end(), [&](const auto& a, const auto& b) {
        return editDistance(a.first, name) < editDistance(b.first, name);
    });
    std::string cause = "there is no action of this name";
    if (nearest != byName_.end() && editDistance(nearest->first, name) <= 3)
        cause += "; did you mean " + nearest->first.toStdString() + '?';
    return {"", 0, 0, name.toStdString(), cause};
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
