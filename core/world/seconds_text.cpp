#include "world/seconds_text.h"

#include "io/format.h"

namespace mrose {

std::string plainSeconds(Nanoseconds duration) { return numberText(static_cast<double>(duration) / 1e9); }

std::string secondsText(Nanoseconds time, int leastDecimals) {
    const bool negative = time < 0;
    // Unsigned, so that the smallest number has an absolute value too.
    const auto magnitude = negative ? 0 - static_cast<unsigned long long>(time) : static_cast<unsigned long long>(time);
    std::string decimals = std::to_string(magnitude % nanosecondsPerSecond);
    decimals.insert(0, 9 - decimals.size(), '0');
    while (decimals.size() > static_cast<std::size_t>(leastDecimals) && decimals.back() == '0') decimals.pop_back();
    const std::string whole = std::to_string(magnitude / nanosecondsPerSecond);
    return (negative ? "-" : "") + whole + (decimals.empty() ? "" : "." + decimals);
}

}  // namespace mrose
