#pragma once

#include "scene/perception.h"
#include "sensing/sensor.h"

namespace mrose {

/// A camera of the reference cameras' class (reference_camera.h) for bodies. All constants are assumptions. Lengths in
/// m, angles in rad, times in s, pictures in pixels.
struct ReferenceSightParameters {
    double pixelsPerRadian = 500;
    double column = 4;                           ///< pixels that are told apart only so
    double columnNoise = 1.5, heightNoise = 3;   ///< Laplace's distribution
    double lens = 6;                             ///< pixels by which the picture's edge is distorted
    double blooming = 0.02;                      ///< share by which a body appears higher
    double robotHeight = 0.3;                    ///< objects are as high as they are wide
    double blindFrom = 0.24, blindTo = 0.31;     ///< bearings that a strut hides
    double halfSeen = 6.5, halfSeenWidth = 0.5;  ///< where half of the bodies are recognised
    double burstRate = 0.02, burstLength = 1.5;  ///< of glare: 1/s; it sees nothing
    double confused = 0.002;                     ///< share of bodies that are anywhere in the picture
    double farthest = 8, nearest = 0.5;          ///< of those that are

    bool operator==(const ReferenceSightParameters&) const = default;
};

/// What a robot with [perception] model = "reference" sees of other bodies, the readings "robots" and "objects":
/// bearings are columns of a picture, ranges follow from heights in whole pixels. Synthetic.
class ReferenceSight final : public Sensor {
public:
    /// Of the options it counts where they look, how late, and whether bodies hide others. `scale`: of all errors but
    /// gross ones and misses.
    ReferenceSight(const BodySight& robots, const BodySight& objects, double scale,
                   const ReferenceSightParameters& parameters = {})
        : robots_(robots), objects_(objects), scale_(scale), p_(parameters) {}

    struct Memory {
        std::uint64_t glare = 0;  ///< 1: within a burst
    };

    std::string name() const override { return "sight"; }
    std::vector<ReadingKind> gives() const override;
    Nanoseconds latency() const override { return std::max(robots_.latency, objects_.latency); }
    const BodySight* sight() const override { return &robots_; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    struct Bodies;
    void see(const SensorView& view, const BodySight& sight, const Bodies& bodies, std::vector<SeenBody>& seen) const;

    BodySight robots_, objects_;
    double scale_;
    ReferenceSightParameters p_;
};

}  // namespace mrose
