#include "panels/curve_list.h"

#include <QContextMenuEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QPainter>
#include <algorithm>

#include "widgets/plot_curve.h"

namespace mrose::gui {
namespace {

constexpr int sampleWidth = 18, sampleHeight = 12, numberRoom = 8;  // pixels

/// The curve's line.
QPixmap sampleOf(const CurveLook& look, double ratio) {
    QPixmap sample(QSize(sampleWidth, sampleHeight) * ratio);
    sample.setDevicePixelRatio(ratio);
    sample.fill(Qt::transparent);
    PlotCurve curve;
    curve.colour = look.colour;
    curve.style = look.style;
    QPen pen = curvePen(curve);
    pen.setWidthF(2.4);
    pen.setCapStyle(Qt::FlatCap);
    QPainter painter(&sample);
    painter.setPen(pen);
    painter.drawLine(QPointF(0, sampleHeight / 2.0), QPointF(sampleWidth - 2, sampleHeight / 2.0));
    return sample;
}

}  // namespace

CurveList::CurveList(QWidget* parent) : QTreeWidget(parent) {
    setColumnCount(3);
    setHeaderHidden(true);
    setRootIsDecorated(false);
    setUniformRowHeights(true);
    setFrameShape(QFrame::NoFrame);
    setAccessibleName(tr("Curves"));
    header()->setStretchLastSection(false);
    header()->setMinimumSectionSize(20);
    header()->setSectionResizeMode(0, QHeaderView::Stretch);
    header()->setSectionResizeMode(1, QHeaderView::Fixed);
    header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
    setTextElideMode(Qt::ElideRight);
    setIndentation(0);
    setIconSize({sampleWidth, sampleHeight});
}

void CurveList::setEntries(const std::vector<Entry>& entries, const Theme& theme) {
    lines_.clear();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const QString& group = entries[i].words.group;
        if (!group.isEmpty() && (i == 0 || entries[i - 1].words.group != group)) lines_.push_back(std::nullopt);
        lines_.push_back(i);
    }
    while (topLevelItemCount() > static_cast<int>(lines_.size())) delete takeTopLevelItem(topLevelItemCount() - 1);
    for (std::size_t line = 0; line < lines_.size(); ++line) {
        QTreeWidgetItem* item = topLevelItem(static_cast<int>(line));
        if (item == nullptr) item = new QTreeWidgetItem(this);
        const bool isName = !lines_[line];
        const Entry& entry = entries[isName ? *lines_[line + 1] : *lines_[line]];
        item->setFirstColumnSpanned(isName);
        item->setIcon(0, isName ? QIcon() : sampleOf(entry.look, devicePixelRatioF()));
        item->setText(0, isName ? entry.words.group : entry.words.inGroup);
        item->setForeground(0, isName ? theme.quietText : theme.text);
        item->setToolTip(0, isName ? entry.words.group : entry.whole);
        item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
        if (isName) item->setText(1, {});
        item->setText(2, isName ? QString() : entry.unit);
        item->setForeground(2, theme.quietText);
    }
    makeRoomFor("00.0");
}

void CurveList::setNumber(std::size_t entry, const QString& number) {
    const auto line = std::find(lines_.begin(), lines_.end(), std::optional(entry));
    if (line == lines_.end()) return;
    topLevelItem(static_cast<int>(line - lines_.begin()))->setText(1, number);
    makeRoomFor(number);
}

/// The column grows with its numbers and stays so: nothing jumps.
void CurveList::makeRoomFor(const QString& number) {
    numberWidth_ = std::max(numberWidth_, fontMetrics().horizontalAdvance(number) + numberRoom);
    if (columnWidth(1) != numberWidth_) setColumnWidth(1, numberWidth_);
}

std::optional<std::size_t> CurveList::entryOf(QTreeWidgetItem* item) const {
    const int line = indexOfTopLevelItem(item);
    return line < 0 ? std::nullopt : lines_[static_cast<std::size_t>(line)];
}

void CurveList::keyPressEvent(QKeyEvent* event) {
    const auto entry = entryOf(currentItem());
    const bool removes = event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace;
    if (!removes || !entry) return QTreeWidget::keyPressEvent(event);
    emit removalWanted(*entry);
}

void CurveList::contextMenuEvent(QContextMenuEvent* event) {
    QMenu menu(this);
    if (const auto entry = entryOf(itemAt(event->pos())))
        menu.addAction(tr("&Remove"), this, [this, entry] { emit removalWanted(*entry); });
    menu.addAction(tr("Remove &all"), this, &CurveList::clearWanted);
    menu.exec(event->globalPos());
}

}  // namespace mrose::gui
