#include "reality/rollout_searcher.h"

#include <utility>

namespace mrose::gui {

void RolloutSearcher::wish(const BreakWish& wish) {
    stop();
    wish_ = wish;
}

void RolloutSearcher::stop() {
    wish_.reset();
    if (!searching_.busy()) return;
    searching_.drop();
    emit searching({}, 1);
}

void RolloutSearcher::look(std::vector<Breakpoint> breakpoints,
                           std::function<void(Expected<std::optional<std::size_t>>)> take) {
    const RolloutSearch search =
        rollouts_.searchOthers(*std::exchange(wish_, std::nullopt), std::move(breakpoints), hits_);
    if (search.places.empty()) return take(std::optional<std::size_t>());
    const QString what = tr("Looking for a break in the other rollouts");
    const auto report = [this, what](double share) { emit searching(what, share); };
    searching_.run([&queue = searching_, log = rollouts_.log(), search, report](
                       const GoesOn& goesOn) { return rolloutWithBreak(*log, search, queue.progress(goesOn, report)); },
                   [this, what, take = std::move(take)](const Expected<RolloutFound>& found) {
                       emit searching(what, 1);
                       if (!found) return take(tl::unexpected(found.error()));
                       hits_ = found->hits;
                       take(found->rollout);
                   });
}

}  // namespace mrose::gui
