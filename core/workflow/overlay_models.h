#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/divergence_cause.h"
#include "workflow/overlay_world.h"

namespace mrose {

/// A motion model by which the robots of an overlay are moved, and how true it is.
struct OverlayModel {
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
OverlayModel ownModel(const OverlayWorld& overlay);
/// `named`: a network's file, or the name of one that ships; or a kinematic model's (modelsToTry()). Error: there is no
/// such network, or it does not suit the scenario's ticks.
Expected<OverlayModel> overlayModel(const OverlayWorld& overlay, const std::string& named);
/// What may be added without any file at hand.
std::vector<std::string> modelNames(const OverlayWorld& overlay);

/// P, Hd and errors as of `mrose evaluate`: windows of that length, and no contacts. Error: as of evaluate().
Expected<Summary> evaluatedModel(const OverlayWorld& overlay, const OverlayModel& model, Nanoseconds horizon,
                                 const std::function<bool(double share)>& progress);

/// What a model makes of one rollout, at each tick of the scenario. `goesOn` false: up to there.
Reality::ModelRollout modelRollout(const OverlayWorld& overlay, const OverlayModel& model,
                                   const RolloutRequest& rollout, const std::function<bool()>& goesOn);

}  // namespace mrose
