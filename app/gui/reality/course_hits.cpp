#include "reality/course_hits.h"

#include <algorithm>

namespace mrose::gui {

void CourseHits::learn(std::size_t course, std::span<const BreakpointState> states) {
    for (const BreakpointState& state : states) {
        std::int64_t& hits = hits_[state.breakpoint.text][course];
        hits = std::max(hits, state.inRun);
    }
}

MetElsewhere CourseHits::elsewhere(std::size_t course) const {
    MetElsewhere met;
    for (const auto& [text, courses] : hits_)
        for (const auto& [at, hits] : courses)
            if (at != course) (at < course ? met.before : met.after)[text] += hits;
    return met;
}

}  // namespace mrose::gui
