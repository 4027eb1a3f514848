#include "panels/breakpoint_panel.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPainter>
#include <QScrollArea>
#include <QStyledItemDelegate>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "debug/shown.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr int idRole = Qt::UserRole, noteRole = Qt::UserRole + 1, wrongRole = Qt::UserRole + 2,
              hereRole = Qt::UserRole + 3, waitsRole = Qt::UserRole + 4;

/// Two lines: what it waits for, and below it, smaller, how often that was met or what is wrong with it.
class BreakpointDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void setTheme(const Theme& theme) { theme_ = theme; }

    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& /*index*/) const override {
        return {60, QFontMetrics(option.font).height() + QFontMetrics(small(option.font)).height() + 8};
    }

    void paint(QPainter* painter, const QStyleOptionViewItem& given, const QModelIndex& index) const override {
        QStyleOptionViewItem option = given;
        initStyleOption(&option, index);
        const QString text = std::exchange(option.text, {}).simplified();
        const QStyle* style = option.widget->style();
        painter->save();
        style->drawControl(QStyle::CE_ItemViewItem, &option, painter, option.widget);
        // The style's own box has no edge on dark ground.
        const QRect box = style->subElementRect(QStyle::SE_ItemViewItemCheckIndicator, &option, option.widget);
        painter->setPen(theme_.quietText);
        painter->setBrush(Qt::NoBrush);
        painter->drawRect(box.adjusted(0, 0, -1, -1));
        option.text = text;  // it says where the text begins
        QRect place = style->subElementRect(QStyle::SE_ItemViewItemText, &option, option.widget);
        place = QRect(place.left() + 3, option.rect.top() + 3, option.rect.right() - place.left() - 8,
                      option.rect.height() - 6);
        const bool chosen = option.state.testFlag(QStyle::State_Selected);
        const bool on = index.data(Qt::CheckStateRole).toInt() == Qt::Checked;
        const QColor plain = chosen ? option.palette.color(QPalette::HighlightedText) : theme_.text;
        const QColor quiet = chosen ? plain : theme_.quietText;
        QFont font = option.font;
        font.setBold(index.data(hereRole).toBool());
        painter->setFont(font);
        painter->setPen(on && !index.data(waitsRole).toBool() ? plain : quiet);
        const QFontMetrics lines(font);
        painter->drawText(place, Qt::AlignLeft | Qt::AlignTop, lines.elidedText(text, Qt::ElideRight, place.width()));
        painter->setFont(small(option.font));
        painter->setPen(index.data(wrongRole).toBool() && !chosen ? theme_.warning : quiet);
        painter->drawText(
            place, Qt::AlignLeft | Qt::AlignBottom,
            QFontMetrics(painter->font()).elidedText(index.data(noteRole).toString(), Qt::ElideRight, place.width()));
        painter->restore();
    }

private:
    static QFont small(QFont font) {
        font.setPointSizeF(0.88 * font.pointSizeF());
        font.setBold(false);
        return font;
    }

    Theme theme_ = Theme::light();
};

/// Text in lines of which the room is always the same: one whose height depends on its width makes the whole panel's
/// depend on it.
class ReplyLabel final : public QLabel {
public:
    bool hasHeightForWidth() const override { return false; }
};

constexpr int leastList = 42;  // pixels: a row
constexpr const char* breakHereText = "breakHere()";

QString timesText(int from) {
    switch (from) {
        case 1:
            return {};
        case 2:
            return QObject::tr("from 2nd");
        case 3:
            return QObject::tr("from 3rd");
        default:
            return QObject::tr("from %1th").arg(from);
    }
}

/// What is to be said of it below its text, and whether something is wrong with it.
std::pair<QString, bool> noteOf(const BreakpointState& state) {
    const Breakpoint& breakpoint = state.breakpoint;
    if (!breakpoint.error.empty()) return {QObject::tr("switched off: %1").arg(qtText(breakpoint.error)), true};
    if (state.elsewhere) return {QObject::tr("in this rollout %1").arg(qtText(state.unfit)), false};
    if (!state.unfit.empty()) return {qtText(state.unfit), true};
    QStringList parts;
    if (state.all == 0 && breakpoint.enabled && breakpoint.text == breakHereText)
        return {QObject::tr("where a controller asks for it"), false};
    if (state.here) parts << QObject::tr("here");
    if (state.all > 0)
        parts << QObject::tr("met %1 times up to here, %2 in all").arg(state.hits).arg(state.all);
    else if (breakpoint.enabled)
        parts << QObject::tr("not met yet");
    if (!breakpoint.enabled) parts << QObject::tr("off");
    if (breakpoint.oneShot) parts << QObject::tr("once");
    if (breakpoint.from > 1) parts << timesText(breakpoint.from);
    return {parts.join(QString::fromUtf8(" \u00b7 ")), false};
}

}  // namespace

BreakpointPanel::BreakpointPanel(QWidget* parent)
    : QWidget(parent), list_(new QListWidget), line_(new QLineEdit), offers_(new QToolButton), reply_(new ReplyLabel) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(list_, 1);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(6, 6, 6, 2);
    row->setSpacing(4);
    row->addWidget(line_, 1);
    row->addWidget(offers_);
    layout->addLayout(row);
    layout->addWidget(reply_);
    list_->setObjectName("breakpoint_list");
    list_->setAccessibleName(tr("Breakpoints"));
    list_->setFrameShape(QFrame::NoFrame);
    list_->setItemDelegate(new BreakpointDelegate(list_));
    list_->setUniformItemSizes(true);
    list_->setMinimumHeight(leastList);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setVerticalScrollMode(QAbstractItemView::ScrollPerItem);
    list_->setEditTriggers(QAbstractItemView::DoubleClicked);
    list_->setContextMenuPolicy(Qt::ActionsContextMenu);
    list_->installEventFilter(this);
    line_->installEventFilter(this);
    line_->setObjectName("breakpoint_line");
    line_->setPlaceholderText(tr("Stop where\u2026"));
    line_->setToolTip(
        tr("A condition such as robot[2].speed > 0.5 and distance(robot[2], ball) < 0.3,\n"
           "beside a real log robot[1].error > 0.1 (m), heading_error, real_x, real_y, real_heading,\n"
           "or contact, kick, goal, fault, with a name behind it where only that one counts;\n"
           "breakHere(), divergence. Enter adds it"));
    line_->setAccessibleName(tr("Add a breakpoint"));
    offers_->setText("+");
    offers_->setToolTip(tr("Add a breakpoint without typing"));
    offers_->setPopupMode(QToolButton::InstantPopup);
    offers_->setFocusPolicy(Qt::TabFocus);
    reply_->setObjectName("breakpoint_reply");
    reply_->setWordWrap(true);
    reply_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    reply_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    reply_->setTextFormat(Qt::PlainText);
    reply_->setContentsMargins(8, 0, 8, 6);
    // The line above stays where it is when there is a reply.
    reply_->setFixedHeight(2 * reply_->fontMetrics().lineSpacing() + 6);
    connect(line_, &QLineEdit::textChanged, this, &BreakpointPanel::check);
    connect(line_, &QLineEdit::returnPressed, this, [this] {
        if (!add(line_->text())) return;
        line_->clear();
        list_->setFocus();
    });
    connect(list_, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) { itemChanged(*item); });
    connect(list_, &QListWidget::currentRowChanged, this, &BreakpointPanel::check);
    reply({}, false);
}

void BreakpointPanel::setOffers(QMenu* menu) { offers_->setMenu(menu); }

void BreakpointPanel::offer(QAction* action) { list_->addAction(action); }

void BreakpointPanel::setTheme(const Theme& theme) {
    theme_ = theme;
    static_cast<BreakpointDelegate*>(list_->itemDelegate())->setTheme(theme);
    check();
}

void BreakpointPanel::setShown(const Shown& shown) {
    setup_ = shown.setup;
    reality_ = shown.frame->reality;
    states_ = shown.breakpoints;
    filling_ = true;
    const int before = list_->count();
    while (list_->count() > static_cast<int>(states_.size())) delete list_->takeItem(list_->count() - 1);
    while (list_->count() < static_cast<int>(states_.size())) new QListWidgetItem(list_);
    for (std::size_t i = 0; i < states_.size(); ++i) refresh(*list_->item(static_cast<int>(i)), states_[i]);
    // One that is added is chosen; the one that is there from the beginning is not.
    const bool first = before == 0 && !states_.empty() && states_.back().breakpoint.text == breakHereText;
    if (list_->count() > before && !first) list_->setCurrentRow(list_->count() - 1);
    filling_ = false;
    check();
}

void BreakpointPanel::refresh(QListWidgetItem& item, const BreakpointState& state) {
    const auto set = [&item](int role, const QVariant& value) {
        if (item.data(role) != value) item.setData(role, value);
    };
    const auto [note, wrong] = noteOf(state);
    const QString text = qtText(state.breakpoint.text);
    item.setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable | Qt::ItemIsEditable);
    set(Qt::DisplayRole, text);
    set(Qt::CheckStateRole, static_cast<int>(state.breakpoint.enabled ? Qt::Checked : Qt::Unchecked));
    set(idRole, state.breakpoint.id);
    set(noteRole, note);
    set(wrongRole, wrong);
    set(hereRole, state.here);
    set(waitsRole, state.all == 0 && state.breakpoint.text == breakHereText);
    set(Qt::ToolTipRole, text + '\n' + note);
}

std::optional<Breakpoint> BreakpointPanel::current() const {
    const int row = list_->currentRow();
    if (row < 0 || row >= static_cast<int>(states_.size())) return {};
    return states_[static_cast<std::size_t>(row)].breakpoint;
}

void BreakpointPanel::edit() {
    line_->setFocus();
    line_->selectAll();
}

Expected<void> BreakpointPanel::add(const QString& text) {
    if (!setup_) return fail("", "nothing is open");
    if (auto fits = checkBreakText(text.toStdString(), *setup_, reality_); !fits)
        return fail("", wrongWith(fits.error()));
    Breakpoint breakpoint;
    breakpoint.text = text.toStdString();
    emit added(breakpoint);
    return {};
}

/// Its check box or its text.
void BreakpointPanel::itemChanged(const QListWidgetItem& item) {
    if (filling_) return;
    const auto state = std::find_if(states_.begin(), states_.end(), [&](const BreakpointState& one) {
        return one.breakpoint.id == item.data(idRole).toUInt();
    });
    if (state == states_.end()) return;
    Breakpoint breakpoint = state->breakpoint;
    breakpoint.enabled = item.checkState() == Qt::Checked;
    const std::string text = item.text().trimmed().toStdString();
    if (!text.empty()) breakpoint.text = text;
    if (!(breakpoint == state->breakpoint)) emit changed(breakpoint);
}

/// Says what is wrong with the text that is typed, or with the chosen breakpoint.
void BreakpointPanel::check() {
    if (filling_) return;
    if (!line_->text().trimmed().isEmpty() && setup_) {
        const auto fits = checkBreakText(line_->text().toStdString(), *setup_, reality_);
        return reply(fits ? tr("Enter adds it") : qtText(wrongWith(fits.error())), !fits);
    }
    const int row = list_->currentRow();
    if (row < 0 || row >= static_cast<int>(states_.size())) return reply({}, false);
    const auto [note, wrong] = noteOf(states_[static_cast<std::size_t>(row)]);
    reply(wrong ? note : QString(), wrong);
}

void BreakpointPanel::reply(const QString& text, bool wrong) {
    if (reply_->text() != text) reply_->setText(text);
    const QString style = "color: " + (wrong ? theme_.warning : theme_.quietText).name();
    if (reply_->styleSheet() != style) reply_->setStyleSheet(style);
    reply_->setToolTip(text);
}

bool BreakpointPanel::eventFilter(QObject* watched, QEvent* event) {
    // Where the panel is scrolled, the reply to the line is in sight, too.
    if (watched == line_ && event->type() == QEvent::FocusIn)
        QTimer::singleShot(0, reply_, [this] {
            for (QWidget* at = parentWidget(); at != nullptr; at = at->parentWidget())
                if (auto* area = qobject_cast<QScrollArea*>(at)) {
                    area->ensureWidgetVisible(reply_, 0, 0);
                    area->ensureWidgetVisible(line_, 0, 0);
                }
        });
    // The chosen row stays in sight.
    if (watched == list_ && event->type() == QEvent::Resize)
        QTimer::singleShot(0, list_, [this] { list_->scrollToItem(list_->currentItem()); });
    if (watched != list_ || event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
    const auto chosen = current();
    if (!chosen || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Delete) return QWidget::eventFilter(watched, event);
    emit removed(chosen->id);
    return true;
}

}  // namespace mrose::gui
