#include "diagnosis/divergence_cause.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/command_jumps.h"
#include "diagnosis/log_defects_near.h"
#include "diagnosis/noise_bound.h"
#include "diagnosis/rollout_rerun.h"
#include "geometry/point.h"
#include "io/format.h"
#include "logs/pose_grid.h"
#include "motion/learned_model.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// After a divergence has been held: what was wrong shows more clearly then.
constexpr Nanoseconds moment = 1'000'000'000;
/// A rollout that diverges at once says little by then.
constexpr Nanoseconds leastEvidence = 2'500'000'000;

// What follows is in shares of the error that is explained, but for the numbers of ticks and runs.
constexpr double worthATick = 0.01;   // more than with fewer
constexpr double alike = 0.1;         // within it the more specific cause is the likelier
constexpr double beyondNoise = 0.85;  // so much is no accident, even where noise could do it alone
constexpr int noiseRuns = 40;
/// Commands that change in steps closer than this are one change: the best of them stands for all.
constexpr Nanoseconds oneTurn = 150'000'000;
constexpr Nanoseconds onsetSpans[] = {500'000'000, 1'000'000'000, 2'000'000'000};
/// Of noisy runs; high, because a divergence is looked at where the error is large.
constexpr double likelyShare = 0.975;

/// How many ticks something may be off by.
struct TickSearch {
    int most;
    int patience;          ///< ticks that explain no more, after which it ends
    double demanded;       ///< beyond the threshold, since what can be fitted to one moment fits much by accident
    double demandedATick;  ///< likewise, for each tick beyond the first
    double needed(double threshold, int ticks) const { return threshold + demanded + (ticks - 1) * demandedATick; }
};
constexpr TickSearch deadTime{10, 1, 0, 0.02}, heldBlip{15, 15, 0, 0}, singleCommand{15, 15, 0.2, 0};

/// Of a robot that is off by `simulated` from `real`: RMS over the known instants, in bounds; infinite where the
/// simulated robot is nowhere.
double rmsInBounds(std::span<const Pose> real, std::span<const Pose> simulated, const DivergenceBound& bound) {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < simulated.size(); ++k) {
        const DivergenceBound::At& at = bound.at(k);
        if (!std::isfinite(real[k].x + real[k].y + real[k].heading)) continue;
        const double position = length({simulated[k].x - real[k].x, simulated[k].y - real[k].y}) / at.position,
                     heading = wrapAngle(simulated[k].heading - real[k].heading) / at.heading;
        if (!std::isfinite(position + heading)) return std::numeric_limits<double>::infinity();
        sum += position * position + heading * heading;
        ++count;
    }
    return count == 0 ? 0 : std::sqrt(sum / count);
}

std::string inMilliseconds(Nanoseconds time) { return fixed(1000 * toSeconds(time), 0) + " ms"; }

class Trials {
public:
    Trials(const RolloutRerun& rerun, const DiagnosisOptions& options, Diagnosis& diagnosis)
        : rerun_(rerun), options_(options), diagnosis_(diagnosis) {
        const ComparedRollout& rollout = rerun.rollout();
        const auto steps = static_cast<std::size_t>(rerun.steps());
        truth_ = std::span(rollout.real.truth).subspan(1, steps);
        base_ = std::span(rollout.simulated).first(steps);
        baseRms_ = rmsInBounds(truth_, base_, options.bound);
    }

    /// False: cancelled.
    bool all(std::size_t robot, const DefectsNear& defects, const std::vector<CommandJump>& jumps) {
        const bool touched = rerun_.rollout().touched && *rerun_.rollout().touched <= diagnosis_.divergence.time;
        const std::optional<MotionNoise> noise = motionNoise();
        works_ = static_cast<double>(defects.blips.size() + defects.gaps.size() + jumps.size() +
                                     options_.models.size() + (noise ? noiseRuns : 0) + (touched ? 1 : 0)) +
                 5;
        for (const StampedCommand& blip : defects.blips)
            if (!tryBlip(blip)) return false;
        if (defects.blips.size() > 1 && !tryAllBlips(defects.blips)) return false;
        for (const DefectsNear::Gap& gap : defects.gaps)
            if (!add(CauseKind::logDefect, gap.what, rerun_.carried(gap.from, gap.to))) return false;
        if (touched && !add(CauseKind::contact, "without contact", rerun_.untouched())) return false;
        for (const CommandJump& jump : jumps)
            if (!tryJump(jump)) return false;
        if (!findOnset()) return false;
        return tryVelocity() && tryDeadTimes(1) && tryDeadTimes(-1) && tryModels(robot) &&
               (noise ? tryNoise(*noise) : tryNetworkBound());
    }

private:
    std::string sinceStart(Nanoseconds time) const { return fixed(toSeconds(time - rerun_.rollout().real.start), 2); }

    double explainedBy(const std::vector<Pose>& simulated) const {
        if (!(baseRms_ > 0) || std::isinf(baseRms_)) return 0;
        return std::clamp(1 - rmsInBounds(truth_, simulated, options_.bound) / baseRms_, 0.0, 1.0);
    }

    /// False: the rest is not wanted.
    bool goesOn() {
        done_ = std::min(done_ + 1, works_);
        return !options_.progress || options_.progress(done_ / works_);
    }

    bool add(CauseKind kind, std::string what, std::vector<Pose> simulated) {
        const double explained = explainedBy(simulated);
        diagnosis_.trials.push_back({kind, std::move(what), explained, options_.threshold, std::move(simulated)});
        return goesOn();
    }

    bool tryAllBlips(std::span<const StampedCommand> blips) {
        return add(CauseKind::logDefect, "all " + std::to_string(blips.size()) + " single zero commands obeyed",
                   rerun_.obeying(blips));
    }

    /// For as long as the log says, or longer: who looks at commands now and then keeps what was seen until the next
    /// look.
    bool tryBlip(const StampedCommand& blip) {
        const std::string what = "zero command at " + sinceStart(blip.time) + " s obeyed";
        auto simulated = rerun_.obeying({&blip, 1});
        const double explained = explainedBy(simulated);
        const CauseTrial once{CauseKind::logDefect, what, explained, options_.threshold, std::move(simulated)};
        return addBetter(once, bestOf(CauseKind::logDefect, heldBlip, [&](Nanoseconds held) {
                             return std::pair(what + " for " + inMilliseconds(held),
                                              rerun_.holding(blip.command, blip.time, blip.time + held));
                         }));
    }

    bool tryJump(const CommandJump& jump) {
        const Nanoseconds time = jump.command.time;
        const Command& command = jump.command.command;
        const auto what = [&](const std::string& change) {
            return "command at " + sinceStart(time) + " s " + change + " (" + fixed(command.v, 2) + " m/s, " +
                   fixed(command.w, 2) + " rad/s)";
        };
        const auto later = [&](Nanoseconds late) {
            return std::pair(what(time + late < jump.next ? inMilliseconds(late) + " later" : "not obeyed"),
                             rerun_.holding(jump.before, time, time + late));
        };
        const auto sooner = [&](Nanoseconds early) {
            return std::pair(what(inMilliseconds(early) + " sooner"), rerun_.holding(command, time - early, time));
        };
        const bool sameTurn =
            lastJump_ && time - *lastJump_ < oneTurn && diagnosis_.trials.back().kind == CauseKind::command;
        lastJump_ = time;
        std::optional<CauseTrial> before;
        if (sameTurn) {
            before = std::move(diagnosis_.trials.back());
            diagnosis_.trials.pop_back();
        }
        const bool goesOn = addBetter(bestOf(CauseKind::command, singleCommand, later),
                                      bestOf(CauseKind::command, singleCommand, sooner));
        if (before && before->explained >= diagnosis_.trials.back().explained)
            diagnosis_.trials.back() = std::move(*before);
        return goesOn;
    }

    /// What explains more than the other by what a tick is worth.
    bool addBetter(CauseTrial simple, CauseTrial other) {
        const bool better = other.explained > simple.explained + worthATick;
        diagnosis_.trials.push_back(better ? std::move(other) : std::move(simple));
        return goesOn();
    }

    /// The shortest time in which it moved otherwise, beyond which a longer one explains little more.
    bool findOnset() {
        for (const Nanoseconds span : onsetSpans) {
            auto onset =
                errorOnsetOf(rerun_.rollout(), rerun_.step(), diagnosis_.divergence, options_.bound.held, span);
            if (!onset) break;
            const auto stepOf = [&](Nanoseconds time) { return static_cast<int>(time / rerun_.step()); };
            onset->explained = explainedBy(rerun_.carried(stepOf(onset->from), stepOf(onset->to)));
            if (!diagnosis_.onset || onset->explained > diagnosis_.onset->explained + alike) diagnosis_.onset = onset;
        }
        return goesOn();
    }

    bool tryVelocity() {
        const auto velocity = velocityAt(rerun_.trajectory().poses, rerun_.rollout().real.start);
        if (!velocity) return goesOn();
        return add(CauseKind::startVelocity,
                   "velocity at the start " + fixed(velocity->v, 3) + " m/s, " + fixed(velocity->w, 2) +
                       " rad/s, from both sides of it",
                   rerun_.startingAt(*velocity));
    }

    bool tryDeadTimes(int direction) {
        const MotionModel::DeadTimes known = rerun_.model().deadTimes();
        const auto knownTicks = static_cast<int>(std::max(known.v, known.w) / rerun_.tick());
        TickSearch search = deadTime;
        if (direction < 0) search.most = std::min(search.most, knownTicks + 1);
        diagnosis_.trials.push_back(bestOf(CauseKind::deadTime, search, [&](Nanoseconds delay) {
            return std::pair("dead time " + inMilliseconds(delay) + (direction > 0 ? " longer" : " shorter"),
                             rerun_.later(direction * delay));
        }));
        return goesOn();
    }

    /// Of 1 to `search.most` ticks that number from which on more explain little more.
    CauseTrial bestOf(CauseKind kind, const TickSearch& search,
                      const std::function<std::pair<std::string, std::vector<Pose>>(Nanoseconds)>& rerunWith) {
        CauseTrial best;
        double bestWorth = -std::numeric_limits<double>::infinity();
        for (int ticks = 1, bestTicks = 1; ticks <= search.most && ticks - bestTicks <= search.patience; ++ticks) {
            auto [what, simulated] = rerunWith(ticks * rerun_.tick());
            const double explained = explainedBy(simulated), worth = explained - ticks * worthATick;
            if (worth <= bestWorth) continue;
            bestWorth = worth;
            bestTicks = ticks;
            best = {kind, std::move(what), explained, search.needed(options_.threshold, ticks), std::move(simulated)};
        }
        return best;
    }

    bool tryModels(std::size_t robot) {
        for (const OtherModel& other : options_.models)
            if (other.byRobot[robot] &&
                !add(CauseKind::otherModel, "motion model " + other.name, rerun_.movedBy(other.byRobot[robot])))
                return false;
        return true;
    }

    std::optional<MotionNoise> motionNoise() const {
        if (options_.noise) return options_.noise;
        const MotionNoise own = noiseOf(rerun_.model());
        return own.none() ? std::nullopt : std::optional(own);
    }

    /// Whole where the error is one of those that `likely` are common; what is beyond adds up in squares.
    static double explainedByNoise(double likely, double error) {
        return likely >= error ? 1 : 1 - std::sqrt(1 - likely * likely / (error * error));
    }

    /// Noise makes likely what other draws of it put between two runs.
    bool tryNoise(const MotionNoise& noise) {
        std::vector<double> apart;
        std::vector<Pose> nearest;
        double least = std::numeric_limits<double>::infinity();
        for (int run = 1; run <= noiseRuns; ++run) {
            auto simulated = rerun_.noisy(noise, options_.seed + static_cast<std::uint64_t>(run));
            apart.push_back(rmsInBounds(base_, simulated, options_.bound));
            const double off = rmsInBounds(truth_, simulated, options_.bound);
            if (off < least) {
                least = off;
                nearest = std::move(simulated);
            }
            if (!goesOn()) return false;
        }
        const auto asFar = std::count_if(apart.begin(), apart.end(), [&](double a) { return a >= baseRms_; });
        diagnosis_.trials.push_back(
            {CauseKind::noise,
             "motion noise: " + std::to_string(asFar) + " of " + std::to_string(noiseRuns) + " runs stray as far",
             explainedByNoise(quantile(apart, likelyShare), baseRms_), options_.threshold, std::move(nearest)});
        return true;
    }

    /// The same of a robot whose file has no noise, by what its network knows of real runs.
    bool tryNetworkBound() {
        if (!options_.bound.bySteps.empty()) return true;  // it is beyond that already
        const auto* learned = learnedModel(rerun_.model());
        if (learned == nullptr) return true;
        const MotionNetwork& network = learned->network();
        if (!network.noise && network.heldOut.windows == 0) return true;
        const DivergenceBound likely = network.noise ? noiseBound(*learned, rerun_.trajectory(), rerun_.rollout(),
                                                                  rerun_.step(), options_.bound.held)
                                                     : heldOutBound(network.heldOut, rerun_.rollout(), rerun_.step());
        diagnosis_.trials.push_back({CauseKind::noise,
                                     network.noise ? "no more than such robots differ from themselves"
                                                   : "no more than the network's held-out error",
                                     explainedByNoise(1, rmsInBounds(truth_, base_, likely)),
                                     options_.threshold,
                                     {}});
        return goesOn();
    }

    const RolloutRerun& rerun_;
    const DiagnosisOptions& options_;
    Diagnosis& diagnosis_;
    std::optional<Nanoseconds> lastJump_;  ///< of the commands that were tried
    std::span<const Pose> truth_, base_;
    double baseRms_ = 0, works_ = 1, done_ = 0;
};

/// The likely one of what was tried, best first.
std::optional<std::size_t> likelyOf(const std::vector<CauseTrial>& trials) {
    std::optional<std::size_t> noise, best;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        if (trials[i].explained < trials[i].needed) continue;
        if (trials[i].kind == CauseKind::noise)
            noise = i;
        else if (!best ||
                 (trials[i].kind < trials[*best].kind && trials[i].explained >= trials.front().explained - alike))
            best = i;
    }
    if (noise && (!best || trials[*best].explained < beyondNoise)) return noise;
    return best;
}

}  // namespace

const char* name(CauseKind kind) {
    switch (kind) {
        case CauseKind::logDefect:
            return "defect of the log";
        case CauseKind::contact:
            return "contact";
        case CauseKind::startVelocity:
            return "velocity at the start";
        case CauseKind::deadTime:
            return "dead time";
        case CauseKind::command:
            return "single command";
        case CauseKind::otherModel:
            return "motion model";
        case CauseKind::noise:
            break;
    }
    return "noise";
}

Expected<Diagnosis> diagnose(const LogWorld& world, const RolloutRequest& request, const ComparedRollout& rollout,
                             const Divergence& divergence, const DiagnosisOptions& options) {
    const Nanoseconds tick = world.parts().scene.tickLength;
    for (const OtherModel& other : options.models)
        if (const auto& model = other.byRobot[rollout.robot]; model && model->period() % tick != 0)
            return fail(other.name, "has a period of " + secondsText(model->period()) +
                                        " s; expected a whole number of the scenario's ticks of " + secondsText(tick) +
                                        " s");
    const auto stepsTo = [&](Nanoseconds time) {
        return static_cast<int>(std::min<Nanoseconds>((time + options.step - 1) / options.step, request.steps));
    };
    Diagnosis diagnosis;
    diagnosis.divergence = divergence;
    int steps = stepsTo(std::max(divergence.time + options.bound.held + moment, leastEvidence));
    const Trajectory& log = world.trajectory(request.session, rollout.robot);
    const MotionModel& model = world.parts().scene.modelOf(world.robots()[rollout.robot].body);
    const DefectsNear defects = defectsNear(log, model, rollout, options.step, divergence.time);
    const std::vector<CommandJump> jumps = commandJumpsNear(log, model, rollout, divergence.time, divergence.bound);
    for (const DefectsNear::Gap& gap : defects.gaps) steps = std::max(steps, stepsTo(gap.to * options.step + moment));
    diagnosis.until = steps * options.step;
    const RolloutRerun rerun(world, request, rollout, options.step, steps, options.seed);
    Trials trials(rerun, options, diagnosis);
    diagnosis.cancelled = !trials.all(rollout.robot, defects, jumps);
    std::stable_sort(diagnosis.trials.begin(), diagnosis.trials.end(),
                     [](const CauseTrial& a, const CauseTrial& b) { return a.explained > b.explained; });
    if (!diagnosis.cancelled) diagnosis.likely = likelyOf(diagnosis.trials);
    return diagnosis;
}

}  // namespace mrose
