#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tasks/task_judgement.h"

namespace mrose {

// Pictures of what was learned of a task, judged by the trials that are held out; the first predictor is the one that
// the page is about.

/// What was predicted against what it came to, a dot for each row, of `output`.
std::string predictionFigure(const TaskJudgement& judgement, std::size_t output);

/// Inputs that are not the same in all rows: first those along which the mean errors of tenths of the rows differ most.
std::vector<std::size_t> inputsByError(const TaskJudgement& judgement);

/// The mean absolute error over tenths of the rows by what an input was, a line for each predictor that was learned or
/// guessed. Nothing where the input is the same in all rows.
std::string inputErrorFigure(const TaskJudgement& judgement, std::size_t input);
std::string inputErrorLegend(const TaskJudgement& judgement);

/// What each variant comes to, what is learned by its choices, and the best of each trial: bars with their means.
std::string choiceFigure(const TaskJudgement& judgement);

}  // namespace mrose
