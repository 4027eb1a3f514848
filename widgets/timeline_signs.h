#pragma once

#include <functional>
#include <span>
#include <vector>

#include "debug/timeline_mark.h"

namespace mrose {

/// A mark as the timeline shows it, or several of a kind that lie too near to one another: it stands at the first.
struct TimelineSign {
    TimelineMark::Kind kind = TimelineMark::Kind::kick;
    double x = 0, width = 0;           ///< pixels, from the middle of its shape to its right end
    std::int64_t first = 0, last = 0;  ///< ticks of the first and the last of its marks
    int count = 1;
    bool numbered = false;  ///< of several, their number stands beside it: there is room up to the next in its lane
};

/// Of marks in the order of their ticks, contacts left out, which are too many for it. `widthOf` says how wide a sign
/// of so many marks is, more for more of them. Also in the order of ticks.
std::vector<TimelineSign> signsOf(std::span<const TimelineMark> marks,
                                  const std::function<double(std::int64_t)>& pixelOf,
                                  const std::function<double(int)>& widthOf);

// Pixels, from above to below: flags with times, a lane for each sort of mark, the track, the scale.
namespace timeline {
constexpr double flagTop = 2, flagHeight = 15;
constexpr double alertLane = 24, goalLane = 33.5, kickLane = 43;  ///< middles
constexpr double trackTop = 49, trackHeight = 10, contactTop = 60, contactHeight = 8;
constexpr double scaleTop = contactTop + contactHeight;
constexpr int height = 85;
/// Signs of a kind do not lie nearer to each other than this, pixels.
constexpr double leastSignGap = 9;

/// The middle of the lane that a kind has for itself or shares with what is rare as well.
double laneOf(TimelineMark::Kind kind);
}  // namespace timeline

}  // namespace mrose
