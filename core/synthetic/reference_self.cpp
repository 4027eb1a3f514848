#include "synthetic/reference_self.h"

#include <algorithm>
#include <cmath>

#include "sensing/sensor_view.h"
#include "synthetic/localiser_errors.h"

namespace mrose {
namespace {

/// Measurements that are made up before the first, so that its error is like any later one.
constexpr std::uint32_t madeUp = 40;

/// The keys of a measurement in the world.
struct WorldKeys {
    const SensorView& view;
    std::uint32_t before = 0;  ///< which of those made up before it

    NoiseKey operator()(std::uint32_t draw, std::size_t part) const {
        static_assert(WorldLandmarks::most <= 64);
        const std::uint32_t drawn = draw * 64 + static_cast<std::uint32_t>(part);
        return view.key(NoiseChannel::selfLocalisation, before << 12 | drawn);
    }
};

/// Those within a localiser's view.
class InView {
public:
    InView(std::span<const Point> landmarks, const Pose& pose, double range, double fieldOfView) {
        for (std::size_t i = 0; i < landmarks.size(); ++i) {
            const Point offset = landmarks[i] - position(pose);
            const double away = length(offset);
            if (!(away <= range)) continue;
            const double bearing = wrapAngle(direction(offset) - pose.heading);
            if (std::abs(bearing) <= fieldOfView / 2) all_[size_++] = {i, away, bearing, offset};
        }
    }
    const LandmarkInView* begin() const { return all_.data(); }
    const LandmarkInView* end() const { return all_.data() + size_; }
    std::size_t size() const { return size_; }

private:
    std::array<LandmarkInView, WorldLandmarks::most> all_;
    std::size_t size_ = 0;
};

}  // namespace

ReferenceSelf::ReferenceSelf(const SelfLocalisation& options, double scale, WorldLandmarks landmarks,
                             const ReferenceLocaliserParameters& parameters)
    : latency_(options.latency), scale_(scale), landmarks_(std::move(landmarks)), p_(parameters) {}

bool ReferenceSelf::sound(std::span<const std::byte> memory) const {
    const auto& m = as<Memory>(memory);
    constexpr double farthest = 1e9;
    for (const Pose& pose : {m.belief, m.truth, m.self})
        for (const double number : {pose.x, pose.y, pose.heading})
            if (!(std::abs(number) <= farthest)) return false;
    return m.measured >= -latestTime && m.measured <= latestTime;
}

void ReferenceSelf::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    const auto& m = as<Memory>(memory);
    if (m.begun == 0) return;
    entries.add("synthetic", "reference localiser");
    entries.add("lasting_x", scale_ * m.belief.x, "m");
    entries.add("lasting_y", scale_ * m.belief.y, "m");
    entries.add("lasting_heading", scale_ * m.belief.heading, "rad");
}

void ReferenceSelf::sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const {
    using Errors = LocaliserErrors<WorldKeys>;
    auto& own = as<Memory>(memory);
    const WorldKeys keys{view};
    const Errors errors(p_, keys);
    const double jitter = p_.latencyJitter * (2 * errors.uniform(Errors::delay) - 1);
    const std::int64_t lag = std::max<std::int64_t>(0, view.lagOf(latency_ + fromSeconds(jitter)));
    const Pose pose = view.poseBefore(view.robot, lag);
    const double rotation = view.state.robots[view.robot].velocity_B.rotation;
    const InView seen(landmarks_.points, pose, p_.range, p_.fieldOfView);
    const double gain = 1 - power(1 - p_.gain, view.sinceLast / p_.period);
    if (own.begun == 0) {
        own.begun = 1;
        own.truth = pose;
        for (std::uint32_t before = 1; before <= madeUp; ++before) {
            const WorldKeys earlier{view, before};
            Errors(p_, earlier).correct(own.belief, seen, rotation, gain);
        }
    }
    errors.carryOn(own.belief, own.truth, pose);
    errors.correct(own.belief, seen, rotation, gain);
    own.truth = pose;
    const double rate = view.sinceLast * errors.burstRate(rotation), chance = errors.uniform(Errors::burst);
    own.within = (own.within != 0 ? chance < decay(view.sinceLast / p_.burstLength) : chance < rate) ? 1 : 0;
    if (own.within == 0) {
        own.self = errors.report(pose, own.belief, landmarks_.middle, scale_);
        own.measured = view.timeBefore(lag);
        own.localised = 1;
    }
    if (view.wants(0) && own.localised != 0) out.add(selfReading, own.measured, own.self);
}

}  // namespace mrose
