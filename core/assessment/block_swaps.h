#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace mrose {

/// Two streams cut into the same blocks: of a count in one block, how many there were and how many of them met a
/// condition, in either stream.
struct BlockCounts {
    double realOf = 0, real = 0, simulatedOf = 0, simulated = 0;
};

/// A number that one of the streams gave in a block.
struct BlockValue {
    double value = 0;
    std::uint32_t block = 0;
    bool simulated = false;
};

/// Whether two streams may well be of one kind.
struct TwoSampleTest {
    double statistic = std::numeric_limits<double>::quiet_NaN();
    double p = std::numeric_limits<double>::quiet_NaN();  ///< not a number where there are fewer than leastBlocks
    std::size_t blocks = 0;                               ///< in which there is anything
};

// Permutation tests: if both streams are of one kind, it does not matter which of a block's two halves is called real.
// Each of `blockSwaps` times about half of the blocks exchange theirs, and p is the share of all arrangements, the
// given one among them, in which the statistic is at least as large as it is. What depends on each other within a block
// stays together, so that p is as it should be however much it does, if blocks are independent: hundreds of readings
// that share one error count as one. The exchanges are functions of the block's number and of nothing else.

constexpr int blockSwaps = 999;
constexpr std::size_t leastBlocks = 8;  ///< of fewer, there are too few arrangements

/// The largest distance between the empirical distribution functions of two samples (Kolmogorov, Smirnov).
TwoSampleTest testDistributions(std::span<const BlockValue> values);

/// The difference between the shares of two streams: sum of `real` over sum of `realOf`, less the same of the
/// simulated.
TwoSampleTest testShares(std::span<const BlockCounts> blocks);

/// A share of a stream, with its standard error, in which blocks are independent and their inside is not.
struct BlockShare {
    std::size_t of = 0;  ///< cases
    double share = std::numeric_limits<double>::quiet_NaN(), error = std::numeric_limits<double>::quiet_NaN();
};
/// Of sums over blocks: sum of `met` over sum of `of` (a ratio estimator, linearised). Also a mean, where `met` is a
/// sum of values.
struct BlockSum {
    double of = 0, met = 0;
};
BlockShare shareOf(std::span<const BlockSum> blocks);

}  // namespace mrose
