#include "synthetic/reference_localiser.h"

#include "synthetic/field_landmarks.h"
#include "synthetic/localiser_errors.h"
#include "synthetic/sensor_noise.h"

namespace mrose {
namespace {

constexpr std::uint32_t phaseChannel = 300;

/// The keys of a measurement along a logged path.
struct LogKeys {
    std::uint64_t seed;
    std::int64_t sample = 0;

    NoiseKey operator()(std::uint32_t draw, std::size_t part) const {
        return {seed, sample, static_cast<std::uint32_t>(part), phaseChannel + 1 + draw};
    }
};

class Localiser {
public:
    Localiser(const TruePath& path, std::uint64_t seed, const ReferenceLocaliserParameters& parameters)
        : path_(path), keys_{seed}, p_(parameters) {}

    SensorLog run() {
        using Errors = LocaliserErrors<LogKeys>;
        SensorLog log{.sensor = "localisation"};
        const Errors errors(p_, keys_);
        const double phase = uniformNoise({keys_.seed, 0, 0, phaseChannel});
        const Nanoseconds period = fromSeconds(p_.period);
        const Point middle{syntheticFieldLength / 2, syntheticFieldWidth / 2};
        Pose before = path_.at(path_.begin()), belief;
        Bursts bursts;
        for (Nanoseconds time = path_.begin() + fromSeconds(p_.period * phase); time <= path_.end();
             time += period, ++keys_.sample) {
            const Pose pose = path_.at(time);
            const double rotation = path_.velocityAt(time).w;
            errors.carryOn(belief, before, pose);
            errors.correct(belief, landmarksInView(pose, p_.range, p_.fieldOfView), rotation, p_.gain);
            before = pose;
            if (bursts.goOn(p_.period, errors.burstRate(rotation), p_.burstLength, errors.uniform(Errors::burst)))
                continue;
            const double late = p_.latency + p_.latencyJitter * (2 * errors.uniform(Errors::delay) - 1);
            log.poses.push_back({time + fromSeconds(late), errors.report(pose, belief, middle)});
        }
        return log;
    }

private:
    const TruePath& path_;
    LogKeys keys_;
    const ReferenceLocaliserParameters& p_;
};

}  // namespace

SensorLog localise(const TruePath& path, std::uint64_t seed, const ReferenceLocaliserParameters& parameters) {
    return Localiser(path, seed, parameters).run();
}

}  // namespace mrose
