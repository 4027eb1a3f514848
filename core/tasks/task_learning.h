#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/error.h"
#include "io/progress.h"
#include "learning/regressor.h"
#include "learning/task_network.h"
#include "tasks/task_data.h"

namespace mrose {

/// How a task is learned. Trials are held out whole: the `every`th are judged by and nothing else.
struct TaskLearning {
    RegressorFamily family = RegressorFamily::network;
    bool logarithmic = false;  ///< of a target above 0: relative errors count
    int hidden = 24;           ///< units of each member's network
    int members = 5;           ///< of the network, each learned without another part, by which it is chosen
    int trees = 60;
    std::uint64_t seed = 1;
    static constexpr int every = 5, offset = 0;
};

/// Learned from the rows that are not held out, with what it was seen at. Training says command and logs are empty: the
/// caller's. The same rows, options and seed give the same for any number of threads. Error: too few rows; a logarithm
/// of what is not above 0; `progress` ended it.
Expected<TaskNetwork> learnTask(const TaskData& data, const TaskLearning& how, const Progress& progress = {});

/// How well something predicts rows that it has not seen.
struct TaskScore {
    std::string name;
    std::size_t rows = 0;
    double absolute = 0, rootMeanSquare = 0, bias = 0;  ///< in the target's unit
    double share = 0;                                   ///< sum of absolute errors over sum of absolute values
    double shareLow = 0, shareHigh = 0;                 ///< its 95 % interval, by trials drawn with repetition
};
TaskScore scoreOf(const std::string& name, const TaskData& judged, const std::vector<double>& predicted);

std::vector<double> predictions(const TaskNetwork& network, const TaskData& data);

/// What is held out: what a learned network, each guess and the mean of what was learned from say of it.
std::vector<TaskScore> heldOutScores(const TaskData& data, const std::vector<TaskNetwork>& learned);

}  // namespace mrose
