#include "synthetic/reference_localiser.h"

#include <array>
#include <cmath>
#include <numbers>

#include "geometry/point.h"
#include "synthetic/field_landmarks.h"
#include "synthetic/sensor_noise.h"

namespace mrose {
namespace {

enum LocaliserChannel : std::uint32_t {
    localiserPhase = 300,
    delayed,
    sighted,
    slipped,
    turned,
    whiteX,
    whiteY,
    whiteHeading,
    whiteSpread,
    burst = whiteSpread + 3,
    jumped,
    jumpedWhere
};

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;

double squared(double x) { return x * x; }

/// Of a positive definite matrix, by elimination.
Vector3 solved(Matrix3 a, Vector3 b) {
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = k + 1; i < 3; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < 3; ++j) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    for (std::size_t k = 3; k-- > 0;) {
        for (std::size_t j = k + 1; j < 3; ++j) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return b;
}

class Localiser {
public:
    Localiser(const TruePath& path, std::uint64_t seed, const ReferenceLocaliserParameters& parameters)
        : path_(path), seed_(seed), p_(parameters) {}

    SensorLog run() {
        SensorLog log{.sensor = "localisation"};
        const Nanoseconds period = fromSeconds(p_.period), phase = fromSeconds(p_.period * uniform(localiserPhase));
        Pose before = path_.at(path_.begin());
        for (Nanoseconds time = path_.begin() + phase; time <= path_.end(); time += period, ++sample_) {
            const Pose pose = path_.at(time);
            const double rotation = path_.velocityAt(time).w;
            carryOn(before, pose);
            correct(pose, 1 + p_.blur * std::abs(rotation));
            before = pose;
            if (bursts_.goOn(p_.period, burstRate(rotation), p_.burstLength, uniform(burst))) continue;
            const double late = p_.latency + p_.latencyJitter * (2 * uniform(delayed) - 1);
            log.poses.push_back({time + fromSeconds(late), report(pose)});
        }
        return log;
    }

private:
    NoiseKey key(std::uint32_t channel, std::size_t part = 0) const {
        return {seed_, sample_, static_cast<std::uint32_t>(part), channel};
    }
    double uniform(std::uint32_t channel) const { return uniformNoise(key(channel)); }

    double burstRate(double rotation) const { return p_.burstRate + p_.turningBurstRate * rotation * rotation; }

    /// Odometry: what is driven and turned is not quite known.
    void carryOn(const Pose& from, const Pose& to) {
        const double way = distance(position(from), position(to)), turn = std::abs(to.heading - from.heading);
        const NoisePair along = boxMullerPair(key(slipped));
        const double off = p_.slip * std::sqrt(way);
        belief_.x += off * along.first;
        belief_.y += off * along.second;
        belief_.heading += p_.turnSlip * std::sqrt(turn) * boxMullerPair(key(turned)).first;
    }

    /// The fit to the bearings' errors, by the bearings' derivatives, takes the belief a part of the way along.
    void correct(const Pose& pose, double blur) {
        const auto seen = landmarksInView(pose, p_.range, p_.fieldOfView);
        if (seen.size() < 2) return;
        const double near = squared(p_.bearingNoise / p_.priorPosition);
        Matrix3 normal{{{near, 0, 0}, {0, near, 0}, {0, 0, squared(p_.bearingNoise / p_.priorHeading)}}};
        Vector3 right{};
        for (const LandmarkInView& landmark : seen) {
            const double square = landmark.range * landmark.range + 1e-4;
            const Vector3 slope{landmark.offset.y / square, -landmark.offset.x / square, -1};
            const double off = blur * p_.bearingNoise * laplaceNoise(key(sighted, landmark.subject)) +
                               p_.lens * sine(5 * landmark.bearing);
            for (std::size_t i = 0; i < 3; ++i) {
                right[i] += slope[i] * off;
                for (std::size_t j = 0; j < 3; ++j) normal[i][j] += slope[i] * slope[j];
            }
        }
        const Vector3 fit = solved(normal, right);
        belief_.x += p_.gain * (fit[0] - belief_.x);
        belief_.y += p_.gain * (fit[1] - belief_.y);
        belief_.heading += p_.gain * (fit[2] - belief_.heading);
    }

    Pose report(const Pose& pose) const {
        const auto white = [&](double deviation, std::uint32_t channel) {
            return deviation / std::numbers::sqrt2 * studentNoise(key(channel), key(whiteSpread + channel - whiteX));
        };
        Pose reported{pose.x + belief_.x + p_.mapError * sine(1.9 * pose.y) + white(p_.whitePosition, whiteX),
                      pose.y + belief_.y + p_.mapError * sine(1.1 * pose.x) + white(p_.whitePosition, whiteY),
                      pose.heading + belief_.heading + white(p_.whiteHeading, whiteHeading)};
        const double chance = uniform(jumped);
        if (chance < p_.mirrored)
            return {syntheticFieldLength - reported.x, syntheticFieldWidth - reported.y,
                    reported.heading + std::numbers::pi};
        if (chance < p_.mirrored + p_.jump) {
            const Point there = p_.jumpDistance * towards(2 * std::numbers::pi * uniform(jumpedWhere));
            reported.x += there.x;
            reported.y += there.y;
        }
        return reported;
    }

    const TruePath& path_;
    std::uint64_t seed_;
    const ReferenceLocaliserParameters& p_;
    std::int64_t sample_ = 0;
    Pose belief_;  ///< less the truth: in the field's frame
    Bursts bursts_;
};

}  // namespace

SensorLog localise(const TruePath& path, std::uint64_t seed, const ReferenceLocaliserParameters& parameters) {
    return Localiser(path, seed, parameters).run();
}

}  // namespace mrose
