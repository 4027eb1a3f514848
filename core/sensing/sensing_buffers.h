#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "control/observation.h"
#include "control/sensor_records.h"
#include "perception/reading_distribution.h"
#include "scene/point_grid.h"
#include "scene/scene.h"
#include "sensing/beam_fan.h"
#include "sensing/cone_view.h"
#include "sensing/floor_lines.h"
#include "sensing/outlines.h"
#include "sensing/outlook.h"
#include "sensing/radio_traffic.h"
#include "sensing/simulated_view.h"
#include "world/past_poses.h"

namespace mrose {

/// Where all bodies were some ticks ago, arranged for looking.
struct BodyMap {
    std::int64_t lag = 0;
    double earlier = 0;            ///< than `lag` ticks ago: a share of a tick
    std::vector<Point> positions;  ///< by body: robots first, then objects
    PointGrid grid;                ///< of them
};

/// Memory that perceiving works in, kept from tick to tick for speed; its content never matters to the result, provided
/// that it is reset before the bodies of another state are perceived.
class SensingBuffers {
public:
    void forget() {
        used_ = 0;
        radio.forget();
        cores_.clear();
    }
    /// The same for all who perceive at this tick. Valid until forget().
    const BodyMap& bodiesBefore(const PastPoses& past, const WorldState& state, std::int64_t lag, double earlier = 0);

    /// Shape::core of each body, side by side: many are asked for, each once. Valid until forget().
    std::span<const double> coresOf(const Scene& scene);

    // Of one robot's observation.
    Outlook outlook;
    std::vector<SeenBody> seen;
    Outlines outlines;
    ConeView cone;
    std::vector<double> ranges;
    std::vector<std::uint32_t> owners;
    BeamFan fan;
    FloorLines floorLines;
    std::vector<ColourPixel> row;
    std::vector<ColourBlob> blobs;
    SimulatedView simulated;
    std::vector<SensedState> states;
    std::vector<std::uint32_t> which, reported;
    std::vector<double> numbers;
    std::vector<ReadingDraw> draws;
    std::vector<ReadingError> common, errors;
    std::vector<ReceivedMessage> received;
    RadioTraffic radio;  ///< of all

private:
    std::vector<std::unique_ptr<BodyMap>> maps_;  ///< the first `used_` of them are of this state
    std::size_t used_ = 0;
    std::vector<double> cores_;
};

}  // namespace mrose
