#pragma once

#include "control/sensor_records.h"
#include "sensing/beam_fan.h"
#include "sensing/element_sensor.h"
#include "sensing/sensor_sources.h"

namespace mrose {

/// A row of a colour camera's pixels, each by the class of what its middle's ray meets first: NAME has a ColourPixel
/// for each, all of one instant, from right to left, as directions count; NAME.blobs has a ColourBlob for each run of
/// pixels of one class, in the order of their first pixels. All that stands is as high as the camera.
class LineCamera final : public ElementSensor {
public:
    static constexpr std::size_t mostPixels = 4096;

    struct Options {
        Pose mount;             ///< in the robot's frame
        std::size_t width = 1;  ///< pixels
        double view = 1;        ///< rad, from the outer edge of the first to that of the last
        BeamFan::Spacing spacing = BeamFan::Spacing::tangents;  ///< of pixels: a pinhole's, or an equiangular lens's
        double range = 0;                                       ///< m: farther away there is nothing
        /// m: where the row meets the floor, on a line across so far ahead, or of an equiangular lens on a circle; 0:
        /// it does not
        double floor = 0;
        double edgeNoise = 0;          ///< pixels, standard deviation of where a pixel's ray is
        double misclassification = 0;  ///< probability that a pixel has any one of the other classes
        std::vector<ColourClass> blobClasses;
        std::size_t leastBlob = 1;  ///< pixels
        Nanoseconds latency = 0;
    };
    LineCamera(const SensorTraits& traits, const Options& options);

    std::vector<ReadingKind> gives() const override {
        return {{pixels_, &recordType<ColourPixel>()}, {blobs_, &recordType<ColourBlob>()}};
    }
    std::vector<SensorElement> elements() const override;
    /// Of the largest blob of each class of Options::blobClasses its bearing and its pixels; 0 of classes without any.
    std::vector<MemoryEntry> summary(const Observation& all, const Reading& reading) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    /// How far it is along a ray to where the row meets the floor.
    double floorRange(const Point& along) const;
    const BeamFan& noisyFan(const SensorView& view) const;
    void look(const SensorView& view, std::span<ColourPixel> row) const;
    void misclassify(const SensorView& view, std::span<ColourPixel> row) const;
    void findBlobs(std::span<const ColourPixel> row, std::vector<ColourBlob>& blobs) const;
    ColourBlob blobOf(ColourClass colourClass, std::size_t first, std::size_t count) const;

    ReadingName pixels_, blobs_;
    Options options_;
    BeamFan fan_;
    Outlines::Sector sector_;
    std::vector<ColourPixel> row_;  ///< as it is where there is nothing
};

SensorPointer readLineCamera(TomlTable& table, const SensorTraits& traits, const SensorSources& sources);

}  // namespace mrose
