#include "actions/first_steps.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QToolButton>

#include "frame/actions.h"
#include "panels/command_panel.h"
#include "panels/plot_panel.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

constexpr int margin = 12;                         // pixels
constexpr int scaleRight = 210, scaleHeight = 16;  // pixels: the scale bar keeps its corner
constexpr int mostCovered = 4;                     // a fourth of the view
constexpr double mostOfPlace = 0.04;               // a corner in which nobody plays

}  // namespace

FirstSteps::FirstSteps(const WindowFrame& frame, FieldView& field, PlotPanel& plots, CommandPanel& command)
    : QFrame(&field), frame_(frame), field_(field), plots_(plots), button_(new QToolButton(&field)) {
    setObjectName("first_steps");
    hide();
    button_->hide();
    button_->setObjectName("first_steps_button");
    button_->setText(tr("What to try"));
    button_->setToolTip(tr("Opens the list over the field; a click on it folds it again"));
    button_->setFocusPolicy(Qt::NoFocus);
    connect(button_, &QToolButton::clicked, this, [this] {
        opened_ = true;
        place();
    });
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
        return frame_.actions[action].shortcut().toString(QKeySequence::NativeText);
    };
    add({key("play"), tr("stops, and goes on")}, {"play"});
    add({tr("%1, %2").arg(key("tick_back"), key("tick_forward")), tr("a tick back, a tick on")},
        {"tick_back", "tick_forward"});
    add({key("cause_of_kick"), tr("the decision behind the last kick")}, {});
    const std::size_t kick = steps_.size() - 1;
    add({key("change_command"), tr("another command there: a branch")}, {});
    const std::size_t commanded = steps_.size() - 1;
    add({tr("Drag a robot"), tr("a branch; its knob turns it")}, {});
    const std::size_t branch = steps_.size() - 1;
    add({key("side_by_side"), tr("both branches side by side")}, {});
    const std::size_t both = steps_.size() - 1;
    add({tr("Click a number"), tr("in the inspector, to plot it")}, {});
    const std::size_t plot = steps_.size() - 1;
    connect(&plots_, &PlotPanel::changed, this, [this, plot] {
        if (!plots_.keys().empty()) tick(plot);
    });
    add({key("open_log"), tr("a log of real robots, if you have one")}, {"open_log"});
    add({key("undo"), tr("takes the last branch back")}, {});
    const std::size_t undo = steps_.size() - 1;
    add({key("shortcuts"), tr("shows all keys")}, {"shortcuts"});
    connect(&command, &CommandPanel::branchRequested, this, [this, commanded] { tick(commanded); });
    connect(&frame_.session, &Session::shown, this, [this, branch, kick, undo] {
        if (frame_.shown()->subject) tick(kick);
        const bool undone = frame_.shown()->canRedo;
        if (undone && !couldRedo_) tick(undo);
        couldRedo_ = undone;
        if (wanted_) place();
        const std::vector<BranchInfo>& branches = frame_.shown()->branches;
        const bool begun = branches.size() > std::exchange(branches_, branches.size());
        if (begun && (branches.back().name.ends_with("moved") || branches.back().name.ends_with("turned")))
            tick(branch);
    });
    connect(&frame_.actions["side_by_side"], &QAction::triggered, this, [this, both] {
        if (frame_.actions["side_by_side"].isChecked()) tick(both);
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
        connect(&frame_.actions[name], &QAction::triggered, this, [this, index] { tick(index); });
}

void FirstSteps::tick(std::size_t step) {
    steps_[step].done = true;
    marks_[step]->setText(QString::fromUtf8("\u2713"));
    marks_[step]->setForegroundRole(QPalette::Link);
}

QRect FirstSteps::corner(const QSize& size) const {
    const QSize all = parentWidget()->size(), fits = size.boundedTo(all);
    return {QPoint(all.width() - fits.width() - margin, all.height() - fits.height() - margin), fits};
}

/// The field is never made smaller for it.
void FirstSteps::place() {
    const QRect card = corner(sizeHint());
    QRect small = corner(button_->sizeHint());
    if (small.left() < scaleRight) small.translate(0, -scaleHeight);
    field_.viewport().setCovered(wanted_ ? QRectF(card) : QRectF());
    const QSize room = parentWidget()->size(), needed = sizeHint() + QSize(2 * margin, 2 * margin);
    const bool fits = needed.width() <= room.width() && needed.height() <= room.height();
    const QRectF place = field_.viewport().fittedPlace(), common = place & QRectF(card);
    const bool hides = mostCovered * card.width() * card.height() > room.width() * room.height() ||
                       common.width() * common.height() > mostOfPlace * place.width() * place.height();
    const bool fold = wanted_ && (!fits || (!opened_ && hides));
    setGeometry(card);
    button_->setGeometry(small);
    if (isHidden() == (wanted_ && !fold)) raise();
    QFrame::setVisible(wanted_ && !fold);
    button_->setVisible(wanted_ && fold);
    if (fold) field_.viewport().setCovered(small);
}

bool FirstSteps::folded() const { return !button_->isHidden(); }

void FirstSteps::setVisible(bool visible) {
    wanted_ = visible;
    opened_ = false;
    place();
}

bool FirstSteps::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize && wanted_) {
        opened_ = false;
        place();
    }
    return QFrame::eventFilter(watched, event);
}

void FirstSteps::mousePressEvent(QMouseEvent* /*event*/) {
    opened_ = false;
    place();
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
