#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "assessment/compare.h"
#include "motion/motion_network.h"
#include "quantities/real_robots.h"

namespace mrose {

/// What bounds are made of; the later ones say more.
enum class BoundSource {
    constant,
    heldOut,  ///< heldOutBound(): of networks that know how far they were off in learning
    noise     ///< noiseBound(): of networks that know their noise
};

/// How far a simulated robot may be from the real one. Beyond either bound for `held`, it has left the real trajectory.
struct DivergenceBound {
    struct At {
        double position = 0;  ///< m
        double heading = 0;   ///< rad
        bool operator==(const At&) const = default;
    };
    At constant{0.1, 10 * std::numbers::pi / 180};
    Nanoseconds held = 300'000'000;
    /// Instead of the constant: of the instants after each step of the rollout, as WindowErrors has them; the last one
    /// holds for all that follow. Empty: the constant.
    std::vector<At> bySteps;
    BoundSource source = BoundSource::constant;

    /// After `k` + 1 steps.
    const At& at(std::size_t k) const {
        return bySteps.empty() ? constant : bySteps[k < bySteps.size() ? k : bySteps.size() - 1];
    }
};

/// The rule, over the instants whose errors are known, one after the other forwards or backwards in time. Instants
/// without ground truth are not added: they neither prove nor disprove anything.
class DivergenceRule {
public:
    explicit DivergenceRule(Nanoseconds held) : held_(held) {}

    enum class State {
        within,  ///< its bound at this instant
        beyond,  ///< one of its bounds at this instant
        left     ///< beyond at this instant and all between it and `since`, which is at least so far away
    };
    State add(Nanoseconds time, const PoseError& error, const DivergenceBound::At& bound);
    /// Where the stretch beyond begins that the last instant belongs to.
    Nanoseconds since() const { return since_; }

private:
    Nanoseconds held_, since_ = 0;
    bool beyond_ = false;
};

/// Where a simulated robot leaves the real trajectory.
struct Divergence {
    Nanoseconds time = 0;    ///< since the start: the first instant beyond the bound, from which on it is held
    Nanoseconds within = 0;  ///< the last instant before at which it is known to be within; 0: the start
    double position = 0, heading = 0;            ///< errors at `time`: m, rad
    DivergenceBound::At bound;                   ///< at `time`
    bool byPosition = false, byHeading = false;  ///< which of the errors are beyond theirs at `time`
    bool unknownBefore = false;                  ///< the truth is not known between `within` and `time`
};

/// The first instant at which the rule begins to hold. Instants are those of the steps: `step` is that of the
/// comparison. nullopt: it stays on the real trajectory, as far as is known; or it was not simulated.
std::optional<Divergence> firstDivergence(const ComparedRollout& rollout, Nanoseconds step,
                                          const DivergenceBound& bound);

/// The bound that a network's held-out errors make: three times what its errors typically are at each instant. P and Hd
/// are means over a window's time of errors that grow as the robot drives, over what it drove to the window's end; so
/// an error is typically twice P times the path up to then, and twice Hd times the rotation. Beyond the held-out
/// horizon this goes on in proportion. Near the start, and where a robot hardly turns, errors come from the measured
/// start, from single commands that act late, and from P itself (a heading that is off by h puts the robot h / 2 of its
/// path off): at least `least`, and a heading of at least three times 4 P rad. Path and rotation are the real robot's
/// in `rollout`, summed over 0.5 s where the truth is known. Of the 10 s rollouts of MRCLAM data set 6, from which
/// create.net was learned, one in nine leaves this bound; of twice the typical errors one in five does.
DivergenceBound heldOutBound(const MotionNetwork::HeldOut& heldOut, const ComparedRollout& rollout, Nanoseconds step,
                             const DivergenceBound::At& least = {0.02, 3 * std::numbers::pi / 180});

}  // namespace mrose
