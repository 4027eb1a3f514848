#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "scene/point_grid.h"
#include "scene/scene.h"
#include "world/world_state.h"

namespace mrose {

/// What becomes of a message at one of its receivers.
struct Transmission {
    enum class Outcome : std::uint8_t { received, lost, outOfRange };
    std::uint32_t message = 0;  ///< in WorldState::messages
    std::uint32_t to = 0;       ///< the robot
    Nanoseconds arrival = 0;
    Point position;  ///< m: where the receiver is
    Outcome outcome = Outcome::received;
};

/// The messages of a state that may be due, arranged by team, addressee and place; kept from tick to tick for its
/// memory.
class RadioTraffic {
public:
    void forget() { known_ = false; }

    /// What is due to a robot at this tick of what was sent to it and its team: that whose arrival lies after its last
    /// control instant; oldest first, equal ones in the order of sending. Broadcasts that are out of range are among
    /// them only up to `noted` times the range. `teams`: of all robots. Valid until the next call.
    std::span<const Transmission> due(const Scene& scene, std::span<const std::uint32_t> teams, const WorldState& state,
                                      std::uint32_t robot, double noted);

private:
    void arrange(const Scene& scene, std::span<const std::uint32_t> teams, const WorldState& state);
    void arrangeByPlace(const Scene& scene, const WorldState& state);
    void add(const Scene& scene, const WorldState& state, std::uint32_t message, std::uint32_t robot);

    bool known_ = false, byPlace_ = false;
    std::vector<std::uint32_t> teamBegins_, toBegins_;  ///< of each; one more than there are
    std::vector<std::uint32_t> toTeam_, toRobot_;       ///< messages: broadcasts by team, others by addressee
    std::vector<Point> places_;                         ///< of toTeam_
    PointGrid grid_;                                    ///< of them
    std::vector<Transmission> due_;
};

}  // namespace mrose
