#pragma once

#include <string>

#include "assessment/evaluate.h"

namespace mrose {

/// What the models' own doubt is worth: scores of sampled rollouts beside those of a constant noise and of the mean
/// alone, and how often what happened lies where they say. Empty where no model has a noise.
std::string forecastSection(const Evaluation& evaluation);

/// "after 10 s, half of the samples ... 90 % within": for the head of the page; empty where the first model has none.
std::string forecastHeadline(const Evaluation& evaluation);

}  // namespace mrose
