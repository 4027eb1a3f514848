#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "breaks/breakpoints.h"
#include "comparison/divergence.h"
#include "comparison/reality.h"
#include "reality/course_hits.h"
#include "reality/overlay_rows.h"

namespace mrose::gui {

// What breakpoints ask of courses that are laid over a log.

/// What "divergence" asks in a course: where its robots first leave the real ones, as the comparison knows. What
/// branches do nobody has compared: in them it holds while a robot has been beyond its bound for as long as that asks.
struct LeavingRobots {
    struct Robot {
        std::string name;  ///< of the simulated one
        DivergenceBound bound;
        std::optional<Nanoseconds> leaves;  ///< where the comparison has it
    };
    std::vector<Robot> robots;
    std::shared_ptr<const Reality> reality;     ///< null: branches do not ask
    std::optional<std::uint32_t> compared = 0;  ///< the branch that is the course of the comparison
};
LeavingRobots leavingRobots(const LogWorld& world, std::span<const OverlayRow> rowsOfCourse);
TickPredicate leavesReality(const LeavingRobots& leaving);
/// Which of them begin to do so at a tick: "create 5 leaves the real course".
TickText whoLeaves(const LeavingRobots& leaving);

/// In which courses of a log to look for a break, in that order, and what leaves the real course in each.
struct CourseSearch {
    BreakWish wish;
    std::vector<Breakpoint> breakpoints;
    CourseHits hits;  ///< that are known: who counts goes on from those before
    struct Place {
        std::size_t course = 0;  ///< in Overlay::requests()
        CourseRequest request;
        TickPredicate diverged;
    };
    std::vector<Place> places;
};
struct CourseFound {
    std::optional<std::size_t> course;  ///< nothing: there is none in any of them, or `progress` ended it
    CourseHits hits;                    ///< with those of the courses that were passed forward
};
/// The first of them in which there is one, as of Session::goToBreak(); a course that cannot be opened, as
/// where no robot has ground truth, has none. Error: of the text.
Expected<CourseFound> courseWithBreak(const OverlayWorld& overlay, const CourseSearch& search,
                                      const std::function<bool(double share)>& progress);

}  // namespace mrose::gui
