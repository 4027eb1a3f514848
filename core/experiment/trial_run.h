#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "experiment/branching.h"
#include "experiment/experiment_file.h"
#include "experiment/run.h"
#include "experiment/trial.h"
#include "experiment/trial_expressions.h"
#include "io/error.h"
#include "io/progress.h"

namespace mrose {

/// What one thread at a time makes and measures the trials of an experiment with.
struct Workplace {
    TrialExpressions expressions;
    TrialMaker maker;
    Workplace(const Experiment& experiment, const ScenarioLoading& loading)
        : expressions(experiment), maker(experiment, expressions, loading) {}
};

/// As many as there are threads that ask at once. The experiment and the loading must stay where they are.
class Workplaces {
public:
    Workplaces(const Experiment& experiment, const ScenarioLoading& loading)
        : experiment_(experiment), loading_(loading) {}

    std::unique_ptr<Workplace> take();
    void giveBack(std::unique_ptr<Workplace> place);

private:
    const Experiment& experiment_;
    const ScenarioLoading& loading_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Workplace>> free_;
};

/// How often a run of a trial is looked at, in its ticks.
std::int64_t ticksBetweenLooks(const Experiment& experiment, const Scene& scene);

/// Of a run of this scenario, which has not begun. The experiment and the expressions must outlive it.
TrialMeasurement measurementOf(const Experiment& experiment, CompiledExpressions& compiled, const Scenario& scenario);

/// How a run of a trial goes on from where `measurement` began: until it is over or a controller fails, measured. What
/// is given must outlive the run.
RunOptions measuring(TrialMeasurement& measurement, const CompiledExpressions& compiled, const Experiment& experiment,
                     const Scenario& scenario, const DrawnValues& drawn);

/// Of a run in which an expression could not be answered: its fault.
void endByFault(RunResult& result, const Error& error);

/// What was measured, named as the columns of the experiment's results are.
struct MeasuredValue {
    std::string name;  ///< "feature.NAME", "measure.NAME"
    double value;      ///< NaN where it is not known
};
std::vector<MeasuredValue> measuredValues(const Experiment& experiment, const TrialMeasurement& measurement);

struct MeasuredRun {
    RunResult result;
    TrialMeasurement measurement;
};
/// Runs a variant of a trial with a seed, until it is over; that an expression cannot be answered is a fault. `goesOn`
/// is asked after every tick; may be empty. `countsUnfamiliar`: as of RunOptions. Error: of TrialExpressions::of().
Expected<MeasuredRun> measuredRun(const Experiment& experiment, TrialExpressions& expressions, const Scenario& scenario,
                                  const DrawnValues& drawn, std::uint64_t seed, const GoesOn& goesOn,
                                  bool countsUnfamiliar = false);
/// The same from where a trial branches; where it does not, its end is RunEnd::noBranch, or the fault before.
Expected<MeasuredRun> measuredRun(const Experiment& experiment, TrialExpressions& expressions, const BranchPoint& point,
                                  const Scenario& variant, std::uint64_t seed, const GoesOn& goesOn);

}  // namespace mrose
