#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/divergence.h"
#include "diagnosis/error_onset.h"
#include "diagnosis/other_models.h"
#include "io/progress.h"
#include "motion/noisy_model.h"

namespace mrose {

/// What may make a simulated robot leave the real trajectory; the earlier ones are the more specific.
enum class CauseKind {
    logDefect,      ///< a blip or a gap in the log
    contact,        ///< the simulated robot touched something that the real one did not
    startVelocity,  ///< the measured velocity at the start is wrong
    deadTime,       ///< the robot answers later or sooner than its model
    command,        ///< one command acted later or sooner than the others, or not at all
    otherModel,     ///< another motion model is nearer
    noise           ///< no more than what motion noise makes likely
};
const char* name(CauseKind kind);

/// One re-run with one thing changed.
struct CauseTrial {
    CauseKind kind = CauseKind::noise;
    std::string what;             ///< "dead time 20 ms longer", "motion model create_paper.net", "without contact"
    double explained = 0;         ///< 0 ... 1, of the error up to Diagnosis::until
    double needed = 0;            ///< explained: less is no cause
    std::vector<Pose> simulated;  ///< of the re-run, after each step up to `until`; empty where there is none
};

/// Why a simulated robot left the real trajectory, as far as re-runs show.
struct Diagnosis {
    Divergence divergence;
    std::optional<ErrorOnset> onset;    ///< when most of it arose; nullopt: not known
    Nanoseconds until = 0;              ///< since the start: the re-runs and their errors end there
    std::vector<CauseTrial> trials;     ///< the best first
    std::optional<std::size_t> likely;  ///< in `trials`; nullopt: none of these
    bool cancelled = false;             ///< the trials are those that were done up to then
};

struct DiagnosisOptions {
    DivergenceBound bound{};  ///< beyond which the rollout diverges; errors are measured in it
    std::vector<OtherModel> models{};
    /// Of the robots' motion, per period; nullopt: what their files say, or else what their networks know of real
    /// runs (unless that is the bound).
    std::optional<MotionNoise> noise{};
    std::uint64_t seed = 1;          ///< that of the comparison
    Nanoseconds step = 100'000'000;  ///< likewise
    double threshold = 0.6;          ///< explained: less makes no cause likely
    Progress progress{};
};

/// Re-runs a rollout of `world` up to a little after its divergence, with one thing changed at a time for the robot
/// that diverges. `rollout` is what compare() made of `request`, `divergence` what firstDivergence() says of it. The
/// result is the same for any number of threads. Error: the period of another model is no whole number of ticks.
Expected<Diagnosis> diagnose(const LogWorld& world, const RolloutRequest& request, const ComparedRollout& rollout,
                             const Divergence& divergence, const DiagnosisOptions& options);

}  // namespace mrose
