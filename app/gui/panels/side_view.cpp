#include "panels/side_view.h"

#include <QBoxLayout>

#include "widgets/eliding_label.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr QSize leastOfTwo(160, 90);  // pixels

QWidget* pane(ElidingLabel* name, FieldView* field) {
    auto* made = new QWidget;
    auto* layout = new QVBoxLayout(made);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    name->setContentsMargins(10, 4, 10, 4);
    name->hide();
    layout->addWidget(name);
    layout->addWidget(field, 1);
    return made;
}

}  // namespace

SideView::SideView(QWidget* parent)
    : QWidget(parent),
      field_(new FieldView),
      beside_(new FieldView),
      fieldName_(new ElidingLabel),
      besideName_(new ElidingLabel),
      besidePane_(pane(besideName_, beside_)),
      panes_(new QBoxLayout(QBoxLayout::LeftToRight, this)) {
    panes_->setContentsMargins(0, 0, 0, 0);
    panes_->setSpacing(2);
    panes_->addWidget(pane(fieldName_, field_), 1);
    panes_->addWidget(besidePane_, 1);
    besidePane_->hide();
    beside_->setAccessibleName(tr("Field of the branch beside"));
    connect(field_, &FieldView::viewChanged, beside_, &FieldView::setView);
    connect(beside_, &FieldView::viewChanged, field_, &FieldView::setView);
    connect(field_, &FieldView::bodySelected, beside_, &FieldView::setSelected);
    connect(beside_, &FieldView::bodySelected, field_, &FieldView::setSelected);
    // A robot's name does not seem to have gone elsewhere when it alone has not.
    connect(field_, &FieldView::labelsMoved, beside_, &FieldView::followLabels);
    connect(field_, &FieldView::layersChanged, beside_, &FieldView::setLayers);
}

namespace {

/// Of each body where it is in another frame, if it is elsewhere there; nothing to compare: empty.
std::vector<std::optional<Point>> elsewhereIn(const FieldFrame& there, const FieldFrame& here) {
    constexpr double apart = 0.01;  // m
    std::vector<std::optional<Point>> places;
    if (there.state.tick != here.state.tick || there.scene().bodyCount() != here.scene().bodyCount()) return places;
    for (std::size_t body = 0; body < here.scene().bodyCount(); ++body) {
        const Point at = position(there.poseOf(body));
        const bool other = distance(at, position(here.poseOf(body))) > apart;
        places.push_back(other ? std::optional(at) : std::nullopt);
    }
    return places;
}

}  // namespace

void SideView::setSideBySide(bool on) {
    sideBySide_ = on;
    refresh();
}

void SideView::setShown(const Shown& shown) {
    field_->setEditable(!shown.playing);
    field_->setFrame(shown.frame);
    hasBeside_ = shown.beside != nullptr;
    const bool both = hasBeside_ && sideBySide_;
    if (both) beside_->setFrame(shown.beside);
    using Places = std::vector<std::optional<Point>>;
    field_->setElsewhere(both ? elsewhereIn(*shown.beside, *shown.frame) : Places());
    beside_->setElsewhere(both ? elsewhereIn(*shown.frame, *shown.beside) : Places());
    const auto name = [&](std::uint32_t branch) {
        const QString given = qtText(shown.branches[branch].name);
        return given.isEmpty() ? tr("the run") : given;
    };
    fieldName_->setText(name(shown.branch));
    if (shown.besideBranch) {
        const bool there = shown.beside->state.tick == shown.tick();
        const QString at = clockText(shown.beside->scene().timeOf(shown.beside->state.tick));
        besideName_->setText(there ? name(*shown.besideBranch)
                                   : tr("%1 \u2013 at %2, the nearest that it has").arg(name(*shown.besideBranch), at));
    }
    refresh();
}

void SideView::setTheme(const Theme& theme) {
    field_->setTheme(theme);
    beside_->setTheme(theme);
    fieldName_->setStyleSheet("font-weight: bold; color: " + theme.accent.name());
    besideName_->setStyleSheet("font-style: italic; color: " + theme.text.name());
}

void SideView::refresh() {
    const bool both = sideBySide_ && hasBeside_;
    if (besidePane_->isHidden() != both) return;
    // Two of them shall not make the window higher.
    for (FieldView* field : {field_, beside_}) field->setMinimumSize(both ? leastOfTwo : QSize(0, 0));
    besidePane_->setVisible(both);
    fieldName_->setVisible(both);
    besideName_->setVisible(both);
    arrange();
    layout()->activate();
    // Who has looked closer sees the same place in both, and in the one that is left.
    if (both) beside_->setView(field_->transform());
}

void SideView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void SideView::arrange() {
    const int name = fieldName_->sizeHint().height(), gap = panes_->spacing();
    const double across = field_->viewport().fittedScale(QSizeF((width() - gap) / 2.0, height() - name));
    const double down = field_->viewport().fittedScale(QSizeF(width(), (height() - gap) / 2.0 - name));
    panes_->setDirection(across >= down ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
}

}  // namespace mrose::gui
