#include "assessment/named_model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/point.h"
#include "world/seconds_text.h"

namespace mrose {

NamedModel NamedModel::same(std::string name, const MotionModel& model) {
    return {std::move(name), [&model](const std::string&) { return &model; }};
}

void fillTracked(const NamedModel& named, const Log& log, std::span<RolloutStart> starts,
                 std::span<const std::size_t> robots, TrackerHistories& histories) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const MotionModel* const model = named.forRobot(log.robots[robots[i]].robot);
        if (model != nullptr) starts[i].tracked = histories.of(*starts[i].trajectory, *model).at(starts[i].time);
    }
}

Expected<std::vector<std::vector<Pose>>> rollOut(const NamedModel& named, const Log& log,
                                                 std::span<const RolloutStart> starts,
                                                 std::span<const std::size_t> robots, const RolloutOptions& options) {
    std::map<std::size_t, std::vector<std::size_t>> byRobot;
    for (std::size_t i = 0; i < starts.size(); ++i) byRobot[robots[i]].push_back(i);
    std::vector<std::vector<Pose>> result(starts.size());
    for (const auto& [robot, indices] : byRobot) {
        const std::string& robotName = log.robots[robot].robot;
        const MotionModel* model = named.forRobot(robotName);
        if (model == nullptr) return fail(named.name, "knows no robot " + robotName);
        std::vector<RolloutStart> chosen;
        for (const std::size_t i : indices) chosen.push_back(starts[i]);
        auto poses = rollOut(*model, chosen, options);
        if (!poses) return fail(named.name, poses.error().cause);
        for (std::size_t k = 0; k < indices.size(); ++k) {
            if (!std::all_of((*poses)[k].begin(), (*poses)[k].end(),
                             [](const Pose& pose) { return isFinite(position(pose)) && std::isfinite(pose.heading); }))
                return fail(named.name, "predicts no finite pose for robot " + robotName + " from " +
                                            secondsText(chosen[k].time) + " s on");
            result[indices[k]] = std::move((*poses)[k]);
        }
    }
    return result;
}

}  // namespace mrose
