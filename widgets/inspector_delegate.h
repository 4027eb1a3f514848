#pragma once

#include <QStyledItemDelegate>
#include <QTreeView>

#include "widgets/theme.h"

namespace mrose {

/// Draws the inspector's values: numbers end where their units begin, all at one place, and a mark at the right end
/// says what can be plotted, in its colour what is.
class InspectorDelegate final : public QStyledItemDelegate {
    Q_OBJECT

public:
    enum Column { nameColumn, valueColumn, plotColumn };
    enum Role { unitRole = Qt::UserRole, keyRole, pathRole, plottableRole, plottedRole, headRole, cellsRole };

    static constexpr int markWidth = 24;

    using QStyledItemDelegate::QStyledItemDelegate;
    void setTheme(const Theme& theme) { theme_ = theme; }

    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
    /// How wide a name's column must be for it, pixels.
    static int nameWidth(const QTreeView& tree, const QModelIndex& index);

protected:
    void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override;

private:
    /// Words that do not fit take a second line.
    bool takesTwoLines(const QFontMetrics& metrics, int columnWidth, const QModelIndex& index) const;
    bool nameTakesTwoLines(const QStyleOptionViewItem& option, const QModelIndex& index) const;
    void paintValue(QPainter& painter, const QStyleOptionViewItem& option, const QModelIndex& index) const;
    void paintCells(QPainter& painter, const QStyleOptionViewItem& option, const QModelIndex& index) const;
    void paintMark(QPainter& painter, const QRect& box, const QModelIndex& index) const;

    Theme theme_ = Theme::light();
};

}  // namespace mrose
