#include "panels/curve_list.h"

#include <QContextMenuEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "widgets/fixed_text.h"

namespace mrose::gui {
namespace {

constexpr int sampleWidth = 18, sampleHeight = 12, numberRoom = 8;  // pixels

QPixmap sampleOf(QPen pen, double ratio) {
    constexpr double leastWidth = 2.4;
    QPixmap sample(QSize(sampleWidth, sampleHeight) * ratio);
    sample.setDevicePixelRatio(ratio);
    sample.fill(Qt::transparent);
    QPainter painter(&sample);
    pen.setWidthF(std::max(leastWidth, pen.widthF()));
    pen.setCapStyle(Qt::FlatCap);
    painter.setPen(pen);
    painter.drawLine(QPointF(0, sampleHeight / 2.0), QPointF(sampleWidth - 2, sampleHeight / 2.0));
    return sample;
}

}  // namespace

CurveList::CurveList(const QFont& font) {
    setColumnCount(3);
    setHeaderHidden(true);
    setRootIsDecorated(false);
    setUniformRowHeights(true);
    setFrameShape(QFrame::NoFrame);
    setFont(font);
    setAccessibleName(tr("Curves"));
    header()->setStretchLastSection(false);
    header()->setMinimumSectionSize(20);
    header()->setSectionResizeMode(0, QHeaderView::Stretch);
    header()->setSectionResizeMode(1, QHeaderView::Fixed);
    makeRoomFor("00.0");
    header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
    setTextElideMode(Qt::ElideRight);
    setIndentation(0);
    setIconSize({sampleWidth, sampleHeight});
}

void CurveList::setLines(const std::vector<Line>& lines, const Theme& theme) {
    std::vector<const Line*> shown;  // of each item; the first of a group twice
    lines_.clear();
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!lines[i].group.isEmpty() && (i == 0 || lines[i - 1].group != lines[i].group)) {
            lines_.push_back(std::nullopt);
            shown.push_back(&lines[i]);
        }
        lines_.push_back(lines[i].number);
        shown.push_back(&lines[i]);
    }
    units_.clear();
    setColumnHidden(2, std::all_of(lines.begin(), lines.end(), [](const Line& line) { return line.unit.isEmpty(); }));
    const auto count = static_cast<int>(lines_.size());
    while (topLevelItemCount() > count) delete takeTopLevelItem(topLevelItemCount() - 1);
    for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const bool isName = !lines_[at];
        const Line& line = *shown[at];
        QTreeWidgetItem* item = topLevelItem(i);
        if (item == nullptr) item = new QTreeWidgetItem(this);
        item->setFirstColumnSpanned(isName);
        item->setIcon(0, isName ? QIcon() : sampleOf(line.pen, devicePixelRatioF()));
        item->setText(0, isName ? line.group : line.label);
        item->setForeground(0, isName ? theme.quietText : theme.text);
        item->setToolTip(0, isName ? line.group : line.tip);
        item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
        if (isName || !line.counts) item->setText(1, {});
        units_.push_back(isName ? QString() : line.unit);
        item->setText(2, units_.back());
        item->setForeground(2, theme.quietText);
    }
}

void CurveList::setNumber(int line, double number, int decimals) {
    const auto found = std::find(lines_.begin(), lines_.end(), std::optional(line));
    if (found == lines_.end()) return;
    const auto at = found - lines_.begin();
    QTreeWidgetItem* item = topLevelItem(static_cast<int>(at));
    item->setText(1, fixedText(number, decimals));
    // Nothing has no unit.
    item->setText(2, std::isfinite(number) ? units_[static_cast<std::size_t>(at)] : QString());
    makeRoomFor(item->text(1));
}

void CurveList::makeRoomFor(const QString& number) {
    numberWidth_ = std::max(numberWidth_, fontMetrics().horizontalAdvance(number) + numberRoom);
    if (columnWidth(1) != numberWidth_) setColumnWidth(1, numberWidth_);
}

std::optional<int> CurveList::lineOf(QTreeWidgetItem* item) const {
    const int at = indexOfTopLevelItem(item);
    return at < 0 ? std::nullopt : lines_[static_cast<std::size_t>(at)];
}

void CurveList::keyPressEvent(QKeyEvent* event) {
    const auto line = lineOf(currentItem());
    const bool removes = event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace;
    if (!removes || !line) return QTreeWidget::keyPressEvent(event);
    emit removalWanted(*line);
}

void CurveList::contextMenuEvent(QContextMenuEvent* event) {
    QMenu menu(this);
    if (const auto line = lineOf(itemAt(event->pos())))
        menu.addAction(tr("&Remove"), this, [this, line] { emit removalWanted(*line); });
    menu.addAction(tr("Remove &all"), this, &CurveList::clearWanted);
    menu.exec(event->globalPos());
}

}  // namespace mrose::gui
