#pragma once

#include <string>
#include <vector>

#include "io/error.h"
#include "io/progress.h"
#include "tasks/task_learning.h"

namespace mrose {

/// What is learned of an experiment's results, and how.
struct LearnRequest {
    std::string results;  ///< the experiment's folder, or its results.csv
    TaskQuestion question;
    TaskLearning learning;
    bool families = false;     ///< learns the other families, too, to be judged beside it
    std::string output;        ///< the network file
    bool overwrite = false;    ///< of a file that is there already
    std::string command = {};  ///< what the network says that it was made by
};

struct LearnedTask {
    TaskNetwork network;
    TaskData data;
    std::size_t heldOut = 0;        ///< rows
    std::vector<TaskScore> scores;  ///< on what is held out: of the network first
};

/// Learns it and writes it. Error: as of readResultsTable(), taskData(), learnTask(); the file cannot be written, or is
/// there already.
Expected<LearnedTask> learnTask(const LearnRequest& request, const Progress& progress = {});

}  // namespace mrose
