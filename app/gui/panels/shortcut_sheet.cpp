#include "panels/shortcut_sheet.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QScreen>
#include <QScrollArea>
#include <algorithm>

namespace mrose::gui {
namespace {

constexpr int mostColumns = 4, gap = 18;  // pixels
constexpr double smallFont = 8;           // points

QString plain(QString menuText) { return menuText.remove('&').remove(QString::fromUtf8("\u2026")); }

ShortcutGroup mouseGestures() {
    using Tr = QObject;
    return {Tr::tr("Mouse"),
            {{Tr::tr("Click"), Tr::tr("Select a robot or object"), {}},
             {Tr::tr("Drag a body"), Tr::tr("Move it"), Tr::tr("While the run stands")},
             {Tr::tr("Drag its knob"), Tr::tr("Turn the selected robot"), Tr::tr("While the run stands")},
             {Tr::tr("Right-drag a body"), Tr::tr("Turn it"), Tr::tr("While the run stands")},
             {Tr::tr("Drag the field"), Tr::tr("Move the view"), {}},
             {Tr::tr("Shift+drag"), Tr::tr("Measure"), {}},
             {Tr::tr("Wheel"), Tr::tr("Zoom at the cursor"), {}},
             {Tr::tr("Press the timeline"), Tr::tr("Go to that moment"), {}},
             {Tr::tr("Drop a file"), Tr::tr("Open it"), {}}}};
}

bool hasAll(const Shortcut& shortcut, const QString& group, const QString& words) {
    const QString text = shortcut.keys + ' ' + shortcut.does + ' ' + shortcut.tip + ' ' + group;
    const QStringList all = words.split(' ', Qt::SkipEmptyParts);
    return std::all_of(all.begin(), all.end(),
                       [&](const QString& word) { return text.contains(word, Qt::CaseInsensitive); });
}

/// Room for a group: its title, its rows and the gap below.
int heightOf(const ShortcutGroup& group) { return static_cast<int>(group.shortcuts.size()) + 2; }

}  // namespace

std::vector<ShortcutGroup> shortcutGroups(const Actions& actions) {
    std::vector<ShortcutGroup> groups;
    for (const Actions::Group& group : actions.groups()) {
        ShortcutGroup shown{plain(group.title), {}};
        for (const QAction* action : group.actions)
            shown.shortcuts.push_back(
                {action->shortcut().toString(QKeySequence::NativeText), plain(action->text()), action->statusTip()});
        groups.push_back(std::move(shown));
    }
    groups.push_back(mouseGestures());
    return groups;
}

QString shortcutText(const std::vector<ShortcutGroup>& groups) {
    int width = 0;
    for (const ShortcutGroup& group : groups)
        for (const Shortcut& shortcut : group.shortcuts) width = std::max(width, shortcut.keys.size());
    QString text;
    for (const ShortcutGroup& group : groups) {
        text += (text.isEmpty() ? "" : "\n") + group.title + '\n';
        for (const Shortcut& shortcut : group.shortcuts)
            text += "  " + shortcut.keys.leftJustified(width + 2) +
                    (shortcut.tip.isEmpty() ? shortcut.does : shortcut.tip) + '\n';
    }
    return text;
}

ShortcutSheet::ShortcutSheet(const Actions& actions, QWidget* parent)
    : QDialog(parent), actions_(actions), line_(new QLineEdit), area_(new QScrollArea) {
    setWindowTitle(tr("Shortcuts"));
    QFont small = font();
    small.setPointSizeF(std::min(smallFont, small.pointSizeF()));
    setFont(small);
    setObjectName("shortcut_sheet");
    line_->setPlaceholderText(tr("Search"));
    line_->setAccessibleName(tr("Search the shortcuts"));
    area_->setWidgetResizable(true);
    area_->setFrameShape(QFrame::NoFrame);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 8, 8, 8);
    layout->setSpacing(6);
    layout->addWidget(line_);
    layout->addWidget(area_, 1);
    connect(line_, &QLineEdit::textChanged, this, &ShortcutSheet::search);
    area_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    fill();
    const QSize room = screen()->availableSize().expandedTo(parent->size()) * 95 / 100;
    resize(std::min(room.width(), mostColumns * (blockWidth_ + gap) + 2 * gap), std::min(room.height(), 760));
}

void ShortcutSheet::search(const QString& words) {
    words_ = words;
    fill();
}

/// Later: the caller, which changes the colours of all widgets, still holds those that are filled in anew.
void ShortcutSheet::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange)
        QMetaObject::invokeMethod(this, &ShortcutSheet::fill, Qt::QueuedConnection);
    QDialog::changeEvent(event);
}

void ShortcutSheet::resizeEvent(QResizeEvent* event) {
    QDialog::resizeEvent(event);
    if (columns_ != fittingColumns(area_->width())) fill();
}

int ShortcutSheet::fittingColumns(int width) const {
    return std::clamp(width / std::max(1, blockWidth_ + gap), 1, mostColumns);
}

/// Each group in the column that is shortest so far.
void ShortcutSheet::fill() {
    std::vector<std::pair<int, QWidget*>> blocks;  // heights
    for (ShortcutGroup& group : shortcutGroups(actions_)) {
        std::erase_if(group.shortcuts, [&](const Shortcut& some) { return !hasAll(some, group.title, words_); });
        if (group.shortcuts.empty()) continue;
        blocks.emplace_back(heightOf(group), block(group));
        blockWidth_ = std::max(blockWidth_, blocks.back().second->sizeHint().width());
    }
    columns_ = fittingColumns(area_->width());
    auto* page = new QWidget;
    auto* across = new QHBoxLayout(page);
    across->setContentsMargins(0, 0, gap / 3, 0);
    across->setSpacing(gap);
    std::vector<std::pair<int, QVBoxLayout*>> columns;  // heights
    for (int i = 0; i < columns_; ++i) {
        columns.emplace_back(0, new QVBoxLayout);
        columns.back().second->setSpacing(8);
        across->addLayout(columns.back().second, 1);
    }
    for (const auto& [height, widget] : blocks) {
        auto& shortest = *std::min_element(columns.begin(), columns.end(),
                                           [](const auto& one, const auto& other) { return one.first < other.first; });
        shortest.first += height;
        shortest.second->addWidget(widget);
    }
    if (blocks.empty()) columns.front().second->addWidget(new QLabel(tr("Nothing has these words")));
    for (const auto& [height, column] : columns) column->addStretch(1);
    area_->setWidget(page);
}

QWidget* ShortcutSheet::block(const ShortcutGroup& group) {
    auto* made = new QWidget(this);  // for its font
    auto* grid = new QGridLayout(made);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setVerticalSpacing(0);
    grid->setHorizontalSpacing(8);
    grid->setColumnStretch(0, 1);
    auto* title = new QLabel(group.title);
    QFont bold = font();
    bold.setBold(true);
    title->setFont(bold);
    grid->addWidget(title, 0, 0, 1, 2);
    int row = 1;
    for (const Shortcut& shortcut : group.shortcuts) {
        auto* does = new QLabel(shortcut.does);
        does->setToolTip(shortcut.tip);
        auto* keys = new QLabel(shortcut.keys);
        keys->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        keys->setForegroundRole(QPalette::Link);
        grid->addWidget(does, row, 0);
        grid->addWidget(keys, row++, 1);
    }
    return made;
}

}  // namespace mrose::gui
