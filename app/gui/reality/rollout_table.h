#pragma once

#include <array>

#include "reality/rollout_list.h"
#include "widgets/whole_rows.h"

namespace mrose::gui {

/// Rollouts that are walked through by keys are all seen. The current one stays in sight where room is taken, if it was
/// picked: then the list scrolls by itself. Where not all columns have room, the less important ones are left out.
class RolloutTable final : public WholeRows<QTreeView> {
public:
    explicit RolloutTable(RolloutList& rollouts);

    /// Columns as wide as their titles and what they show of these.
    void fitColumns(const LogRollouts& rollouts);

protected:
    void resizeEvent(QResizeEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    void showWhatFits();

    RolloutList& rollouts_;
    std::size_t fitted_ = 0;                            ///< rows that the columns are wide enough for
    std::array<int, RolloutList::columns> widths_{};    ///< pixels: of what they show
    std::array<bool, RolloutList::columns> useless_{};  ///< the same in all rows
};

}  // namespace mrose::gui
