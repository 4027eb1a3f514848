// Of the real robots beside which simulated ones drive, and of how far those are off.
#include <cmath>

#include "geometry/point.h"
#include "quantities/quantity_tables.h"

namespace mrose {
namespace {

using Of = Quantity::Of;

const std::string& nameOf(const Subject& s) { return s.at.scene().robots[s.body].name; }

std::optional<Pose> realPose(const Subject& s) { return s.at.real->poseOf(nameOf(s), s.at.now()); }

double realVelocity(const Subject& s, double Velocity::*part) {
    const auto velocity = s.at.real->velocityOf(nameOf(s), s.at.now());
    return velocity ? (*velocity).*part : unknownNumber;
}

double errorOf(const Subject& s, double PoseError::*part) {
    const auto real = realPose(s);
    return real ? poseError(*real, poseOf(s)).*part : unknownNumber;
}

/// m, rad; in the real robot's frame
double errorAlong(const Subject& s, double Pose::*part) {
    const auto real = realPose(s);
    return real ? relative(*real, poseOf(s)).*part : unknownNumber;
}

double modelError(const Subject& s, double PoseError::*part) {
    const auto error = s.at.real->errorOf(std::string(s.item), nameOf(s), s.at.now());
    return error ? (*error).*part : unknownNumber;
}

template <bool heading>
std::vector<Quantity::Item> models(const Subject& s) {
    std::vector<Quantity::Item> items;
    for (const std::string& model : s.at.real->modelNames()) items.push_back({model, heading ? "rad" : "m"});
    return items;
}

}  // namespace

PoseError poseError(const Pose& real, const Pose& simulated) {
    return {distance(position(simulated), position(real)), std::abs(wrapAngle(simulated.heading - real.heading))};
}

void addRealQuantities(std::vector<Quantity>& all) {
    const char* const frame = "where the simulated robot is, as seen from the real one";
    const char* const truth = "by the log's ground truth";
    addQuantities(
        all, "Reality", Quantity::Needs::real,
        {{"error", centimetres, "from the real robot to the simulated one", Of::robot,
          +[](const Subject& s) { return errorOf(s, &PoseError::position); }},
         {"heading_error", angle, "between the real robot and the simulated one, without its sign", Of::robot,
          +[](const Subject& s) { return errorOf(s, &PoseError::heading); }},
         {"error_ahead", centimetres, frame, Of::robot, +[](const Subject& s) { return errorAlong(s, &Pose::x); }},
         {"error_left", centimetres, frame, Of::robot, +[](const Subject& s) { return errorAlong(s, &Pose::y); }},
         {"real_x", metres, truth, Of::robot, +[](const Subject& s) { return partOr(realPose(s), &Pose::x); }},
         {"real_y", metres, truth, Of::robot, +[](const Subject& s) { return partOr(realPose(s), &Pose::y); }},
         {"real_heading", angle, truth, Of::robot,
          +[](const Subject& s) { return wrapAngle(partOr(realPose(s), &Pose::heading)); }},
         {"real_v", metresPerSecond, "the slope of the ground truth, along its heading", Of::robot,
          +[](const Subject& s) { return realVelocity(s, &Velocity::v); }},
         {"real_w", radiansPerSecond, "the slope of the ground truth", Of::robot,
          +[](const Subject& s) { return realVelocity(s, &Velocity::w); }}});
    const char* const model = "of what a motion model makes of the same start and commands";
    addQuantities(all, "", Quantity::Needs::real,
                  {{"model_error", centimetres, model, Of::items,
                    +[](const Subject& s) { return modelError(s, &PoseError::position); }, false, models<false>, true},
                   {"model_heading_error", angle, model, Of::items,
                    +[](const Subject& s) { return modelError(s, &PoseError::heading); }, false, models<true>, true}});
}

}  // namespace mrose
