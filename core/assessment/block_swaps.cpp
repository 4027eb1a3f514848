#include "assessment/block_swaps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "learning/parallel_for.h"
#include "world/noise.h"

namespace mrose {
namespace {

/// Which blocks exchange their halves in one arrangement; none in the first.
class Exchange {
public:
    Exchange(std::size_t arrangement, std::size_t blocks) {
        constexpr std::uint64_t seed = 0x6d726f7365;
        for (std::size_t word = 0; 64 * word < blocks; ++word)
            bits_.push_back(arrangement == 0 ? 0
                                             : noiseBits({seed, static_cast<std::int64_t>(arrangement),
                                                          static_cast<std::uint32_t>(word), 0}));
    }
    bool of(std::size_t block) const { return (bits_[block / 64] >> block % 64 & 1) != 0; }

private:
    std::vector<std::uint64_t> bits_;
};

/// `statistic` of each arrangement: that of the first, and the share of those that are as large.
template <class Statistic>
TwoSampleTest testBy(std::size_t blocks, std::size_t used, const Statistic& statistic) {
    TwoSampleTest test;
    test.blocks = used;
    test.statistic = statistic(Exchange(0, blocks));
    if (used < leastBlocks || std::isnan(test.statistic)) return test;
    std::vector<double> statistics(blockSwaps);
    parallelFor(statistics.size(), [&](std::size_t i) { statistics[i] = statistic(Exchange(i + 1, blocks)); });
    // the same differences, summed in another order
    const double least = test.statistic * (1 - 1e-9);
    const auto asLarge = std::ranges::count_if(statistics, [&](double other) { return !(other < least); });
    test.p = static_cast<double>(1 + asLarge) / (1 + blockSwaps);
    return test;
}

/// Both samples in one ascending order.
struct Merged {
    std::vector<BlockValue> values;
    std::vector<double> realOf, simulatedOf;  ///< by block: how many values

    explicit Merged(std::span<const BlockValue> from) : values(from.begin(), from.end()) {
        std::ranges::sort(values, {}, &BlockValue::value);
        for (const BlockValue& value : values) {
            realOf.resize(std::max<std::size_t>(realOf.size(), value.block + 1));
            simulatedOf.resize(realOf.size());
            (value.simulated ? simulatedOf : realOf)[value.block] += 1;
        }
    }
    std::size_t blocks() const { return realOf.size(); }
    std::size_t used() const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < blocks(); ++i) count += realOf[i] + simulatedOf[i] > 0;
        return count;
    }

    double distance(const Exchange& exchange) const {
        double reals = 0, simulateds = 0;
        for (std::size_t i = 0; i < blocks(); ++i) {
            reals += exchange.of(i) ? simulatedOf[i] : realOf[i];
            simulateds += exchange.of(i) ? realOf[i] : simulatedOf[i];
        }
        if (reals == 0 || simulateds == 0) return std::numeric_limits<double>::quiet_NaN();
        double real = 0, simulated = 0, most = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            (values[i].simulated != exchange.of(values[i].block) ? simulated : real) += 1;
            const bool lastOfEqual = i + 1 == values.size() || values[i + 1].value != values[i].value;
            if (lastOfEqual) most = std::max(most, std::abs(real / reals - simulated / simulateds));
        }
        return most;
    }
};

}  // namespace

TwoSampleTest testDistributions(std::span<const BlockValue> values) {
    const Merged merged(values);
    return testBy(merged.blocks(), merged.used(), [&](const Exchange& exchange) { return merged.distance(exchange); });
}

TwoSampleTest testShares(std::span<const BlockCounts> blocks) {
    const auto used =
        std::ranges::count_if(blocks, [](const BlockCounts& block) { return block.realOf + block.simulatedOf > 0; });
    return testBy(blocks.size(), static_cast<std::size_t>(used), [&](const Exchange& exchange) {
        BlockCounts sum;
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            const BlockCounts& block = blocks[i];
            const bool exchanged = exchange.of(i);
            sum.realOf += exchanged ? block.simulatedOf : block.realOf;
            sum.real += exchanged ? block.simulated : block.real;
            sum.simulatedOf += exchanged ? block.realOf : block.simulatedOf;
            sum.simulated += exchanged ? block.real : block.simulated;
        }
        return std::abs(sum.real / sum.realOf - sum.simulated / sum.simulatedOf);
    });
}

BlockShare shareOf(std::span<const BlockSum> blocks) {
    double of = 0, met = 0, squares = 0, used = 0;
    for (const BlockSum& block : blocks) {
        of += block.of;
        met += block.met;
        used += block.of > 0;
    }
    BlockShare result;
    result.of = static_cast<std::size_t>(of);
    if (of == 0) return result;
    result.share = met / of;
    for (const BlockSum& block : blocks) {
        const double off = block.met - result.share * block.of;
        squares += off * off;
    }
    if (used > 1) result.error = std::sqrt(squares * used / (used - 1)) / of;
    return result;
}

}  // namespace mrose
