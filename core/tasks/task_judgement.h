#pragma once

#include <optional>
#include <string>
#include <vector>

#include "learning/bootstrap.h"
#include "learning/task_network.h"
#include "tasks/task_data.h"
#include "tasks/variant_choice.h"

namespace mrose {

/// How well something predicts rows that it has not seen.
struct TaskScore {
    std::size_t values = 0;                             ///< that there is a prediction for: rows times outputs
    double absolute = 0, rootMeanSquare = 0, bias = 0;  ///< in the target's unit
    double share = 0;                                   ///< sum of absolute errors over sum of absolute values
    Interval shareInterval;                             ///< of 95 %, by trials drawn with repetition
};
TaskScore scoreOf(const TaskData& judged, const std::vector<double>& predicted);

/// What is held out, and what of it is said by what was learned, by guesses, and by the mean of what was learned from.
struct TaskJudgement {
    struct Predictor {
        std::string name;
        std::vector<double> predicted;  ///< [row][output] of what is held out
        TaskScore score;
        std::optional<VariantChoice> choice;  ///< by variant, of what was learned
    };
    TaskData heldOut;
    std::size_t learnedFrom = 0;  ///< rows
    std::vector<Predictor> predictors;
};
TaskJudgement judge(const TaskData& data, const std::vector<TaskNetwork>& learned, bool greatest = false);

}  // namespace mrose
