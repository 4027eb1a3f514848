#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "io/text_position.h"
#include "logs/conditioning.h"
#include "logs/decimal.h"

namespace mrose {

/// The text at `character` up to the next separator, shortened and made printable, for messages: `'12x4'`.
std::string quoted(std::string_view text, const char* character, std::string_view separators);

/// A number of a log: parseNumber within +-largestNumber, nullptr otherwise.
inline const char* parseSample(const char* begin, const char* end, double& value) {
    const char* const behind = parseNumber(begin, end, value);
    return behind != nullptr && std::abs(value) <= largestNumber ? behind : nullptr;
}

/// "expected a number within +-1e9, found '12x4'"
std::string noNumberCause(std::string_view text, const char* character, std::string_view separators, bool instant);

/// What is wrong where: `name:line:column: key: cause`.
tl::unexpected<Error> failAt(const std::string& name, std::string_view text, const char* character, std::string key,
                             std::string cause);

std::string backwardsCause(const ClockReset& reset, int latestLine);
constexpr std::size_t fewestRows = 2;
std::string tooShortCause(std::size_t rows);

/// "The last line of a.csv is cut off: it is left out."
std::string cutLineText(const std::string& path);
/// "a.csv has no rows", or that it has but one.
std::string tooShortText(const std::string& path, std::size_t rows);

/// Error where `samples`, in the order of the file, run backwards in time for good. lineOf(row) gives the line of a
/// sample; it is asked only for the message.
template <class Sample, class LineOf>
Expected<void> checkDirection(const std::vector<Sample>& samples, const std::string& name, LineOf lineOf) {
    const auto earlierThanLast = [](const Sample& a, const Sample& b) { return a.time < b.time; };
    if (std::is_sorted(samples.begin(), samples.end(), earlierThanLast)) return {};
    std::vector<Nanoseconds> times;
    times.reserve(samples.size());
    for (const Sample& sample : samples) times.push_back(sample.time);
    const auto reset = findClockReset(times);
    if (!reset) return {};
    return fail(name, backwardsCause(*reset, lineOf(reset->latestBefore)), lineOf(reset->row));
}

}  // namespace mrose
