#include "first_steps.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QToolButton>

#include "main_window.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

constexpr int cardWidth = 300, margin = 12;

}  // namespace

FirstSteps::FirstSteps(MainWindow& window) : QFrame(&window.field()), window_(window) {
    setObjectName("first_steps");
    hide();
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(14, 8, 8, 12);
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(6);
    grid->setColumnStretch(1, 1);
    auto* title = new QLabel(tr("What to try"));
    QFont bold = title->font();
    bold.setBold(true);
    title->setFont(bold);
    grid->addWidget(title, 0, 0, 1, 2);
    auto* close = new QToolButton;
    close->setText(QString::fromUtf8("\u00d7"));
    close->setToolTip(tr("Close; the menu Help brings it back"));
    close->setAccessibleName(tr("Close"));
    close->setAutoRaise(true);
    close->setFocusPolicy(Qt::NoFocus);
    connect(close, &QToolButton::clicked, this, &FirstSteps::closeRequested);
    grid->addWidget(close, 0, 2);
    const auto key = [&](const char* action) {
        return window_.actions()[action].shortcut().toString(QKeySequence::NativeText);
    };
    add(tr("%1 stops the game and lets it go on").arg(key("play")), {"play"});
    add(tr("%1 goes back a tick, %2 goes on").arg(key("tick_back"), key("tick_forward")),
        {"tick_back", "tick_forward"});
    add(tr("%1 finds the decision behind the last kick").arg(key("cause_of_kick")), {"cause_of_kick"});
    add(tr("Drag a robot while it stands, or change its command: a branch begins, the old course stays as a ghost"),
        {});
    const std::size_t branch = steps_.size() - 1;
    add(tr("%1 shows both side by side").arg(key("side_by_side")), {"side_by_side"});
    add(tr("%1 undoes").arg(key("undo")), {"undo"});
    add(tr("%1 shows all keys").arg(key("shortcuts")), {"shortcuts"});
    connect(&window_, &MainWindow::updated, this, [this, branch] {
        if (window_.shown()->branches.size() > std::exchange(branches_, window_.shown()->branches.size())) tick(branch);
    });
    parentWidget()->installEventFilter(this);
}

void FirstSteps::add(const QString& text, std::initializer_list<const char*> actions) {
    const std::size_t step = steps_.size();
    steps_.push_back({text});
    auto* mark = new QLabel(QString::fromUtf8("\u25cb"));
    auto* words = new QLabel(text);
    words->setWordWrap(true);
    auto* grid = static_cast<QGridLayout*>(layout());
    const int row = grid->rowCount();
    grid->addWidget(mark, row, 0, Qt::AlignTop);
    grid->addWidget(words, row, 1, 1, 2);
    marks_.push_back(mark);
    texts_.push_back(words);
    for (const char* name : actions)
        connect(&window_.actions()[name], &QAction::triggered, this, [this, step] { tick(step); });
}

void FirstSteps::tick(std::size_t step) {
    steps_[step].done = true;
    marks_[step]->setText(QString::fromUtf8("\u2713"));
    marks_[step]->setForegroundRole(QPalette::Link);
    texts_[step]->setEnabled(false);  // quieter
}

void FirstSteps::place() {
    const int width = std::min(cardWidth, parentWidget()->width() - 2 * margin);
    const int height = layout()->heightForWidth(width);
    setGeometry(parentWidget()->width() - width - margin, margin, width, height);
}

bool FirstSteps::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible()) place();
    return QFrame::eventFilter(watched, event);
}

void FirstSteps::showEvent(QShowEvent* event) {
    place();
    raise();
    QFrame::showEvent(event);
}

void FirstSteps::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QColor back = palette().color(QPalette::Window);
    back.setAlpha(238);
    painter.setBrush(back);
    painter.setPen(QPen(palette().color(QPalette::Mid), 1));
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
}

}  // namespace mrose::gui
