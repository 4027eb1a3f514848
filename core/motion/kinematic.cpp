#include "motion/kinematic.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/elementary.h"
#include "geometry/pose.h"

namespace mrose {
namespace {

using Channel = KinematicParameters::Channel;
constexpr double forever = std::numeric_limits<double>::infinity();

/// Velocity of one channel until its law changes: constant + slope t + transient exp(-t / lag).
struct VelocityProfile {
    double constant = 0, slope = 0, transient = 0, lag = 1;
    double lasts = forever;  ///< s until the acceleration limit lets go or the target is reached

    bool steady() const { return slope == 0 && transient == 0; }
    double velocity(double t) const {
        return constant + slope * t + (transient == 0 ? 0 : transient * exponential(-t / lag));
    }
    double travelled(double t) const {
        const double settled = transient == 0 ? 0 : -transient * lag * exponentialMinusOne(-t / lag);
        return constant * t + slope * t * t / 2 + settled;
    }
};

/// From `velocity` towards `target`: a ramp while the lag asks for more than the acceleration limit, then the lag.
VelocityProfile profileTo(double target, double velocity, const Channel& channel) {
    const double missing = target - velocity;
    const bool limited = channel.acceleration > 0;
    // A ramp ends where rounding would otherwise leave a remainder too short to advance time.
    const double ramp = limited ? std::abs(missing) / channel.acceleration - channel.lag : 0;
    if (ramp > 1e-12) return {velocity, std::copysign(channel.acceleration, missing), 0, 1, ramp};
    if (channel.lag > 0 && missing != 0) return {target, 0, -missing, channel.lag, forever};
    return {target, 0, 0, 1, forever};
}

double targetOf(double command, bool standing, const Channel& channel) {
    const double target = standing ? 0 : channel.gain * command + channel.bias;
    return channel.limit > 0 ? std::clamp(target, -channel.limit, channel.limit) : target;
}

/// Pose after `t` of both profiles, by Gauss and Legendre's rule with 8 points: position is an integral of known
/// functions of time, because heading does not depend on it.
Pose quadrature(const VelocityProfile& v, const VelocityProfile& w, double lateralPerRotation, double t) {
    constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                         0.9602898564975363};
    constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                           0.1012285362903763};
    Pose pose{0, 0, w.travelled(t)};
    for (int i = 0; i < 8; ++i) {
        const double at = t / 2 * (1 + (i < 4 ? -node[3 - i] : node[i - 4]));
        const double forward = v.velocity(at), left = lateralPerRotation * w.velocity(at);
        const auto [s, c] = sineCosine(w.travelled(at));
        const double share = t / 2 * weight[i < 4 ? 3 - i : i - 4];
        pose.x += share * (c * forward - s * left);
        pose.y += share * (s * forward + c * left);
    }
    return pose;
}

/// The same profile seen from `t` on.
VelocityProfile later(const VelocityProfile& profile, double t) {
    VelocityProfile rest = profile;
    rest.constant += profile.slope * t;
    if (profile.transient != 0) rest.transient *= exponential(-t / profile.lag);
    return rest;
}

/// Pieces that double in length from one lag on: each holds e times less of the transient than its quadrature can bear.
Pose integrate(VelocityProfile v, VelocityProfile w, double lateralPerRotation, double t) {
    if (v.steady() && w.steady()) return exp({v.constant * t, lateralPerRotation * w.constant * t, w.constant * t});
    constexpr double longest = 0.1;
    double piece = std::min({longest, v.transient != 0 ? v.lag : longest, w.transient != 0 ? w.lag : longest});
    Pose pose;
    while (t > 0) {
        piece = std::min(piece, t);
        pose = pose * quadrature(v, w, lateralPerRotation, piece);
        v = later(v, piece);
        w = later(w, piece);
        t -= piece;
        piece = std::min(2 * piece, longest);
    }
    return pose;
}

/// When a command issued in (known from, known to] next takes effect, or `end`.
Nanoseconds nextSwitch(const CommandView& commands, Nanoseconds now, Nanoseconds delay, Nanoseconds known,
                       Nanoseconds end) {
    for (std::size_t i = commands.size(); i-- > 0;) {
        const Nanoseconds issued = commands.issueTime(i);
        if (issued > known) continue;
        if (issued + delay <= now) break;
        end = std::min(end, issued + delay);
    }
    return end;
}

}  // namespace

Nanoseconds KinematicModel::lookBack() const {
    return fromSeconds(std::max(parameters_.v.deadTime, parameters_.w.deadTime));
}

bool KinematicModel::sameAs(const MotionModel& other) const {
    const auto* kinematic = dynamic_cast<const KinematicModel*>(&other);
    return kinematic != nullptr && kinematic->parameters_ == parameters_ && kinematic->period_ == period_;
}

MotionStep KinematicModel::step(const MotionInput& input) const {
    const auto& [v, w, lateralPerRotation] = parameters_;
    const Nanoseconds delayV = fromSeconds(v.deadTime), delayW = fromSeconds(w.deadTime);
    assert(delayV >= 0 && delayW >= 0);
    const CommandView& commands = input.commands;
    const Nanoseconds end = input.start + period_;
    MotionStep result{{}, input.velocity};
    for (Nanoseconds now = input.start; now < end;) {
        const double commandV = commands.at(std::min(now - delayV, input.start)).v;
        const double commandW = commands.at(std::min(now - delayW, input.start)).w;
        const bool standing = commandV == 0 && commandW == 0;
        const Nanoseconds next =
            nextSwitch(commands, now, delayV, input.start, nextSwitch(commands, now, delayW, input.start, end));
        for (double left = toSeconds(next - now); left > 0;) {
            const VelocityProfile profileV = profileTo(targetOf(commandV, standing, v), result.velocity.v, v);
            const VelocityProfile profileW = profileTo(targetOf(commandW, standing, w), result.velocity.w, w);
            const double t = std::min({left, profileV.lasts, profileW.lasts});
            result.increment = result.increment * integrate(profileV, profileW, lateralPerRotation, t);
            result.velocity = {profileV.velocity(t), profileW.velocity(t)};
            left -= t;
        }
        now = next;
    }
    return result;
}

void KinematicModel::predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const {
    assert(inputs.size() == steps.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) steps[i] = step(inputs[i]);
}

}  // namespace mrose
