#include "first_steps.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QToolButton>

#include "command_panel.h"
#include "main_window.h"
#include "plot_panel.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

constexpr int margin = 12;

}  // namespace

FirstSteps::FirstSteps(MainWindow& window) : QFrame(&window.field()), window_(window) {
    setObjectName("first_steps");
    hide();
    QFont small = font();
    small.setPointSizeF(0.86 * small.pointSizeF());
    setFont(small);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(12, 2, 12, 8);
    grid->setHorizontalSpacing(10);
    grid->setVerticalSpacing(1);
    grid->setColumnStretch(2, 1);
    auto* title = new QLabel(tr("What to try"));
    QFont bold = small;
    bold.setBold(true);
    title->setFont(bold);
    grid->addWidget(title, 0, 0, 1, 3);
    auto* close = new QToolButton;
    close->setText(QString::fromUtf8("\u00d7"));
    close->setToolTip(tr("Close; the menu Help brings it back"));
    close->setAccessibleName(tr("Close"));
    close->setAutoRaise(true);
    close->setFocusPolicy(Qt::NoFocus);
    connect(close, &QToolButton::clicked, this, &FirstSteps::closeRequested);
    grid->addWidget(close, 0, 3);
    const auto key = [&](const char* action) {
        return window_.actions()[action].shortcut().toString(QKeySequence::NativeText);
    };
    add({key("play"), tr("stops, and goes on")}, {"play"});
    add({tr("%1, %2").arg(key("tick_back"), key("tick_forward")), tr("a tick back, a tick on")},
        {"tick_back", "tick_forward"});
    add({key("cause_of_kick"), tr("the decision behind the last kick")}, {"cause_of_kick"});
    add({key("change_command"), tr("another command there: a branch")}, {"apply_command"});
    const std::size_t command = steps_.size() - 1;
    add({tr("Drag a robot"), tr("a branch; its knob turns it")}, {});
    const std::size_t branch = steps_.size() - 1;
    add({key("side_by_side"), tr("both courses side by side")}, {"side_by_side"});
    add({tr("Click a number"), tr("in the inspector, to plot it")}, {});
    const std::size_t plot = steps_.size() - 1;
    connect(&window_.plots(), &PlotPanel::changed, this, [this, plot] {
        if (!window_.plots().keys().empty()) tick(plot);
    });
    add({tr("%1, %2").arg(key("undo"), key("shortcuts")), tr("undoes; shows all keys")}, {"undo", "shortcuts"});
    connect(&window_.commandPanel(), &CommandPanel::branchRequested, this, [this, command] { tick(command); });
    connect(&window_, &MainWindow::updated, this, [this, branch] {
        const std::vector<BranchInfo>& branches = window_.shown()->branches;
        const bool begun = branches.size() > std::exchange(branches_, branches.size());
        if (begun && (branches.back().name.endsWith(tr("moved")) || branches.back().name.endsWith(tr("turned"))))
            tick(branch);
    });
    // Two fields leave no room for it.
    connect(&window_.actions()["side_by_side"], &QAction::toggled, this, [this](bool on) {
        if (!on && std::exchange(waits_, false)) show();
        if (!on || !window_.shown() || !window_.shown()->beside) return;
        waits_ = isVisible();
        hide();
    });
    parentWidget()->installEventFilter(this);
}

void FirstSteps::add(const Step& step, std::initializer_list<const char*> actions) {
    const std::size_t index = steps_.size();
    steps_.push_back(step);
    auto* mark = new QLabel(QString::fromUtf8("\u25cb"));
    auto* keys = new QLabel(step.keys);
    keys->setForegroundRole(QPalette::Link);
    auto* grid = static_cast<QGridLayout*>(layout());
    const int row = grid->rowCount();
    grid->addWidget(mark, row, 0);
    grid->addWidget(keys, row, 1);
    grid->addWidget(new QLabel(step.text), row, 2, 1, 2);
    marks_.push_back(mark);
    for (const char* name : actions)
        connect(&window_.actions()[name], &QAction::triggered, this, [this, index] { tick(index); });
}

void FirstSteps::tick(std::size_t step) {
    steps_[step].done = true;
    marks_[step]->setText(QString::fromUtf8("\u2713"));
    marks_[step]->setForegroundRole(QPalette::Link);
}

/// In a corner, of which the fitted field stays clear.
void FirstSteps::place() {
    const QSize size = sizeHint().boundedTo(parentWidget()->size());
    setGeometry(QRect(
        QPoint(parentWidget()->width() - size.width() - margin, parentWidget()->height() - size.height() - margin),
        size));
    window_.field().setCovered(geometry());
}

void FirstSteps::setVisible(bool visible) {
    QFrame::setVisible(visible);
    if (!visible) window_.field().setCovered({});
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
