#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "geometry/point.h"
#include "geometry/pose.h"
#include "synthetic/field_landmarks.h"
#include "synthetic/reference_localiser.h"
#include "synthetic/sensor_noise.h"

namespace mrose {

/// What a measurement of the reference localiser draws.
struct LocaliserDraw {
    enum Of : std::uint32_t {
        delay,
        sighting,  ///< of each landmark
        slip,
        turn,
        whiteX,
        whiteY,
        whiteHeading,
        whiteSpread,
        burst = whiteSpread + 3,
        jump,
        jumpDirection
    };
};

/// How the reference localiser errs, measurement by measurement, along a logged path or in the world. What it believes
/// less the truth, in the field's frame, is the caller's to keep. `Keys` gives the key of a draw: what it is of, and
/// of which landmark.
template <class Keys>
class LocaliserErrors : public LocaliserDraw {
public:
    LocaliserErrors(const ReferenceLocaliserParameters& parameters, const Keys& keys) : p_(parameters), key_(keys) {}

    double uniform(Of draw) const { return uniformNoise(key_(draw, 0)); }

    /// How often reports begin to be missing, 1/s.
    double burstRate(double rotation) const { return p_.burstRate + p_.turningBurstRate * rotation * rotation; }

    /// Odometry: what is driven and turned is not quite known.
    void carryOn(Pose& belief, const Pose& from, const Pose& to) const {
        const double way = distance(position(from), position(to)), rotation = std::abs(to.heading - from.heading);
        const NoisePair along = boxMullerPair(key_(slip, 0));
        const double off = p_.slip * std::sqrt(way);
        belief.x += off * along.first;
        belief.y += off * along.second;
        belief.heading += p_.turnSlip * std::sqrt(rotation) * boxMullerPair(key_(turn, 0)).first;
    }

    /// The fit to the bearings' errors, by the bearings' derivatives, takes the belief a part, `gain`, of the way
    /// along.
    template <class LandmarksInView>
    void correct(Pose& belief, const LandmarksInView& seen, double rotation, double gain) const {
        if (seen.size() < 2) return;
        const double blur = 1 + p_.blur * std::abs(rotation);
        const double near = squared(p_.bearingNoise / p_.priorPosition);
        Matrix3 normal{{{near, 0, 0}, {0, near, 0}, {0, 0, squared(p_.bearingNoise / p_.priorHeading)}}};
        Vector3 right{};
        for (const LandmarkInView& landmark : seen) {
            const double square = landmark.range * landmark.range + 1e-4;
            const Vector3 slope{landmark.offset.y / square, -landmark.offset.x / square, -1};
            const double off = blur * p_.bearingNoise * laplaceNoise(key_(sighting, landmark.subject)) +
                               p_.lens * sine(5 * landmark.bearing);
            for (std::size_t i = 0; i < 3; ++i) {
                right[i] += slope[i] * off;
                for (std::size_t j = 0; j < 3; ++j) normal[i][j] += slope[i] * slope[j];
            }
        }
        const Vector3 fit = solved(normal, right);
        belief.x += gain * (fit[0] - belief.x);
        belief.y += gain * (fit[1] - belief.y);
        belief.heading += gain * (fit[2] - belief.heading);
    }

    /// What is reported where the robot truly is at `pose`, in a field whose middle is `middle`. `scale`: of all errors
    /// but gross ones.
    Pose report(const Pose& pose, const Pose& belief, const Point& middle, double scale = 1) const {
        const auto white = [&](double deviation, std::uint32_t draw) {
            const NoiseKey spread = key_(whiteSpread + draw - whiteX, 0);
            return scale * (deviation / std::numbers::sqrt2 * studentNoise(key_(draw, 0), spread));
        };
        const double map = scale * p_.mapError;
        Pose reported{pose.x + scale * belief.x + map * sine(1.9 * pose.y) + white(p_.whitePosition, whiteX),
                      pose.y + scale * belief.y + map * sine(1.1 * pose.x) + white(p_.whitePosition, whiteY),
                      pose.heading + scale * belief.heading + white(p_.whiteHeading, whiteHeading)};
        const double chance = uniform(jump);
        if (chance < p_.mirrored)
            return {2 * middle.x - reported.x, 2 * middle.y - reported.y, reported.heading + std::numbers::pi};
        if (chance < p_.mirrored + p_.jump) {
            const Point there = p_.jumpDistance * towards(2 * std::numbers::pi * uniform(jumpDirection));
            reported.x += there.x;
            reported.y += there.y;
        }
        return reported;
    }

private:
    using Vector3 = std::array<double, 3>;
    using Matrix3 = std::array<Vector3, 3>;

    static double squared(double x) { return x * x; }

    /// Of a positive definite matrix, by elimination.
    static Vector3 solved(Matrix3 a, Vector3 b) {
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

    const ReferenceLocaliserParameters& p_;
    const Keys& key_;
};

}  // namespace mrose
