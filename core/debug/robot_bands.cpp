#include "debug/robot_bands.h"

#include <algorithm>

#include "behaviour/command_player.h"

namespace mrose {

MotionSampler samplerOf(std::shared_ptr<const Scenario> scenario) {
    std::vector<bool> deciding;
    for (std::size_t robot = 0; robot < scenario->scene().robots.size(); ++robot)
        deciding.push_back(dynamic_cast<const CommandPlayer*>(&scenario->controller(robot)) != nullptr);
    return {std::move(scenario), std::move(deciding)};
}

std::optional<MotionBands> rolloutBands(const PlayedLog& log, const RolloutRequest& rollout, const GoesOn& goesOn,
                                        Nanoseconds longest) {
    MotionSampler::Options options;
    options.ahead = std::min<Nanoseconds>(longest, rollout.steps * WindowOptions{}.step);
    // All rollouts begin at tick 0: with the same seeds they would have the same draws.
    options.seed = sampleSeed(0, log.world().sessions()[rollout.session].name,
                              {.trajectory = &log.world().trajectory(rollout.session, 0), .time = rollout.start}, 0);
    const LogWorld::Opened opened = log.world().openAt(rollout.session, rollout.start, options.ahead, log.seed);
    return samplerOf(opened.scenario).bands(opened.state, options, goesOn);
}

}  // namespace mrose
