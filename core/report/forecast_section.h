#pragma once

#include <string>

#include "assessment/evaluate.h"

namespace mrose {

/// What the models' own doubt is worth: scores of sampled rollouts beside those of a constant noise and of the mean
/// alone, and how often what happened lies where they say. Empty where no model has a noise.
std::string forecastSection(const Evaluation& evaluation);

/// How much of what happened lies where the first model says, a sentence for the head of the page; empty where it says
/// nothing.
std::string forecastHeadline(const Evaluation& evaluation);

}  // namespace mrose
