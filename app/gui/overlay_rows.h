#pragma once

#include <optional>
#include <span>
#include <vector>

#include "comparison/compared_divergences.h"
#include "overlay_world.h"

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
    bool operator==(const OverlayPlan&) const = default;
};

/// One robot in one course, as lists show it.
struct OverlayRow {
    std::size_t request = 0, robot = 0;  ///< in Overlay::requests() and LogWorld::robots()
    Nanoseconds start = 0;               ///< on the take's clock
    CourseUse use = CourseUse::counted;
    double position = 0;  ///< m, time-mean; below zero where nothing is known
    double share = 0;     ///< %: of the path; not a number where it hardly drives
    double heading = 0;   ///< rad, time-mean; not a number where not all is known
    std::optional<Manoeuvre> manoeuvre;
    std::optional<Divergence> divergence;
    bool touched = false;
};

/// The courses of a plan. Error: none fits in.
Expected<std::vector<CourseRequest>> plannedCourses(const OverlayWorld& overlay, const OverlayPlan& plan);

/// Those of these courses whose robots were simulated.
std::vector<OverlayRow> overlayRows(const LogWorld& world, std::span<const ComparedCourse> courses,
                                    const std::vector<CourseRequest>& requests, const DivergenceOptions& options);

/// As boundFor(); the constants where a network was not held out from anything.
DivergenceBound courseBound(const LogWorld& world, const ComparedCourse& course, const DivergenceOptions& options);
/// Whether any of the robots moves by a network that tells how true it is.
bool knowsHeldOut(const LogWorld& world);

}  // namespace mrose::gui
