#include "panels/command_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>
#include <cmath>

#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

QDoubleSpinBox* numberBox(double most, double step, int digits, const QString& unit, const QString& name) {
    auto* box = new QDoubleSpinBox;
    box->setRange(-most, most);
    box->setSingleStep(step);
    box->setDecimals(digits);
    box->setSuffix(unit);
    box->setAccessibleName(name);
    return box;
}

}  // namespace

CommandPanel::CommandPanel(QWidget* parent)
    : QWidget(parent),
      what_(new QLabel),
      v_(numberBox(20, 0.1, 3, tr(" m/s"), tr("Forward speed"))),
      w_(numberBox(40, 0.1, 3, tr(" rad/s"), tr("Turning, counter-clockwise"))),
      power_(numberBox(100, 10, 0, " %", tr("Power of the kick"))),
      kick_(new QComboBox),
      periods_(new QSpinBox),
      apply_(new QPushButton(tr("Try this instead"))) {
    power_->setMinimum(0);
    periods_->setRange(1, 100'000);
    periods_->setAccessibleName(tr("Control periods"));
    kick_->setAccessibleName(tr("Kick"));
    kick_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    auto* layout = new QVBoxLayout(this);
    what_->setWordWrap(true);
    what_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    layout->addWidget(what_);
    auto* form = new QFormLayout;
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->addRow(tr("Forward"), v_);
    form->addRow(tr("Turning"), w_);
    auto* kick = new QHBoxLayout;
    kick->addWidget(kick_, 1);
    kick->addWidget(power_);
    form->addRow(tr("Kick"), kick);
    form->addRow(tr("for"), periods_);
    layout->addLayout(form);
    apply_->setToolTip(
        tr("Begins a branch at that decision, with this command in its place (Return in a field, or Ctrl+Return)"));
    layout->addWidget(apply_);
    layout->addStretch();
    connect(apply_, &QPushButton::clicked, this, &CommandPanel::apply);
    for (QAbstractSpinBox* box : {static_cast<QAbstractSpinBox*>(v_), static_cast<QAbstractSpinBox*>(w_),
                                  static_cast<QAbstractSpinBox*>(power_), static_cast<QAbstractSpinBox*>(periods_)})
        connect(box->findChild<QLineEdit*>(), &QLineEdit::returnPressed, this, &CommandPanel::apply);
    kick_->installEventFilter(this);
    connect(kick_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
            [this](int index) { power_->setEnabled(index > 0); });
    connect(periods_, QOverload<int>::of(&QSpinBox::valueChanged), this,
            [this](int count) { periods_->setSuffix(count == 1 ? tr(" control period") : tr(" control periods")); });
    periods_->setSuffix(tr(" control period"));
    refresh();
}

const RobotInsight* CommandPanel::decision() const {
    if (!shown_.frame || !body_ || *body_ >= shown_.frame->insights.size()) return nullptr;
    const RobotInsight& insight = shown_.frame->insights[*body_];
    return insight.tick >= 0 ? &insight : nullptr;
}

void CommandPanel::setShown(const Shown& shown) {
    shown_ = shown;
    refresh();
}

void CommandPanel::setRobot(std::optional<std::size_t> body) {
    body_ = body;
    refresh();
}

void CommandPanel::refresh() {
    const RobotInsight* decided = decision();
    const bool possible = decided != nullptr && !shown_.playing;
    for (QWidget* widget : {static_cast<QWidget*>(v_), static_cast<QWidget*>(w_), static_cast<QWidget*>(kick_),
                            static_cast<QWidget*>(periods_), static_cast<QWidget*>(apply_)})
        widget->setEnabled(possible);
    power_->setEnabled(possible && kick_->currentIndex() > 0);
    if (decided == nullptr) {
        for (QDoubleSpinBox* box : {v_, w_}) box->setValue(0);
        filledFrom_ = -2;
        const bool robot = shown_.frame && body_ && *body_ < shown_.frame->insights.size();
        what_->setText(robot ? tr("This robot has not decided anything yet: go on by a control period.")
                             : tr("Select a robot to change what it decided."));
        return;
    }
    const FieldFrame& frame = *shown_.frame;
    QString what =
        tr("<b>%1</b> decided at %2")
            .arg(qtText(frame.nameOf(*body_)).toHtmlEscaped(), clockText(frame.scene().timeOf(decided->tick)));
    for (const BranchRecord::FirstFault& fault : shown_.faults)
        if (fault.robot == *body_)
            what += tr("; its controller failed at %1").arg(clockText(frame.scene().timeOf(fault.tick)));
    what_->setText(what);
    if (filledFrom_ != decided->tick || filledFor_ != body_) fill();
}

/// Typed values stay until another decision is shown.
void CommandPanel::fill() {
    const RobotInsight& decided = *decision();
    const FieldFrame& frame = *shown_.frame;
    filledFrom_ = decided.tick;
    filledFor_ = body_;
    const Command command = decidedCommand(frame, *body_);
    v_->setValue(command.v);
    w_->setValue(command.w);
    kick_->clear();
    kick_->addItem(tr("none"));
    for (const Manipulator& manipulator : frame.scene().typeOf(*body_).manipulators)
        kick_->addItem(qtText(manipulator.name));
    const std::vector<Kick>& kicks = decided.decision.kicks;
    power_->setValue(kicks.empty() ? 100 : 100 * kicks.front().power);
    kick_->setCurrentIndex(kicks.empty() ? 0 : static_cast<int>(kicks.front().manipulator) + 1);
    periods_->setValue(1);
}

QString CommandPanel::missing() const {
    const bool robot = shown_.frame && body_ && *body_ < shown_.frame->insights.size();
    if (!robot) return tr("Select a robot first: click one, then change what it decided");
    if (decision() == nullptr) return tr("This robot has not decided anything yet: go on by a control period");
    return {};
}

QString CommandPanel::edit() {
    if (QString what = missing(); !what.isEmpty()) return what;
    v_->setFocus(Qt::ShortcutFocusReason);
    v_->selectAll();
    return {};
}

void CommandPanel::takeBack() {
    if (decision() != nullptr) fill();
}

/// A list of choices takes no Return itself.
bool CommandPanel::eventFilter(QObject* watched, QEvent* event) {
    if (watched != kick_ || event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key != Qt::Key_Return && key != Qt::Key_Enter) return false;
    apply();
    return true;
}

QString CommandPanel::apply() {
    if (QString what = missing(); !what.isEmpty() || shown_.playing) return what;
    const RobotInsight* decided = decision();
    for (QDoubleSpinBox* box : {v_, w_, power_}) box->interpretText();
    periods_->interpretText();
    const FieldFrame& frame = *shown_.frame;
    OtherDecision other{{v_->value(), w_->value()}, decided->decision.kicks, periods_->value()};
    // What was not typed over keeps all its digits.
    const Command before = decidedCommand(frame, *body_);
    if (std::abs(v_->value() - before.v) < 0.5e-3) other.command.v = before.v;
    if (std::abs(w_->value() - before.w) < 0.5e-3) other.command.w = before.w;
    const int kickBefore = other.kicks.empty() ? 0 : static_cast<int>(other.kicks.front().manipulator) + 1;
    const bool sameKick = kick_->currentIndex() == kickBefore &&
                          (other.kicks.empty() || std::abs(power_->value() - 100 * other.kicks.front().power) <= 0.5);
    if (!sameKick) other.kicks.clear();
    if (!sameKick && kick_->currentIndex() > 0)
        other.kicks.push_back({static_cast<std::uint32_t>(kick_->currentIndex() - 1), power_->value() / 100});
    emit branchRequested(changeDecision(frame, *body_, other));
    return {};
}

}  // namespace mrose::gui
