#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification/network_trainer.h"
#include "io/progress.h"
#include "workflow/learning_logs.h"

namespace mrose {

/// What the networks that can be learned read (identification/recipes.h).
enum class NetworkRecipe { history, state, velocity, paper };
constexpr std::array<const char*, 4> networkRecipeNames{"history", "state", "velocity", "paper"};

/// From which logs a network is learned, and how. What is left open is as the recipe says.
struct TrainRequest {
    LearningLogsRequest logs;
    std::string output;                        ///< the network file; empty: it is written nowhere
    bool overwrite = false;                    ///< of a file that is there already
    std::optional<NetworkRecipe> recipe = {};  ///< velocity for robots that measure their own, history for others
    std::string robotKind = {};  ///< whose traits learning must know: a name or a robot file; empty: what the log says
    TrainingMethod method = TrainingMethod::irpropPlus;
    std::optional<LearningLoss> loss = {};
    int hidden = 0, members = 0, epochs = 0, patience = 0;  ///< 0: the recipe's, as the next two
    int phases = 0;                                         ///< of the period at which the logs are read
    int chain = 0;                                          ///< periods of a rollout that is learned from
    int folds = 4;
    std::optional<double> deadTimeV = {}, deadTimeW = {}, lagV = {}, lagW = {};  ///< s; otherwise those identified
    std::optional<bool> noise = {};  ///< whether it is learned too; by default of all recipes but the paper's
    std::uint64_t seed = 1;
    std::string command = {};  ///< what the network says that it was made by
};

/// How learning is watched and ended. Each may be empty.
struct TrainProgress {
    /// What is missing of the logs, a sentence each, as soon as they are read.
    std::function<void(const std::vector<std::string>& notes)> opened = {};
    NetworkProgressCallback learns = {};  ///< of the members of all networks that are learned, for the noise too
    Progress prepares = {};               ///< before that
    Progress fits = {};                   ///< the noise, after that
};

/// Reads the logs, identifies what the recipe needs, learns, and writes the network. Ended while it learns, the best
/// network so far is the result, and written, without noise. Error: of the logs, openLearningLogs(); of the kind of
/// robot; the file cannot be written, is there already or one of the logs; too little to learn from; it was cancelled
/// before.
Expected<TrainedNetwork> trainNetwork(const TrainRequest& request, const TrainProgress& progress = {});

/// Error, without a file and with the flag as its key: what does not go together.
Expected<void> checkTogether(const TrainRequest& request);

}  // namespace mrose
