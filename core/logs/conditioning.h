#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "logs/log_reader.h"
#include "logs/robot_log.h"

namespace mrose {

/// Where a stream's clock was set back: the row where time falls behind for good, and the row it falls behind.
struct ClockReset {
    std::size_t row = 0, latestBefore = 0;
    Nanoseconds behind = 0;  ///< how far, at `row`
};

/// Stamps out of order are the business of sorting; time that runs backwards for good is not. It does so where a run of
/// rows that all lie behind an earlier one reaches the end and is at least 10 rows or half of all, or where more than
/// 10 rows of a run and a twentieth of all lie behind by more than 2 s.
std::optional<ClockReset> findClockReset(std::span<const Nanoseconds> times);

template <class Sample>
bool earlier(const Sample& a, const Sample& b) {
    return a.time < b.time;
}

/// Stable; counts the steps backwards.
template <class Sample>
void sortByTime(std::vector<Sample>& samples, LogDefects& defects) {
    std::int64_t outOfOrder = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) outOfOrder += earlier(samples[i], samples[i - 1]);
    if (outOfOrder == 0) return;
    defects.outOfOrder += outOfOrder;
    std::stable_sort(samples.begin(), samples.end(), earlier<Sample>);
}

/// Of sorted samples.
template <class Sample>
void keepLastOfEqualStamps(std::vector<Sample>& samples, LogDefects& defects) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (kept > 0 && samples[kept - 1].time == samples[i].time) --kept;
        if (kept != i) samples[kept] = std::move(samples[i]);
        ++kept;
    }
    defects.duplicates += static_cast<std::int64_t>(samples.size() - kept);
    samples.resize(kept);
}

/// Sorts by time (stable), keeps the last of equal stamps, drops blips if asked to (into `blips`, if it is given), and
/// counts gaps.
void conditionCommands(std::vector<StampedCommand>& commands, const LogOptions& options, LogDefects& defects,
                       std::vector<StampedCommand>* blips = nullptr);

/// Undoes and counts jumps by whole turns.
void unwrapHeadings(std::vector<StampedPose>& poses, LogDefects& defects);

/// Sorts by time (stable) and keeps the last of equal stamps; of the ball also drops outliers and counts gaps.
void conditionKicks(std::vector<StampedKick>& kicks, LogDefects& defects);
void conditionBall(std::vector<StampedBall>& ball, const LogOptions& options, LogDefects& defects);

/// Sorts by time (stable), keeps the last of equal stamps, drops outliers, unwraps headings, and counts gaps.
void conditionPoses(std::vector<StampedPose>& poses, const LogOptions& options, LogDefects& defects);

}  // namespace mrose
