#include "comparison/divergence_cause.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "comparison/course_rerun.h"
#include "comparison/log_defects_near.h"
#include "evaluation/format.h"
#include "logs/pose_grid.h"
#include "motion/learned_model.h"

namespace mrose {
namespace {

/// After a divergence has been held: what was wrong shows more clearly then.
constexpr Nanoseconds moment = 1'000'000'000;
constexpr Nanoseconds leastEvidence = 2'500'000'000;  // a course that diverges at once tells little by then
constexpr int mostTicks = 10;                         // that a dead time is off by
constexpr double demandedForATick = 0.02;  // explained, beyond the threshold: more ticks fit more by accident
constexpr double worthATick = 0.01;        // explained more
constexpr double alike = 0.1;              // explained: within it the more specific cause is the likelier
constexpr double beyondNoise = 0.85;       // explained: so much is no accident, even where noise could do it alone
constexpr int noiseRuns = 40;
constexpr double likelyShare =
    0.975;  // of noisy runs; high, because a divergence is looked at where the error is large

/// Of a robot that is off by `simulated` from `real`: RMS over the known instants, in bounds.
double rmsInBounds(std::span<const Pose> real, std::span<const Pose> simulated, const DivergenceBound& bound) {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < simulated.size(); ++k) {
        const DivergenceBound::At& at = bound.at(k);
        const double position = std::hypot(simulated[k].x - real[k].x, simulated[k].y - real[k].y) / at.position,
                     heading = wrapAngle(simulated[k].heading - real[k].heading) / at.heading;
        if (!std::isfinite(position + heading)) continue;
        sum += position * position + heading * heading;
        ++count;
    }
    return count == 0 ? 0 : std::sqrt(sum / count);
}

class Trials {
public:
    Trials(const CourseRerun& rerun, const DiagnosisOptions& options, Diagnosis& diagnosis)
        : rerun_(rerun), options_(options), diagnosis_(diagnosis) {
        const ComparedCourse& course = rerun.course();
        const auto steps = static_cast<std::size_t>(rerun.steps());
        truth_ = std::span(course.real.truth).subspan(1, steps);
        base_ = std::span(course.simulated).first(steps);
        baseRms_ = rmsInBounds(truth_, base_, options.bound);
    }

    /// False: cancelled.
    bool all(std::size_t robot, const DefectsNear& defects) {
        const bool touched = rerun_.course().touched && *rerun_.course().touched <= diagnosis_.divergence.time;
        const std::optional<MotionNoise> noise = motionNoise();
        works_ = static_cast<double>(defects.blips.size() + defects.gaps.size() + options_.models.size()) +
                 (touched ? 1 : 0) + (noise ? noiseRuns : 0) + 2 * 2 + 1;
        for (const StampedCommand& blip : defects.blips)
            if (!tryBlips({&blip, 1})) return false;
        if (defects.blips.size() > 1 && !tryBlips(defects.blips)) return false;
        for (const DefectsNear::Gap& gap : defects.gaps)
            if (!add(CauseKind::logDefect, gap.what, rerun_.carried(gap.from, gap.to))) return false;
        if (touched && !add(CauseKind::contact, "without contact", rerun_.untouched())) return false;
        return tryVelocity() && tryDeadTimes(1) && tryDeadTimes(-1) && tryModels(robot) &&
               (noise ? tryNoise(*noise) : tryHeldOut());
    }

private:
    double explainedBy(const std::vector<Pose>& simulated) const {
        if (baseRms_ <= 0) return 0;
        return std::clamp(1 - rmsInBounds(truth_, simulated, options_.bound) / baseRms_, 0.0, 1.0);
    }

    /// False: nobody wants the rest.
    bool goesOn() {
        done_ = std::min(done_ + 1, works_);
        return !options_.progress || options_.progress(done_ / works_);
    }

    bool add(CauseKind kind, std::string what, std::vector<Pose> simulated) {
        const double explained = explainedBy(simulated);
        diagnosis_.trials.push_back({kind, std::move(what), explained, options_.threshold, std::move(simulated)});
        return goesOn();
    }

    bool tryBlips(std::span<const StampedCommand> blips) {
        const Nanoseconds since = blips.front().time - rerun_.course().real.start;
        const std::string what = blips.size() == 1
                                     ? "zero command at " + fixed(toSeconds(since), 2) + " s obeyed"
                                     : "all " + std::to_string(blips.size()) + " single zero commands obeyed";
        return add(CauseKind::logDefect, what, rerun_.obeying(blips));
    }

    bool tryVelocity() {
        const auto velocity = velocityAt(rerun_.trajectory().poses, rerun_.course().real.start);
        if (!velocity) return goesOn();
        return add(CauseKind::startVelocity,
                   "velocity at the start " + fixed(velocity->v, 3) + " m/s, " + fixed(degrees * velocity->w, 1) +
                       " deg/s, from both sides of it",
                   rerun_.startingAt(*velocity));
    }

    /// As many ticks in one direction as each explains still more.
    bool tryDeadTimes(int direction) {
        const MotionModel::DeadTimes known = rerun_.model().deadTimes();
        const auto knownTicks = static_cast<int>(std::max(known.v, known.w) / rerun_.tick());
        const int most = direction > 0 ? mostTicks : std::min(mostTicks, knownTicks + 1);
        CauseTrial best;
        for (int ticks = 1; ticks <= most; ++ticks) {
            const Nanoseconds delay = ticks * rerun_.tick();
            auto simulated = rerun_.later(direction * delay);
            const double explained = explainedBy(simulated);
            if (!goesOn()) return false;
            if (ticks > 1 && explained < best.explained + worthATick) break;
            best = {CauseKind::deadTime,
                    "dead time " + fixed(1000 * toSeconds(delay), 0) + " ms " + (direction > 0 ? "longer" : "shorter"),
                    explained, options_.threshold + (ticks - 1) * demandedForATick, std::move(simulated)};
        }
        diagnosis_.trials.push_back(std::move(best));
        return true;
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
        const MotionNoise& own = rerun_.type().motionNoise;
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

    /// The same of a robot whose file has no noise: its network's errors are likely up to heldOutBound().
    bool tryHeldOut() {
        if (!options_.bound.bySteps.empty()) return true;  // it is beyond that already
        const auto* learned = dynamic_cast<const LearnedModel*>(&rerun_.model());
        if (learned == nullptr || learned->network().heldOut.windows == 0) return true;
        const DivergenceBound likely = heldOutBound(learned->network().heldOut, rerun_.course(), rerun_.step());
        const double times = rmsInBounds(truth_, base_, likely);
        diagnosis_.trials.push_back({CauseKind::noise,
                                     "no more than the network's held-out error",
                                     explainedByNoise(1, times),
                                     options_.threshold,
                                     {}});
        return goesOn();
    }

    const CourseRerun& rerun_;
    const DiagnosisOptions& options_;
    Diagnosis& diagnosis_;
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
        case CauseKind::otherModel:
            return "motion model";
        case CauseKind::noise:
            break;
    }
    return "noise";
}

Expected<Diagnosis> diagnose(const LogWorld& world, const CourseRequest& request, const ComparedCourse& course,
                             const Divergence& divergence, const DiagnosisOptions& options) {
    const Nanoseconds tick = world.parts().scene.tickLength;
    for (const OtherModel& other : options.models)
        if (const auto& model = other.byRobot[course.robot]; model && model->period() % tick != 0)
            return fail(other.name, "has a period of " + secondsText(model->period()) +
                                        " s; expected a whole number of the scenario's ticks of " + secondsText(tick) +
                                        " s");
    const auto stepsTo = [&](Nanoseconds time) {
        return static_cast<int>(std::min<Nanoseconds>((time + options.step - 1) / options.step, request.steps));
    };
    Diagnosis diagnosis;
    diagnosis.divergence = divergence;
    int steps = stepsTo(std::max(divergence.time + options.bound.held + moment, leastEvidence));
    DefectsNear defects = defectsNear(world.trajectory(request.take, course.robot),
                                      world.parts().scene.modelOf(world.robots()[course.robot].body), course,
                                      options.step, divergence.time);
    for (const DefectsNear::Gap& gap : defects.gaps) steps = std::max(steps, stepsTo(gap.to * options.step + moment));
    diagnosis.until = steps * options.step;
    const CourseRerun rerun(world, request, course, options.step, steps, options.seed);
    Trials trials(rerun, options, diagnosis);
    diagnosis.cancelled = !trials.all(course.robot, defects);
    std::stable_sort(diagnosis.trials.begin(), diagnosis.trials.end(),
                     [](const CauseTrial& a, const CauseTrial& b) { return a.explained > b.explained; });
    if (!diagnosis.cancelled) diagnosis.likely = likelyOf(diagnosis.trials);
    return diagnosis;
}

}  // namespace mrose
