#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace mrose {

/// The value that Student's t with so many degrees of freedom, 2 and more, is below with probability `p`, 0.5 to
/// 0.9999: by Cornish and Fisher's expansion about the normal quantile (Abramowitz and Stegun, 26.7.5), to 1 % from 5
/// degrees on.
double studentQuantile(double p, std::int64_t degrees);

/// A mean with its 95 % interval, by Student's t.
struct MeanInterval {
    double mean = 0, low = 0, high = 0;
};
MeanInterval meanInterval(std::span<const double> values);  ///< of two values or more

/// `a` - `b`, one by one, as far as both go.
std::vector<double> differences(std::span<const double> a, std::span<const double> b);

/// When a candidate is looked at while its trials are run, and whether it is dropped there: where it costs more than
/// the incumbent in the same trials by a paired, one-sided t-test. The looks share one probability of a false drop.
class Race {
public:
    static constexpr std::uint32_t firstLook = 8;
    static constexpr double falseDrops = 0.1;  ///< at most so often is one dropped that is as good as the incumbent

    /// Without `drops` it is looked at when all is run.
    Race(std::uint32_t trials, bool drops);

    const std::vector<std::uint32_t>& looks() const { return looks_; }  ///< after how many trials; the last: all
    bool drops(std::span<const double> costs, std::span<const double> incumbent) const;

private:
    std::vector<std::uint32_t> looks_;
};

}  // namespace mrose
