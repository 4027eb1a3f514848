#include "diagnosis/other_models.h"

#include <algorithm>
#include <string_view>

#include "motion/kinematic_baselines.h"
#include "motion/same_motion.h"

namespace mrose {

namespace {

/// What kinematic baselines are called beside other models: what each has more than the one before comes behind it.
constexpr std::string_view plainKinematics = "velocity = command";

}  // namespace

const MotionNetwork* networkOf(const LogWorld& world, std::size_t robot) {
    const auto* learned = learnedModel(world.parts().scene.modelOf(world.robots()[robot].body));
    return learned == nullptr ? nullptr : &learned->network();
}

OtherModel otherNetwork(const std::string& name, const std::shared_ptr<const LearnedMotion>& motion,
                        const LogWorld& world) {
    OtherModel other{name, {}};
    for (const ComparedRobot& robot : world.robots()) {
        auto model = std::make_shared<const LearnedModel>(motion, robot.realName);
        const bool same = sameMotion(*model, world.parts().scene.modelOf(robot.body));
        other.byRobot.push_back(same ? nullptr : std::move(model));
    }
    return other;
}

std::vector<OtherModel> otherKinematics(const LogWorld& world) {
    const Nanoseconds tick = world.parts().scene.tickLength;
    const std::size_t robots = world.robots().size();
    std::vector<OtherModel> others;
    for (std::size_t i = 0; i < robots; ++i) {
        const MotionNetwork* const network = networkOf(world, i);
        for (const auto& [name, parameters] :
             kinematicBaselines(network == nullptr ? MotionNetwork{} : *network, world.robots()[i].realName)) {
            const std::string called = name.starts_with("+") ? std::string(plainKinematics) + ' ' + name : name;
            auto other =
                std::find_if(others.begin(), others.end(), [&](const OtherModel& o) { return o.name == called; });
            if (other == others.end()) other = others.insert(others.end(), {called, {}});
            other->byRobot.resize(robots);
            other->byRobot[i] = std::make_shared<const KinematicModel>(parameters, tick);
        }
    }
    return others;
}

std::string briefName(const std::string& model) {
    if (!model.starts_with(plainKinematics)) return model;
    const std::string more = model.substr(plainKinematics.size());
    return more.starts_with(" + ") ? more.substr(1) : model;
}

}  // namespace mrose
