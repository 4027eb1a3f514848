#include "logs/looks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/format.h"
#include "logs/conditioning.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr double periodTolerance = 0.012;  // s

void add(Look& look, const LogReading& reading, SensorDefects& defects) {
    const auto known = std::find_if(look.readings.begin(), look.readings.end(),
                                    [&](const LogReading& other) { return other.subject == reading.subject; });
    if (known == look.readings.end()) return look.readings.push_back(reading);
    *known = reading;
    ++defects.repeated;
}

/// A stamp in seconds, to the millisecond: the double nearest to the text of the file.
double inSeconds(Nanoseconds time) { return std::nearbyint(static_cast<double>(time) * 1e-6) / 1e3; }
Nanoseconds fromMilliseconds(double seconds) { return std::llrint(seconds * 1e3) * 1'000'000; }

/// How many periods lie between two looks, where it looked between them; 1 where it did not.
int periodsBetween(double before, double after, double period) {
    const double ratio = std::nearbyint((after - before) / period);
    if (!(ratio > 1 && ratio <= mostEmptyLooks + 1)) return 1;
    return std::abs((after - before) / ratio - period) < periodTolerance ? static_cast<int>(ratio) : 1;
}

/// From the first to the last instant of all these samples; nothing: last < first.
template <class... Samples>
std::pair<Nanoseconds, Nanoseconds> spanOf(const std::vector<Samples>&... samples) {
    Nanoseconds first = latestTime, last = -latestTime;
    const auto include = [&](const auto& some) {
        if (some.empty()) return;
        first = std::min(first, some.front().time);
        last = std::max(last, some.back().time);
    };
    (include(samples), ...);
    return {first, last};
}

std::pair<Nanoseconds, Nanoseconds> reportedSpan(const SensorLog& sensor) {
    return spanOf(sensor.looks, sensor.poses, sensor.scans);
}

template <class Sample>
void sortAndKeepLast(std::vector<Sample>& samples, SensorDefects& defects) {
    LogDefects found;
    sortByTime(samples, found);
    keepLastOfEqualStamps(samples, found);
    defects.outOfOrder += found.outOfOrder;
    defects.repeated += found.duplicates;
}

}  // namespace

std::vector<Look> joinLooks(std::vector<StampedReading> readings, Nanoseconds same, SensorDefects& defects) {
    LogDefects order;
    sortByTime(readings, order);
    defects.outOfOrder += order.outOfOrder;
    std::vector<Look> looks;
    Nanoseconds latest = 0;
    for (const StampedReading& row : readings) {
        if (looks.empty() || row.time - looks.back().time > same)
            looks.push_back({row.time, {}});
        else
            defects.joinedStamps += row.time != latest;
        latest = row.time;
        if (row.reading) add(looks.back(), *row.reading, defects);
    }
    return looks;
}

void addEmptyLooks(std::vector<Look>& looks, double period, SensorDefects& defects) {
    std::vector<Look> all;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        if (i > 0) {
            const double before = inSeconds(looks[i - 1].time), after = inSeconds(looks[i].time);
            const int periods = periodsBetween(before, after, period);
            for (int k = 1; k < periods; ++k)
                all.push_back({fromMilliseconds(before + (after - before) * k / periods), {}});
            defects.emptyLooks += periods - 1;
        }
        all.push_back(std::move(looks[i]));
    }
    looks = std::move(all);
}

std::string wrongRange(double range) {
    if (range >= 0) return {};
    return "expected a range of at least 0 m, found " + numberText(range) + ": are columns swapped?";
}

std::string wrongBearing(double bearing) {
    if (std::abs(bearing) <= 2 * std::numbers::pi) return {};
    return "expected radians within +-2 pi, found " + numberText(bearing) + ": are these degrees?";
}

void conditionReported(std::vector<StampedPose>& poses, SensorDefects& defects) {
    sortAndKeepLast(poses, defects);
    LogDefects found;
    unwrapHeadings(poses, found);
    defects.headingWraps += found.headingWraps;
}

void conditionReported(std::vector<LogScan>& scans, SensorDefects& defects) { sortAndKeepLast(scans, defects); }

bool sharesTime(const SensorLog& sensor, const Trajectory& trajectory) {
    const auto [reportedFirst, reportedLast] = reportedSpan(sensor);
    const auto [first, last] = spanOf(trajectory.commands, trajectory.poses);
    return reportedLast < reportedFirst || (reportedFirst <= last && reportedLast >= first);
}

std::string otherTimeCause(const SensorLog& sensor, const Trajectory& trajectory) {
    const auto [reportedFirst, reportedLast] = reportedSpan(sensor);
    const auto [first, last] = spanOf(trajectory.commands, trajectory.poses);
    return "readings from " + secondsText(reportedFirst, 3) + " to " + secondsText(reportedLast, 3) +
           " s; expected some within the robot's commands and poses, " + secondsText(first, 3) + " to " +
           secondsText(last, 3) + " s";
}

}  // namespace mrose
