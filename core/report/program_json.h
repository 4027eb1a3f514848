#pragma once

#include <string>
#include <vector>

#include "experiment/batch.h"
#include "experiment/experiment.h"
#include "experiment/run.h"
#include "experiment/trial_run.h"
#include "identification/log_inspection.h"
#include "identification/network_trainer.h"
#include "perception/sensor_network.h"
#include "recording/recording.h"
#include "recording/replay.h"
#include "tasks/task_judgement.h"
#include "validation/validation_results.h"

namespace mrose {

// Results as `mrose SUBCOMMAND --json` prints them, those of evaluate and compare apart. Keys end in their unit, what
// is not defined is null.

std::string inspectionJson(const LogInspection& inspection);

/// `file`: the network's; `seconds`: how long it took.
std::string trainingJson(const TrainedNetwork& trained, const std::string& file, double seconds);
std::string sensorTrainingJson(const SensorNetwork& network, const std::vector<std::string>& notices,
                               const std::string& file, double seconds);

/// What is said of a run beside its result.
struct RunNames {
    std::uint32_t trial = 0;
    std::string variant = {};  ///< of an experiment; "": it has none
    bool rewindChecked = false;
    std::string recording = {};  ///< "": none that is whole
    std::vector<MeasuredValue> measured = {};
};
std::string runJson(const Scenario& scenario, const RunResult& result, const RunNames& names);

/// `folder`: of results.csv.
std::string batchJson(const BatchSummary& summary, const std::string& folder);

std::string experimentJson(const ExperimentSummary& summary, const std::string& folder);

/// `folder`: of results.csv and the page.
std::string validationJson(const Validation& validation, const ValidationResult& result, const std::string& folder);

/// `file`: the network's.
std::string learnedTaskJson(const TaskData& data, const TaskJudgement& judgement, const std::string& file);

std::string replayJson(const Recording& recording, const ReplayReport& report);

}  // namespace mrose
