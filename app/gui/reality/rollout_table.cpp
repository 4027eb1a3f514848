#include "reality/rollout_table.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <algorithm>

namespace mrose::gui {
namespace {

constexpr int widestName = 84;         // pixels: tool tips show longer ones
constexpr int leastRows = 6;           // of the list
constexpr int leastListWidth = 240;    // pixels
constexpr int beside = 7, arrow = 24;  // pixels beside a title; that it is sorted by has an arrow
/// What is left out first.
constexpr RolloutList::Column lessImportant[] = {RolloutList::heading, RolloutList::path, RolloutList::drives,
                                                 RolloutList::leaves};

}  // namespace

RolloutTable::RolloutTable(RolloutList& rollouts) : rollouts_(rollouts) {
    setModel(&rollouts_);
    setObjectName("rollouts");
    setAccessibleName(tr("Rollouts, by their errors"));
    setRootIsDecorated(false);
    setUniformRowHeights(true);
    setAllColumnsShowFocus(true);
    setFrameShape(QFrame::NoFrame);
    setSortingEnabled(true);
    sortByColumn(RolloutList::error, Qt::DescendingOrder);
    header()->setStretchLastSection(true);
    header()->setMinimumSectionSize(20);
    setMinimumWidth(leastListWidth);
    setMinimumHeight(header()->sizeHint().height() + leastRows * (fontMetrics().height() + 2));
    setIndentation(0);
}

/// Rows come in the order of their rollouts: those that were there before are measured already.
void RolloutTable::fitColumns(const LogRollouts& rollouts) {
    const std::vector<RolloutRow>& rows = rollouts.rows();
    const QFontMetrics metrics = fontMetrics();
    if (fitted_ == 0 || rows.size() < fitted_) {
        fitted_ = 0;
        const std::size_t sessions = rollouts.log() ? rollouts.world().sessions().size() : 1;
        useless_[RolloutList::session] = sessions == 1;
        useless_[RolloutList::robot] = sessions > 1 && rollouts.world().robots().size() == 1;
    }
    for (int column = 0; column < RolloutList::columns; ++column) {
        int& wide = widths_[static_cast<std::size_t>(column)];
        if (fitted_ == 0)
            wide = metrics.size(0, rollouts_.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString()).width();
        for (std::size_t row = fitted_; row < rows.size(); ++row)
            wide = std::max(wide, metrics.horizontalAdvance(rollouts_.text(rows[row], column)));
        if (RolloutList::isName(column)) wide = std::min(wide, widestName);
        setColumnWidth(column, wide + (column == RolloutList::error ? arrow : beside));
    }
    fitted_ = rows.size();
    showWhatFits();
}

void RolloutTable::showWhatFits() {
    std::array<bool, RolloutList::columns> hidden = useless_;
    int tooMuch = -viewport()->width();
    for (std::size_t column = 0; column < hidden.size(); ++column)
        if (!hidden[column]) tooMuch += widths_[column] + (column == RolloutList::error ? arrow : beside);
    for (const RolloutList::Column column : lessImportant) {
        if (tooMuch <= 0) break;
        hidden[column] = true;
        tooMuch -= widths_[column] + beside;
    }
    for (int column = 0; column < RolloutList::columns; ++column)
        setColumnHidden(column, hidden[static_cast<std::size_t>(column)]);
}

void RolloutTable::resizeEvent(QResizeEvent* event) {
    const QRect before = visualRect(currentIndex());
    const bool seen = before.isValid() && before.top() < event->oldSize().height() && before.bottom() >= 0;
    showWhatFits();
    WholeRows::resizeEvent(event);
    if (seen && hasAutoScroll()) scrollTo(currentIndex());
}

void RolloutTable::keyPressEvent(QKeyEvent* event) {
    const QModelIndex before = currentIndex();
    setAutoScroll(true);
    WholeRows::keyPressEvent(event);
    if (currentIndex().isValid() && currentIndex().row() != before.row()) emit activated(currentIndex());
}

}  // namespace mrose::gui
