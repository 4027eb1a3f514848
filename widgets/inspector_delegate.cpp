#include "widgets/inspector_delegate.h"

#include <QApplication>
#include <QPainter>
#include <QTreeView>

namespace mrose {

QSize InspectorDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
    const int more = index.siblingAtColumn(nameColumn).data(headRole).toBool() ? 8 : 3;
    const auto* tree = qobject_cast<const QTreeView*>(option.widget);
    const bool two =
        tree != nullptr &&
        ((index.column() == valueColumn && takesTwoLines(option.fontMetrics, tree->columnWidth(valueColumn), index)) ||
         (index.column() == nameColumn && nameTakesTwoLines(option, index)));
    return {QStyledItemDelegate::sizeHint(option, index).width(), (two ? 2 : 1) * option.fontMetrics.height() + more};
}

namespace {

/// Where there is no mark, there is room for more words.
int wordRoom(int columnWidth, const QModelIndex& index) {
    const bool mark =
        index.siblingAtColumn(InspectorDelegate::plotColumn).data(InspectorDelegate::plottableRole).toBool();
    return columnWidth - 4 + (mark ? 0 : InspectorDelegate::markWidth - 4);
}

bool isNumber(const QModelIndex& index) {
    const QString value = index.data(Qt::DisplayRole).toString();
    bool numeric = false;
    value.toDouble(&numeric);
    return numeric || value == QString::fromUtf8("\u2013") ||
           index.siblingAtColumn(InspectorDelegate::plotColumn).data(InspectorDelegate::plottableRole).toBool();
}

}  // namespace

bool InspectorDelegate::takesTwoLines(const QFontMetrics& metrics, int columnWidth, const QModelIndex& index) const {
    const QString value = index.data(Qt::DisplayRole).toString();
    return !isNumber(index) && metrics.horizontalAdvance(value) > wordRoom(columnWidth, index);
}

int InspectorDelegate::nameWidth(const QTreeView& tree, const QModelIndex& index) {
    constexpr int margins = 8;
    int depth = 1;
    for (QModelIndex above = index.parent(); above.isValid(); above = above.parent()) ++depth;
    QFont font = tree.font();
    if (const QVariant own = index.data(Qt::FontRole); own.isValid()) font = own.value<QFont>();
    return depth * tree.indentation() + margins +
           QFontMetrics(font).horizontalAdvance(index.data(Qt::DisplayRole).toString());
}

bool InspectorDelegate::nameTakesTwoLines(const QStyleOptionViewItem& option, const QModelIndex& index) const {
    const auto* tree = qobject_cast<const QTreeView*>(option.widget);
    return tree != nullptr && !tree->isFirstColumnSpanned(index.row(), index.parent()) &&
           nameWidth(*tree, index) > tree->columnWidth(nameColumn);
}

/// A name of several words is broken between them.
void InspectorDelegate::initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const {
    QStyledItemDelegate::initStyleOption(option, index);
    if (index.column() != nameColumn || !nameTakesTwoLines(*option, index)) return;
    option->features |= QStyleOptionViewItem::WrapText;
    option->text.replace('_', QString::fromUtf8("_\u200b"));
}

void InspectorDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
    const bool cells = !index.data(cellsRole).toStringList().isEmpty();
    if (index.column() == nameColumn && !cells) {
        QStyledItemDelegate::paint(painter, option, index);
        return;
    }
    QStyleOptionViewItem bare = option;
    initStyleOption(&bare, index);
    bare.text.clear();
    QApplication::style()->drawControl(QStyle::CE_ItemViewItem, &bare, painter, bare.widget);
    painter->save();
    if (cells)
        paintCells(*painter, bare, index);
    else if (index.column() == valueColumn)
        paintValue(*painter, bare, index);
    else
        paintMark(*painter, option.rect, index);
    painter->restore();
}

void InspectorDelegate::paintValue(QPainter& painter, const QStyleOptionViewItem& option,
                                   const QModelIndex& index) const {
    const QString value = index.data(Qt::DisplayRole).toString(), unit = index.data(unitRole).toString();
    const QFontMetrics& metrics = option.fontMetrics;
    const QRect box = option.rect.adjusted(2, 0, -2, 0);
    const bool selected = option.state.testFlag(QStyle::State_Selected);
    const QColor ink = selected ? option.palette.color(QPalette::HighlightedText)
                                : index.data(Qt::ForegroundRole).value<QBrush>().color();
    painter.setFont(option.font);
    painter.setPen(ink);
    if (!isNumber(index)) {
        QRect room = box;
        room.setWidth(wordRoom(option.rect.width(), index));
        const bool two = takesTwoLines(metrics, option.rect.width(), index);
        painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter | (two ? Qt::TextWordWrap : 0), value);
        return;
    }
    const int unitWidth = metrics.horizontalAdvance("rad/s") + 5;
    painter.drawText(box.adjusted(0, 0, -unitWidth, 0), Qt::AlignRight | Qt::AlignVCenter, value);
    if (!selected) painter.setPen(theme_.quietText);
    painter.drawText(QRect(box.right() - unitWidth + 5, box.top(), unitWidth, box.height()),
                     Qt::AlignLeft | Qt::AlignVCenter, unit);
}

/// In columns at the right end, every other one wider; a word that is wider goes on into the empty one before.
void InspectorDelegate::paintCells(QPainter& painter, const QStyleOptionViewItem& option,
                                   const QModelIndex& index) const {
    const QStringList cells = index.data(cellsRole).toStringList();
    const QFontMetrics& metrics = option.fontMetrics;
    const QRect box = option.rect.adjusted(3, 0, -4, 0);
    const bool selected = option.state.testFlag(QStyle::State_Selected);
    const QColor nameInk = index.data(Qt::ForegroundRole).value<QBrush>().color();
    painter.setFont(option.font);
    if (selected) painter.setPen(option.palette.color(QPalette::HighlightedText));
    int right = box.right();
    for (int i = cells.size() - 1; i >= 0; --i) {
        const int width = metrics.horizontalAdvance(i % 2 == 0 ? "0.00" : "-00.0") + 4;
        bool number = false;
        cells[i].toDouble(&number);
        if (!selected) painter.setPen(number ? theme_.text : theme_.quietText);
        painter.drawText(QRect(right - 2 * width, box.top(), 2 * width, box.height()),
                         Qt::AlignRight | Qt::AlignVCenter, cells[i]);
        right -= width;
    }
    if (!selected) painter.setPen(nameInk);
    const int room = right - box.left();
    painter.drawText(QRect(box.left(), box.top(), room, box.height()), Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(index.data().toString(), Qt::ElideRight, room));
}

/// A small curve.
void InspectorDelegate::paintMark(QPainter& painter, const QRect& box, const QModelIndex& index) const {
    if (!index.data(plottableRole).toBool()) return;
    const QColor plotted = index.data(plottedRole).value<QColor>();
    const QPointF middle = QRectF(box).center();
    painter.setRenderHint(QPainter::Antialiasing);
    if (plotted.isValid()) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(plotted);
        painter.drawRoundedRect(QRectF(middle.x() - 8, middle.y() - 6, 16, 12), 3, 3);
    }
    const QColor ink = plotted.isValid() ? (plotted.lightness() > 140 ? Qt::black : Qt::white)
                                         : seenOn(theme_.panel, theme_.line, 2.2);
    painter.setPen(QPen(ink, 1.3));
    painter.drawPolyline(QPolygonF(
        {middle + QPointF(-5, 3), middle + QPointF(-2, -2), middle + QPointF(1, 1), middle + QPointF(5, -4)}));
}

}  // namespace mrose
