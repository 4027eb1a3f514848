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

std::vector<double> predictions(const TaskNetwork& network, const TaskData& data);  ///< [row][output]

/// The sum of absolute errors over the sum of absolute values, of rows for which there is a prediction.
double shareOff(const TaskData& data, const std::vector<double>& predicted);

}  // namespace mrose
