#pragma once

#include <cstdint>
#include <memory>

namespace mrose::bench {

/// The peer: the benchmarks' scene (support/scenes.h) in plain Box2D, one world that lives on, stepped at 60 Hz, its
/// robots' velocities set ten times a second. No dead time, no motion model, no noise, and no way back.
class PlainBox2d {
public:
    PlainBox2d(std::uint32_t robots, bool heavy, std::uint64_t seed);
    ~PlainBox2d();
    PlainBox2d(PlainBox2d&&) noexcept;

    /// A tenth of a second.
    void run();
    /// Touching pairs now.
    int contacts() const;

private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace mrose::bench
