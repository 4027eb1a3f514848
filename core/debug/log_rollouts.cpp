#include "debug/log_rollouts.h"

#include <algorithm>

namespace mrose {

void LogRollouts::replace(PlayedLogPointer log, const RolloutPlan& plan, std::vector<RolloutRequest> requests) {
    const bool other = log != log_;
    log_ = std::move(log);
    plan_ = plan;
    requests_ = std::move(requests);
    if (other && log_) bound_.fromNetwork = bound_.fromNetwork && boundSource(world()) != BoundSource::constant;
    shown_.reset();
    forgetRows();
}

void LogRollouts::forgetRows() {
    rows_.clear();
    comparison_ = nullptr;
    changed();
}

void LogRollouts::addRows(std::span<const RolloutRow> rows) {
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    changed();
}

void LogRollouts::setComparison(Comparison comparison) {
    comparison_ = std::make_shared<const Comparison>(std::move(comparison));
}

void LogRollouts::setBound(const Bound& bound) {
    bound_ = bound;
    if (!comparison_) return;
    judgeRows(rows_, comparison_->rollouts, divergenceOptions());
    changed();
}

DivergenceOptions LogRollouts::divergenceOptions() const {
    DivergenceOptions options;
    options.bound.constant = bound_.at;
    options.fromNetwork = bound_.fromNetwork;
    return options;
}

const RolloutRow* LogRollouts::rowOf(std::size_t rollout, std::size_t robot) const {
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), std::pair(rollout, robot),
                                        [](const RolloutRow& row, const std::pair<std::size_t, std::size_t>& of) {
                                            return std::pair(row.rollout, row.robot) < of;
                                        });
    return found != rows_.end() && found->rollout == rollout && found->robot == robot ? &*found : nullptr;
}

std::span<const RolloutRow> LogRollouts::rowsOf(std::size_t rollout) const {
    const auto [begin, end] =
        std::equal_range(rows_.begin(), rows_.end(), RolloutRow{rollout},
                         [](const RolloutRow& a, const RolloutRow& b) { return a.rollout < b.rollout; });
    return {begin, end};
}

std::optional<std::size_t> LogRollouts::robot() const {
    if (!shown_) return {};
    if (robot_ && rowOf(*shown_, *robot_) != nullptr) return robot_;
    const auto rows = rowsOf(*shown_);
    // Unknown numbers are below all others.
    const auto worst = std::max_element(
        rows.begin(), rows.end(), [](const RolloutRow& a, const RolloutRow& b) { return a.position < b.position; });
    return worst != rows.end() ? std::optional(worst->robot) : std::nullopt;
}

const RolloutRow* LogRollouts::shownRow() const {
    const auto asked = robot();
    return asked ? rowOf(*shown_, *asked) : nullptr;
}

const RolloutRow* LogRollouts::leavingRow() const {
    const RolloutRow* const asked = shownRow();
    if (!shown_ || (asked != nullptr && asked->divergence)) return asked;
    const auto rows = rowsOf(*shown_);
    const auto first = std::min_element(rows.begin(), rows.end(), [](const RolloutRow& a, const RolloutRow& b) {
        return a.divergence && (!b.divergence || a.divergence->time < b.divergence->time);
    });
    return first != rows.end() && first->divergence ? &*first : nullptr;
}

const RolloutRow* LogRollouts::leavingAt(const std::function<bool(Nanoseconds time)>& isThen) const {
    if (!shown_) return nullptr;
    const auto leaves = [&](const RolloutRow& row) { return row.divergence && isThen(row.divergence->time); };
    if (const RolloutRow* const asked = shownRow(); asked != nullptr && leaves(*asked)) return asked;
    const auto rows = rowsOf(*shown_);
    const auto leaving = std::find_if(rows.begin(), rows.end(), leaves);
    return leaving != rows.end() ? &*leaving : nullptr;
}

const RolloutRow* LogRollouts::worstLeft() const {
    const RolloutRow* worst = nullptr;
    for (const RolloutRow& row : rows_)
        if (row.divergence && (worst == nullptr || row.position > worst->position)) worst = &row;
    return worst;
}

std::optional<std::size_t> LogRollouts::nextLeft() const {
    for (std::size_t i = 1; shown_ && i < requests_.size(); ++i) {
        const std::size_t rollout = (*shown_ + i) % requests_.size();
        const auto rows = rowsOf(rollout);
        if (std::any_of(rows.begin(), rows.end(), [](const RolloutRow& row) { return row.divergence.has_value(); }))
            return rollout;
    }
    return {};
}

RolloutSearch LogRollouts::searchOthers(const BreakWish& wish, std::vector<Breakpoint> breakpoints,
                                        const RolloutHits& hits) const {
    RolloutSearch search{wish, std::move(breakpoints), hits, {}};
    const std::size_t others = !shown_ ? 0 : wish.back ? *shown_ : requests_.size() - 1 - *shown_;
    for (std::size_t i = 1; i <= others; ++i) {
        const std::size_t rollout = wish.back ? *shown_ - i : *shown_ + i;
        search.places.push_back({rollout, requests_[rollout], leavesReality(leavingRobots(world(), rowsOf(rollout)))});
    }
    return search;
}

}  // namespace mrose
