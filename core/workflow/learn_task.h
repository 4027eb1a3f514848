#pragma once

#include <string>
#include <vector>

#include "io/error.h"
#include "io/progress.h"
#include "tasks/task_judgement.h"
#include "tasks/task_learning.h"

namespace mrose {

/// What is learned of an experiment's results, and how.
struct LearnRequest {
    std::string results;  ///< the experiment's folder, or its results.csv
    TaskQuestion question;
    TaskLearning learning;
    bool families = false;     ///< learns the other families, too, to be judged beside it
    std::string output;        ///< the network file
    std::string report;        ///< a folder for a page about it and its predictions; "": none
    bool overwrite = false;    ///< of a file that is there already
    std::string command = {};  ///< what the network says that it was made by
};

struct LearnedTask {
    TaskNetwork network;
    TaskData data;
    TaskJudgement judgement;  ///< of the network first, then of the other families
};

/// Learns it and writes it. Error: as of readResultsTable(), taskData(), learnTask(); a file cannot be written, or is
/// there already; guesses beside what is learned by variant.
Expected<LearnedTask> learnTask(const LearnRequest& request, const Progress& progress = {});

}  // namespace mrose
