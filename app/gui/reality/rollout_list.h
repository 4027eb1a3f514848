#pragma once

#include <QAbstractTableModel>
#include <vector>

#include "reality/overlay.h"

namespace mrose::gui {

/// The rollouts of an overlay as a table, a line for each robot in each of them, sorted by any of its columns.
class RolloutList final : public QAbstractTableModel {
    Q_OBJECT

public:
    enum Column { robot, session, start, error, path, heading, leaves, drives, columns };

    /// Whether a column is of names, which others give.
    static bool isName(int column) { return column == robot || column == session; }

    explicit RolloutList(QObject* parent = nullptr);

    void setRows(PlayedLogPointer world, std::vector<RolloutRow> rows);
    const RolloutRow& row(int line) const { return rows_[order_[static_cast<std::size_t>(line)]]; }
    /// What a column shows of a row, wherever that is sorted to.
    QString text(const RolloutRow& row, int column) const;
    /// The line of a robot in a rollout; -1: there is none.
    int lineOf(std::size_t rollout, std::size_t robot) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    void sort(int column, Qt::SortOrder order) override;

private:
    QString tip(const RolloutRow& row) const;
    void arrange();

    PlayedLogPointer world_;
    std::vector<RolloutRow> rows_;
    std::vector<std::size_t> order_;
    int sortedBy_ = error;
    Qt::SortOrder sense_ = Qt::DescendingOrder;
};

}  // namespace mrose::gui
