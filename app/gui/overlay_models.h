#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "comparison/divergence_cause.h"
#include "overlay_world.h"

namespace mrose::gui {

/// A motion model by which the robots of an overlay are moved, and how true it is.
struct OverlayModel {
    std::string name;
    OtherModel moves;                       ///< robots for which it has none move as the scenario says
    std::shared_ptr<const LogWorld> world;  ///< in which they move by it
    bool shown = true;
    std::optional<ComparedSummary> compared;  ///< of the plan's courses, as `mrose compare` has it: with contacts
    std::optional<Summary> evaluated;         ///< of the windows that `mrose evaluate` has: through everything
};

/// The scenario's own model.
OverlayModel ownModel(const OverlayWorld& overlay);
/// `named`: a network's file, or the name of one that ships; or a kinematic model's (modelsToTry()). Error: there is no
/// such network, or it does not suit the scenario's ticks.
Expected<OverlayModel> overlayModel(const OverlayWorld& overlay, const std::string& named);
/// What may be added without any file at hand.
std::vector<std::string> modelNames(const OverlayWorld& overlay);

/// P, Hd and errors as of `mrose evaluate`: windows of that length, and no contacts. Error: as of evaluate().
Expected<Summary> evaluatedModel(const OverlayWorld& overlay, const OverlayModel& model, Nanoseconds horizon);

/// What a model makes of one course, at each tick of the scenario. `goesOn` false: up to there.
Reality::ModelCourse modelCourse(const OverlayWorld& overlay, const OverlayModel& model, const CourseRequest& course,
                                 const std::function<bool()>& goesOn);

}  // namespace mrose::gui
