#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrose {

/// Which bodies of a cluster touched one another in this tick, directly or through others: an island is named by its
/// first body. The ground joins nobody.
class Islands {
public:
    /// All apart.
    void separate(std::size_t bodies);
    std::uint32_t of(std::uint32_t body);
    void join(std::uint32_t a, std::uint32_t b);

    /// Pairs that an island has solved for after the tick's start.
    std::size_t effort(std::uint32_t island) const { return effort_[island]; }
    void addEffort(std::uint32_t island, std::size_t pairs) { effort_[island] += pairs; }

private:
    std::vector<std::uint32_t> parent_;  ///< of each body: another one of its island, or itself
    std::vector<std::size_t> effort_;
};

}  // namespace mrose
