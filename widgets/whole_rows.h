#pragma once

#include <QTreeView>

namespace mrose {

/// A tree that shows whole rows only: one that does not fit in at the lower end is scrolled to.
template <class View>
class WholeRows : public View {
public:
    using View::View;
    QModelIndex indexAt(const QPoint& point) const override {
        const QModelIndex index = View::indexAt(point);
        return fits(View::visualRect(index)) ? index : QModelIndex();
    }

protected:
    void drawRow(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        if (fits(option.rect)) View::drawRow(painter, option, index);
    }

private:
    /// One that is higher than all of the room is seen in part.
    bool fits(const QRect& row) const { return row.top() <= 0 || row.bottom() < View::viewport()->height(); }
};

}  // namespace mrose
