#pragma once

#include "manipulation/kick_network.h"
#include "perception/reading_distribution.h"
#include "world/noise.h"
#include "world/time.h"

namespace mrose {

/// What a kick has done to a ball at rest.
struct KickDeparture {
    bool hit = false;
    double speed = 0;      ///< m/s
    double direction = 0;  ///< rad, in the robot's frame
};

/// A kick network made ready for use: const, so that robots and threads may share it. Inputs beyond what was seen count
/// as the nearest that was. The same bits wherever it is asked.
class LearnedKicker {
public:
    explicit LearnedKicker(KickNetwork network);

    const KickNetwork& network() const { return network_; }

    /// Whether a ball lies where balls were seen to be kicked, or missed: farther away none is.
    bool inReach(const Point& ball_B) const;

    /// Of the delay in s (its one dimension), given power and motion when it is commanded.
    ReadingDistribution delay(const KickState& state) const;
    /// Whether the ball leaves (probability()), and of its speed in m/s and its direction in rad from
    /// KickNetwork::direction (its two dimensions), given all when it acts.
    ReadingDistribution departure(const KickState& state) const;

    // Draws by counters: `key` with any part of its channel below 2^20 is the kick's; draws take the parts above.
    Nanoseconds drawDelay(const KickState& state, const NoiseKey& key) const;
    KickDeparture drawDeparture(const KickState& state, const NoiseKey& key) const;

private:
    std::vector<double> evaluate(const RegressorInference& part, int first, const KickState& state) const;

    KickNetwork network_;
    RegressorInference delay_, departure_;
};

}  // namespace mrose
