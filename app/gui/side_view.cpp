#include "side_view.h"

#include <QBoxLayout>
#include <QLabel>
#include <algorithm>

#include "widgets/timeline_bar.h"

namespace mrose::gui {
namespace {

QWidget* pane(QLabel* name, FieldView* field) {
    auto* made = new QWidget;
    auto* layout = new QVBoxLayout(made);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    name->setContentsMargins(10, 4, 10, 4);
    name->setTextFormat(Qt::PlainText);
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
      fieldName_(new QLabel),
      besideName_(new QLabel),
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
    connect(field_, &FieldView::layersChanged, beside_, &FieldView::setLayers);
}

void SideView::setSideBySide(bool on) {
    sideBySide_ = on;
    refresh();
}

void SideView::setShown(const Shown& shown) {
    field_->setEditable(!shown.playing);
    field_->setFrame(shown.frame);
    hasBeside_ = shown.beside != nullptr;
    if (hasBeside_ && sideBySide_) beside_->setFrame(shown.beside);
    const auto name = [&](std::uint32_t branch) {
        const QString& given = shown.branches[branch].name;
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
    besidePane_->setVisible(both);
    fieldName_->setVisible(both);
    besideName_->setVisible(both);
    arrange();
    layout()->activate();
    field_->fit();
}

void SideView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void SideView::arrange() {
    const FieldArea area = field_->wholeArea();
    if (area.empty()) return;
    const Point size = area.most - area.least;
    const auto scale = [&](double across, double down) {
        return std::min(width() / across / size.x, height() / down / size.y);
    };
    panes_->setDirection(scale(2, 1) >= scale(1, 2) ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
}

}  // namespace mrose::gui
