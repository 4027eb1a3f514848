#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/error.h"
#include "motion/learned_model.h"
#include "motion/noisy_model.h"
#include "scenario/description_library.h"
#include "scenario/robot_kind.h"
#include "scene/robot_type.h"

namespace mrose {

/// What a robot file describes.
struct RobotDescription {
    RobotType type;
    std::shared_ptr<const LearnedMotion> motion;  ///< learned; null where it moves otherwise
    std::string motionRobot;                      ///< which of the network's robots it is; "": the mean of them
    std::shared_ptr<const MotionModel> model;     ///< kinematics or the reference robot; null where it is learned
    MotionNoise motionNoise;                      ///< on either
    MotionDraw motionDraw = MotionDraw::mean;     ///< of the learned one

    Value::File file;               ///< what it was read from, with all that this names
    std::optional<RobotKind> kind;  ///< what logs and networks call such robots; nullopt where the file does not say

    double deadTime = 0;  ///< s, by which it answers: the mean of its speed's and its rotation's

    Nanoseconds controlPeriod() const { return motion ? motion->network().period : model->period(); }
};

/// A robot file (resources/README.md explains the keys). Error: file, line, column and key of the first thing wrong, in
/// it or in a file that it names.
Expected<RobotDescription> readRobot(const Value::File& file, DescriptionLibrary& library);

/// "kinematic motion", for people.
std::string motionKind(const RobotDescription& robot);

/// The same robot with another network as its motion; which of the network's robots it is stays where the network has
/// such. Error, a cause alone: the network is for another control period.
Expected<RobotDescription> movedBy(const MotionNetwork& network, RobotDescription robot, DescriptionLibrary& library);

}  // namespace mrose
