#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "comparison/divergence_cause.h"

namespace mrose {

/// Which divergences of a comparison are looked for, and why.
struct DivergenceOptions {
    DivergenceBound bound{};   ///< the constants, and for how long
    bool fromHeldOut = false;  ///< instead of the constants, heldOutBound() of each robot's network
    std::vector<OtherModel> models{};
    /// The causes of so many courses are looked for, of those that diverge the ones with the largest mean error; of a
    /// single course those of all robots.
    std::size_t diagnosed = 5;
    std::function<bool(double)> progress{};  ///< share of the causes; from any thread, one at a time; false: cancelled
};

/// A robot that leaves the real course.
struct CourseDivergence {
    std::size_t course = 0;  ///< in Comparison::courses
    Divergence divergence;
    std::optional<Diagnosis> diagnosis;  ///< nothing: not looked for
};

/// The first divergences of a comparison's courses.
struct ComparedDivergences {
    DivergenceBound bound;                  ///< the constants, where it is not
    bool fromHeldOut = false;               ///< of each robot's network
    std::vector<CourseDivergence> courses;  ///< those that diverge, as in Comparison::courses
    struct Summary {
        std::size_t courses = 0, diverging = 0;  ///< courses: those that were simulated
        double medianTime = 0;                   ///< s, of those that diverge; not a number of none
    };
    std::vector<Summary> robots;  ///< by compared robot
    Summary all;
    bool cancelled = false;

    const CourseDivergence* of(std::size_t course) const;  ///< null: it does not diverge
};

/// The bound for one course. Error: held-out errors are asked for and the robot's network has none.
Expected<DivergenceBound> boundFor(const LogWorld& world, const ComparedCourse& course,
                                   const DivergenceOptions& options, Nanoseconds step);

/// Finds where each course of `comparison` diverges, and why. The result is the same for any number of threads. Error:
/// as for boundFor() and diagnose().
Expected<ComparedDivergences> divergencesOf(const LogWorld& world, const Comparison& comparison,
                                            const DivergenceOptions& options);

}  // namespace mrose
