#include "reality/rollout_comparer.h"

#include <algorithm>
#include <utility>

#include "widgets/qt_text.h"

namespace mrose::gui {

void RolloutComparer::compareAll() {
    computing_.drop();
    rollouts_.forgetRows();
    share_ = 0;
    error_.clear();
    emit begun();
    const auto take = [this](std::vector<RolloutRow> rows, double share) {
        share_ = std::min(share, 0.999);
        rollouts_.addRows(rows);
        emit grown();
    };
    computing_.run(
        [&queue = computing_, take, log = rollouts_.log(), requests = rollouts_.requests(),
         bounds = rollouts_.divergenceOptions()](const GoesOn& goesOn) {
            return compareRollouts(*log, requests, bounds, [&](std::vector<RolloutRow> rows, double share) {
                queue.report([take, rows = std::move(rows), share] { take(rows, share); });
                return goesOn();
            });
        },
        [this](Expected<Comparison> compared) {
            share_ = 1;
            if (!compared) {
                error_ = qtText(compared.error().message());
                emit ended(tl::unexpected(compared.error()));
                return;
            }
            const ComparedSummary all = compared->all;
            rollouts_.setComparison(std::move(*compared));
            emit ended(all);
        });
}

void RolloutComparer::cancel() {
    if (share_ < 1) error_ = tr("Cancelled: not all rollouts are compared");
    share_ = 1;
}

}  // namespace mrose::gui
