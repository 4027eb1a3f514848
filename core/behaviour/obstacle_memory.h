#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "behaviour/motion_memory.h"
#include "behaviour/tracks.h"
#include "control/sensor_records.h"

namespace mrose {

/// A sensor by which a robot knows what is around it.
struct ObstacleSensor {
    enum class Kind { laser, sonar, infrared, bumpers };

    Kind kind = Kind::laser;
    ReadingName name;
    std::vector<Pose> elements;  ///< in the robot's frame, x along the axis; of a laser by ascending headings
    double halfWidth = 0;        ///< rad, of an element's cone or segment
    double range = 0;            ///< m; of bumpers how far the outline is from the reference point

    // Of infrared: what a surface gives back that an element faces is (reference / range)^2 + ambient.
    double reference = 0, ambient = 0;
    double leastIntensity = 0;  ///< above the ambient light's: less may be noise
};

/// Where sensors found something lately, as points of the frame in which the robot started by its odometry. Part of a
/// controller's memory; all zero it is empty.
struct ObstacleMemory {
    struct Found {
        float x, y;    ///< m
        float vx, vy;  ///< m/s, as far as it is known
        Nanoseconds measured;
    };
    static constexpr std::size_t capacity = 256;

    std::array<Found, capacity> points;
    std::array<std::uint8_t, capacity> sensors;  ///< by which each was found
    std::uint64_t count;                         ///< of points
    Pose odometry;                               ///< where the robot is
    Tracks tracks;                               ///< of what its lasers see move

    struct Options {
        double reach;        ///< m: what is farther from the robot is of no interest
        Nanoseconds memory;  ///< how long a point stays that no newer measurement confirms or refutes
    };
    /// `motion` has observed already. Of one laser the newest scan is all there is where it looks. An echo of a sonar
    /// or an infrared element, taken to come from its axis, refutes what it looks through; none is needed where another
    /// sensor's point explains it.
    void update(const Observation& observation, const MotionMemory& motion, std::span<const ObstacleSensor> known,
                const Options& options);

    std::span<const Found> found() const { return std::span(points).first(count); }

private:
    template <class Condition>
    void forget(Condition condition);
    void add(const Point& point, const Point& velocity, Nanoseconds measured, std::size_t sensor);
    void takeScan(std::span<const RangeEcho> echoes, const ObstacleSensor& laser, std::size_t sensor, const Pose& robot,
                  Nanoseconds measured, double reach);
    void takeEchoes(std::span<const double> ranges, const ObstacleSensor& ring, std::size_t sensor, const Pose& robot,
                    Nanoseconds measured, double reach);
};
static_assert(sizeof(ObstacleMemory) == 256 * 25 + 4 * 8 + sizeof(Tracks), "without padding");

}  // namespace mrose
