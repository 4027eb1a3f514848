#include "logs/csv_clocks.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr double leastApart = 3600;  // s
constexpr double timesAsLong = 10;   // as the files on either side reach

struct Stretch {
    Nanoseconds first = 0, last = 0;
    double length() const { return toSeconds(last) - toSeconds(first); }
};

/// Of files in the order of their first times.
Stretch stretchOf(std::span<const FileTimes> files) {
    return {files.front().first, std::ranges::max_element(files, {}, &FileTimes::last)->last};
}

/// The files before and after the longest time in which there are none.
struct FileGroups {
    std::span<const FileTimes> before, after;
    double apart = 0;  ///< s
};

FileGroups groupsOf(std::span<const FileTimes> files) {
    FileGroups groups{files, {}};
    Nanoseconds last = files.front().last;
    for (std::size_t i = 1; i < files.size(); ++i) {
        const double apart = toSeconds(files[i].first) - toSeconds(last);
        if (apart > groups.apart) groups = {files.first(i), files.subspan(i), apart};
        last = std::max(last, files[i].last);
    }
    return groups;
}

}  // namespace

std::string otherClockText(std::vector<FileTimes> files) {
    std::ranges::sort(files, {}, &FileTimes::first);
    const auto [before, after, apart] = groupsOf(files);
    if (apart < leastApart) return {};
    if (apart < timesAsLong * std::max(stretchOf(before).length(), stretchOf(after).length())) return {};
    const bool later = after.size() <= before.size();
    const std::span<const FileTimes> odd = later ? after : before, others = later ? before : after;
    const Stretch known = stretchOf(others);
    return std::filesystem::path(odd.front().file).filename().string() +
           (odd.size() > 1 ? " and " + std::to_string(odd.size() - 1) + " more begin at " : " begins at ") +
           secondsText(odd.front().first) + " s, the other files' times are " + secondsText(known.first) + " to " +
           secondsText(known.last) + " s: is that another clock? Then nothing of both is joined.";
}

}  // namespace mrose
