#pragma once

#include <optional>
#include <span>
#include <vector>

#include "comparison/compared_divergences.h"
#include "reality/overlay_world.h"
#include "widgets/view_transform.h"

namespace mrose::gui {

/// Where the simulated robots start beside the real ones.
struct OverlayPlan {
    enum class Cut {
        once,    ///< at one start
        every,   ///< again and again, so that courses follow each other
        windows  ///< as `mrose evaluate` cuts the log: a course for each robot and window
    };
    Cut cut = Cut::every;
    double start = 0;    ///< s after the log's start; not of windows
    double length = 10;  ///< s, of a course
    /// s, of all courses that follow each other; nothing: to the log's end.
    std::optional<double> stretch = {};
    bool operator==(const OverlayPlan&) const = default;
};

/// One robot in one course, as lists show it.
struct OverlayRow {
    std::size_t course = 0, robot = 0;  ///< in Overlay::requests() and LogWorld::robots()
    std::size_t take = 0;               ///< in LogWorld::takes()
    Nanoseconds start = 0;              ///< on the take's clock
    CourseUse use = CourseUse::counted;
    std::optional<double> position;  ///< m, time-mean over what is known; nothing: there is no ground truth
    std::optional<double> share;     ///< %: of the path; nothing where it hardly drives
    std::optional<double> heading;   ///< rad, time-mean; nothing where not all is known
    std::optional<Manoeuvre> manoeuvre;
    std::optional<Divergence> divergence;
    DivergenceBound bound;
    bool touched = false;
    FieldArea area{{1, 1}, {-1, -1}};  ///< all that the middles of both robots pass
};

/// Where nobody has asked for any: every 10 s; of a log whose trajectories are too short for that windows that nearly
/// all of them hold, or, where no such window counts, courses as long as that.
OverlayPlan suitedPlan(const OverlayWorld& overlay);

/// The courses of a plan. Error: none fits in.
Expected<std::vector<CourseRequest>> plannedCourses(const OverlayWorld& overlay, const OverlayPlan& plan);

/// Those of these courses whose robots were simulated.
std::vector<OverlayRow> overlayRows(const LogWorld& world, std::span<const ComparedCourse> courses,
                                    const std::vector<CourseRequest>& requests, const DivergenceOptions& options);

}  // namespace mrose::gui
