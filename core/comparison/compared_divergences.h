#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "comparison/divergence_cause.h"

namespace mrose {

/// Which divergences of a comparison are looked for, and why.
struct DivergenceOptions {
    DivergenceBound bound{};  ///< the constants, and for how long
    /// Instead of the constants, heldOutBound() of each robot's network; of a robot without such errors the constants.
    bool fromHeldOut = false;
    std::vector<OtherModel> models{};
    /// The causes of so many courses are looked for, of those that diverge the ones with the largest mean error; of a
    /// single course those of all robots. 0: of none.
    std::size_t diagnosed = 50;
    Progress progress{};  ///< of looking for causes; told from any thread, one at a time
};

/// A robot that leaves the real course.
struct CourseDivergence {
    std::size_t course = 0;  ///< in Comparison::courses
    Divergence divergence;
    std::optional<Diagnosis> diagnosis;  ///< nothing: not looked for
};

/// The first divergences of a comparison's courses.
struct ComparedDivergences {
    DivergenceBound bound;                  ///< the constants
    bool fromHeldOut = false;               ///< of a robot at least; of the others the constants
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

/// Indices into `found.courses` of at most so many, those with the largest mean errors, the worst first; of a single
/// course those of all robots.
std::vector<std::size_t> worstOf(const Comparison& comparison, const ComparedDivergences& found, std::size_t most);
/// So many are shown to people one by one.
constexpr std::size_t shownDivergences = 5;

/// Whether any of the robots moves by a network that tells its held-out errors.
bool knowsHeldOut(const LogWorld& world);

/// The bound for one course.
DivergenceBound boundFor(const LogWorld& world, const ComparedCourse& course, const DivergenceOptions& options,
                         Nanoseconds step);

/// Finds where each course of `comparison` diverges, and why. The result is the same for any number of threads. Error:
/// as for diagnose().
Expected<ComparedDivergences> divergencesOf(const LogWorld& world, const Comparison& comparison,
                                            const DivergenceOptions& options);

}  // namespace mrose
