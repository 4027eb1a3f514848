#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/divergence_cause.h"

namespace mrose {

/// What is otherwise in the robot that made a log than in the one that is simulated.
enum class Planted {
    longerDeadTime,
    shorterDeadTime,
    startVelocity,  ///< it was turned just before the start
    contact,        ///< an obstacle that was not there
    otherModel,
    noise,
    blip,
    heldBlip,       ///< which the robot obeyed for much longer than it was told
    singleCommand,  ///< one that acted later or sooner than the others
    commandGap,
    truthGap,   ///< and moved meanwhile
    truthJump,  ///< farther than it could move
    // None of the listed causes.
    largerWheels,
    push,
    wrongPose,  ///< at the start
    scaledCommands
};
constexpr int plantedKinds = 16;
const char* name(Planted planted);
/// The cause to be named; nothing for the last ones.
std::optional<CauseKind> causeOf(Planted planted);

/// A log that the simulator made, with one thing changed, and what it is compared with. Synthetic: no real robot drove.
/// 11 s of one robot that is told something new every 0.5 to 1.1 s, tracked at 50 Hz with 1 mm and 1 mrad of noise.
struct PlantedLog {
    Log log;
    ScenarioParts parts;
    std::vector<OtherModel> models;
    RolloutRequest request;
    DivergenceBound bound;
};
PlantedLog plantedLog(Planted planted, std::uint64_t number);

}  // namespace mrose
