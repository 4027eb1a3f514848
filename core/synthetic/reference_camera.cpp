#include "synthetic/reference_camera.h"

#include <algorithm>
#include <cmath>

#include "synthetic/field_landmarks.h"
#include "synthetic/sensor_noise.h"

namespace mrose {
namespace {

enum CameraChannel : std::uint32_t { cameraPhase = 400, stamped, glare, recognised, columnRead, heightRead, confusion };

class Camera {
public:
    Camera(const TruePath& path, std::uint64_t seed, const ReferenceCameraParameters& parameters)
        : path_(path), seed_(seed), p_(parameters) {}

    SensorLog run() {
        SensorLog log{.sensor = "camera"};
        const Nanoseconds period = fromSeconds(p_.period), phase = fromSeconds(p_.period * uniform(cameraPhase));
        for (Nanoseconds time = path_.begin() + phase; time <= path_.end(); time += period, ++look_) {
            const double late = p_.latency + p_.latencyJitter * (2 * uniform(stamped) - 1);
            Look& look = log.looks.emplace_back(Look{time + fromSeconds(late), {}});
            if (bursts_.goOn(p_.period, p_.burstRate, p_.burstLength, uniform(glare))) continue;
            for (const LandmarkInView& landmark : landmarksInView(path_.at(time), p_.range, p_.fieldOfView))
                if (recognises(landmark)) look.readings.push_back(readingOf(landmark));
        }
        return log;
    }

private:
    NoiseKey key(std::uint32_t channel, std::size_t part = 0) const {
        return {seed_, look_, static_cast<std::uint32_t>(part), channel};
    }
    double uniform(std::uint32_t channel) const { return uniformNoise(key(channel)); }

    bool recognises(const LandmarkInView& landmark) const {
        if (landmark.bearing > p_.blindFrom && landmark.bearing < p_.blindTo) return false;
        const double far = (landmark.range - p_.halfSeen) / p_.halfSeenWidth;
        return uniformNoise(key(recognised, landmark.subject)) < 1 / (1 + exponential(far));
    }

    double halfWidth() const { return p_.focalLength * sine(p_.fieldOfView / 2) / cosine(p_.fieldOfView / 2); }

    double bearingAt(double column) const {
        return arcTangent(p_.column * std::round(column / p_.column), p_.focalLength);
    }
    double rangeOf(double height) const {
        return p_.focalLength * p_.landmarkHeight / std::max(std::round(height), 4.0);
    }

    LogReading readingOf(const LandmarkInView& landmark) const {
        const NoisePair chance = uniformPair(key(confusion, landmark.subject));
        if (chance.first < p_.confused)
            return {landmark.subject, 0.5 + chance.second * (p_.range - 0.5),
                    bearingAt(halfWidth() * (2 * chance.first / p_.confused - 1))};
        const double column = p_.focalLength * sine(landmark.bearing) / cosine(landmark.bearing);
        const double share = column / halfWidth();
        const double height = p_.focalLength * p_.landmarkHeight / std::max(landmark.range, 0.3);
        return {landmark.subject,
                rangeOf((1 + p_.blooming) * height + p_.heightNoise * laplaceNoise(key(heightRead, landmark.subject))),
                bearingAt(column + p_.lens * share * share * share +
                          p_.columnNoise * laplaceNoise(key(columnRead, landmark.subject)))};
    }

    const TruePath& path_;
    std::uint64_t seed_;
    const ReferenceCameraParameters& p_;
    std::int64_t look_ = 0;
    Bursts bursts_;
};

}  // namespace

SensorLog photograph(const TruePath& path, std::uint64_t seed, const ReferenceCameraParameters& parameters) {
    return Camera(path, seed, parameters).run();
}

}  // namespace mrose
