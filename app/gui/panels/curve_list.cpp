#include "panels/curve_list.h"

#include <QHeaderView>
#include <QPainter>

#include "widgets/value_catalogue.h"

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
    header()->resizeSection(1, QFontMetrics(font).horizontalAdvance("00.0") + numberRoom);
    header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
    setTextElideMode(Qt::ElideMiddle);
    setIndentation(0);
    setIconSize({sampleWidth, sampleHeight});
    setContextMenuPolicy(Qt::CustomContextMenu);
}

void CurveList::setLines(const std::vector<Line>& lines, const Theme& theme) {
    const auto count = static_cast<int>(lines.size());
    while (topLevelItemCount() > count) delete takeTopLevelItem(topLevelItemCount() - 1);
    for (int i = 0; i < count; ++i) {
        const Line& line = lines[static_cast<std::size_t>(i)];
        QTreeWidgetItem* item = topLevelItem(i);
        if (item == nullptr) item = new QTreeWidgetItem(this);
        item->setIcon(0, sampleOf(line.pen, devicePixelRatioF()));
        item->setText(0, line.label);
        item->setToolTip(0, line.tip);
        item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
        item->setText(2, line.unit);
        item->setForeground(2, theme.quietText);
    }
}

void CurveList::setNumber(int line, double number, int decimals) {
    QTreeWidgetItem* item = topLevelItem(line);
    if (item == nullptr) return;
    item->setText(1, fixedText(number, decimals));
    const int needed = fontMetrics().horizontalAdvance(item->text(1)) + numberRoom;
    if (needed > columnWidth(1)) setColumnWidth(1, needed);
}

}  // namespace mrose::gui
