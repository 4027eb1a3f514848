#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common.h"
#include "identification/network_trainer.h"
#include "identification/recipes.h"

namespace mrose::cli {

/// What the command line says of a training; 0, "" or nothing where it leaves that to the model's recipe.
struct TrainFlags {
    std::vector<std::string> logs, robots;
    std::string out, model, type, method = "irprop+", loss;
    int hidden = 0, members = 0, epochs = 0, patience = 0, phases = 0, chain = 0, folds = 4, holdOutPart = 0;
    double holdOut = 0;
    std::string holdOutBy;
    std::optional<double> deadTimeV, deadTimeW, lagV, lagW;
};

/// What a model's network reads, and what its training defaults to.
struct Recipe {
    MotionNetwork (*blueprint)(const RobotTraits&, std::vector<std::string>, const ResponseTimes&);
    LearningLoss loss;
    int hidden, members, epochs, patience;
    int phases;  ///< of the period at which the logs are read
    int chain;   ///< periods
    double velocityWeight = RolloutLoss{}.velocityWeight;
};

void addTrainFlags(CLI::App& sub, TrainFlags& flags);

/// Of a model that addTrainFlags accepts.
const Recipe& recipeOf(const std::string& model);

/// The recipe's, unless the command line says otherwise.
NetworkTrainerOptions trainerOptions(const TrainFlags& flags, const CommonFlags& common);

/// Error: flags that do not go together.
Expected<void> checkTogether(const TrainFlags& flags);

/// What the models are, for the help.
extern const char* const modelsText;

}  // namespace mrose::cli
