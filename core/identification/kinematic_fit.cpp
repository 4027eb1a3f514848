#include "identification/kinematic_fit.h"

#include "identification/response_fit.h"

namespace mrose {
namespace {

KinematicParameters::Channel toChannel(const ResponseFit& fit) {
    KinematicParameters::Channel channel{.deadTime = fit.kernel.deadTime, .lag = fit.kernel.lag};
    channel.gain = fit.coefficients[0];
    if (fit.coefficients.size() > 1) channel.bias = fit.coefficients[1];
    return channel;
}

Expected<KinematicParameters::Channel> fitChannel(std::span<const RobotLog> robots, Channel channel, KinematicFit fit,
                                                  const std::string& source) {
    const bool dynamic = fit == KinematicFit::dynamic;
    DelayedResponse response(channel, dynamic ? StaticMap::affine : StaticMap::command);
    for (const RobotLog& robot : robots)
        for (const Trajectory& trajectory : robot.trajectories) response.add(trajectory);
    if (response.windows() < fewestWindows) return fail(source, "too little ground truth beside commands");
    if (response.switches() == 0) return KinematicParameters::Channel{};
    return toChannel(fitResponse(std::move(response), {.lag = dynamic, .jitter = false, .coefficients = dynamic}));
}

/// Sideways displacement per rotation, by least squares.
double fitLateral(std::span<const RobotLog> robots) {
    double product = 0, square = 1e-12;
    for (const RobotLog& robot : robots)
        for (const Trajectory& trajectory : robot.trajectories)
            for (const auto& window : motionWindows(trajectory).windows) {
                product += window.left * window.rotation;
                square += window.rotation * window.rotation;
            }
    return product / square;
}

}  // namespace

Expected<KinematicParameters> fitKinematics(std::span<const RobotLog> robots, KinematicFit fit,
                                            const std::string& source) {
    const auto v = fitChannel(robots, Channel::v, fit, source);
    if (!v) return tl::unexpected(v.error());
    const auto w = fitChannel(robots, Channel::w, fit, source);
    if (!w) return tl::unexpected(w.error());
    KinematicParameters parameters{*v, *w};
    if (fit == KinematicFit::dynamic) parameters.lateralPerRotation = fitLateral(robots);
    return parameters;
}

}  // namespace mrose
