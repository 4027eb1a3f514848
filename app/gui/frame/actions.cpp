#include "frame/actions.h"

#include <QMenu>
#include <QMenuBar>
#include <algorithm>
#include <utility>

#include "io/nearest_word.h"

namespace mrose::gui {

namespace {

tl::unexpected<Error> refuse(const char* cause) { return fail("", cause); }

}  // namespace

QAction* Actions::add(const QString& menu, const Text& text, std::function<void(bool)> run) {
    QAction* action = make(menu, text);
    QObject::connect(action, &QAction::triggered, &window_, [run = std::move(run)](bool checked) { run(checked); });
    return action;
}

QAction* Actions::add(const QString& menu, const Text& text, Asking asking) {
    QAction* action = make(menu, text);
    asking_[text.name] = asking;
    QObject::connect(
        action, &QAction::triggered, &window_, [this, asking = std::move(asking), name = text.name.toStdString()] {
            if (unattended_) {
                if (onError_)
                    onError_({"", 0, 0, name, "dialogues cannot be opened here; a script calls " + name + "(\"...\")"});
                return;
            }
            const QString answer = asking.ask();
            if (answer.isEmpty()) return;
            if (const auto done = asking.run(answer); !done && onError_) onError_(done.error());
        });
    return action;
}

QAction* Actions::make(const QString& menu, const Text& text) {
    auto* action = new QAction(&window_);
    action->setCheckable(text.checkable);
    action->setChecked(text.checked);
    place(menu, text, action);
    return action;
}

void Actions::adopt(const QString& menu, const Text& text, QAction* action) { place(menu, text, action); }

void Actions::place(const QString& menu, const Text& text, QAction* action) {
    action->setText(text.text);
    action->setObjectName(text.name);
    action->setShortcut(text.key);
    action->setToolTip(text.key.isEmpty() ? text.tip
                                          : text.tip + " (" + text.key.toString(QKeySequence::NativeText) + ')');
    action->setStatusTip(text.tip);
    window_.addAction(action);
    Group& in = group(menu);
    in.menu->addAction(action);
    in.actions.push_back(action);
    byName_[text.name] = action;
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
    if (!action->isEnabled()) return refuse("cannot be done now");
    if (const auto asking = asking_.find(name); asking != asking_.end()) {
        const int* number = std::get_if<int>(&argument);
        const QString* text = std::get_if<QString>(&argument);
        if (number == nullptr && (text == nullptr || text->isEmpty())) return refuse("expected a text");
        return asking->second.run(number != nullptr ? QString::number(*number) : *text);
    }
    if (std::holds_alternative<QString>(argument)) return refuse("takes no text");
    if (const bool* on = std::get_if<bool>(&argument)) {
        if (!action->isCheckable()) return refuse("cannot be switched on or off");
        if (action->isChecked() != *on) action->trigger();
        return {};
    }
    const int* count = std::get_if<int>(&argument);
    if (count != nullptr && (action->isCheckable() || *count < 0)) return refuse("takes no such number");
    for (int i = 0; i < (count != nullptr ? *count : 1); ++i) action->trigger();
    return {};
}

Error Actions::unknown(const QString& name) const {
    std::vector<std::string> names;
    for (const auto& [known, action] : byName_) names.push_back(known.toStdString());
    const std::string_view meant = nearestWord(name.toStdString(), {names.begin(), names.end()});
    const std::string hint = meant.empty() ? "" : "; did you mean " + std::string(meant) + '?';
    return {"", 0, 0, name.toStdString(), "there is no action of this name" + hint};
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
