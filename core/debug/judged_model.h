#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "debug/played_log.h"
#include "diagnosis/divergence_cause.h"
#include "io/progress.h"

namespace mrose {

/// A motion model by which the robots of a log are moved, and how true it is.
struct JudgedModel {
    /// As `mrose compare` has it, of the plan's rollouts: with contacts. As `mrose evaluate`, of its windows: through
    /// everything. nullopt: not known yet; an error: why it will not be.
    struct Figures {
        std::optional<Expected<ComparedSummary>> compared;
        std::optional<Expected<Summary>> evaluated;
    };
    std::string name, named;                ///< named: how it was asked for
    OtherModel moves;                       ///< robots for which it has none move as the scenario says
    std::shared_ptr<const LogWorld> world;  ///< in which they move by it
    std::string note = {};                  ///< that its figures mean little; empty: they do not
    bool shown = true;
    Figures figures = {};
    double judged = 1;  ///< share of the work on them; 1: no work is under way
};

/// The scenario's own model.
JudgedModel ownModel(const PlayedLog& log);
/// P, Hd and errors as of `mrose evaluate`: windows of that length, and no contacts. Error: as of evaluate().
Expected<Summary> evaluatedModel(const PlayedLog& log, const JudgedModel& model, Nanoseconds horizon,
                                 const Progress& progress);

/// What a model makes of one rollout, at each tick of the scenario. `goesOn` false: up to there.
Reality::ModelRollout modelRollout(const PlayedLog& log, const JudgedModel& model, const RolloutRequest& rollout,
                                   const GoesOn& goesOn);

/// How true a model is. What is known of it already is left out: `compared` of the scenario's own.
JudgedModel::Figures judge(const PlayedLog& log, const JudgedModel& model, const std::vector<RolloutRequest>& requests,
                           Nanoseconds horizon, const Progress& progress);

}  // namespace mrose
