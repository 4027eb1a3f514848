#include "widgets/timeline_signs.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "widgets/timeline_glyphs.h"

namespace mrose {

std::vector<TimelineSign> signsOf(std::span<const TimelineMark> marks,
                                  const std::function<double(std::int64_t)>& pixelOf,
                                  const std::function<double(int)>& widthOf) {
    std::vector<TimelineSign> signs;
    std::array<std::optional<std::size_t>, markKinds> latest;
    for (const TimelineMark& mark : marks) {
        if (mark.kind == TimelineMark::Kind::contact) continue;
        const double x = pixelOf(mark.tick);
        std::optional<std::size_t>& last = latest[static_cast<std::size_t>(mark.kind)];
        if (last && x - signs[*last].x < signs[*last].width) {
            TimelineSign& sign = signs[*last];
            sign.last = mark.tick;
            sign.width = widthOf(++sign.count);
            continue;
        }
        last = signs.size();
        signs.push_back({mark.kind, x, widthOf(1), mark.tick, mark.tick, 1});
    }
    std::map<double, TimelineSign*> next;  // by lane
    for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign) {
        TimelineSign*& right = next[timeline::laneOf(sign->kind)];
        sign->numbered = sign->count > 1 &&
                         (right == nullptr || right->x - leastSignGap / 2 >= sign->x + sign->width - leastSignGap);
        right = &*sign;
    }
    return signs;
}

double timeline::laneOf(TimelineMark::Kind kind) {
    switch (kind) {
        case TimelineMark::Kind::contact:
            return contactTop + contactHeight / 2;
        case TimelineMark::Kind::kick:
            return kickLane;
        case TimelineMark::Kind::goal:
            return goalLane;
        default:
            return alertLane;
    }
}

}  // namespace mrose
