#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "logs/conditioning.h"

namespace mrose {

/// One-based line and column of a character of a text.
struct TextPosition {
    int line = 1, column = 1;
};
TextPosition positionOf(std::string_view text, const char* character);

/// The text at `character` up to the next separator, shortened and made printable, for messages: `'12x4'`.
std::string quoted(std::string_view text, const char* character, std::string_view separators);

/// What is wrong where: `name:line:column: key: cause`.
tl::unexpected<Error> failAt(const std::string& name, std::string_view text, const char* character, std::string key,
                             std::string cause);

/// Error where `samples` (in the order of the file) are fewer than 2 or run backwards for good. lineOf(row) tells the
/// line of a sample; it is asked only for a message.
template <class Sample, class LineOf>
Expected<void> checkRows(const std::vector<Sample>& samples, const std::string& name, LineOf lineOf) {
    if (samples.size() < 2)
        return fail(name, "too short: " + std::to_string(samples.size()) + " rows of numbers; expected at least 2");
    bool ascending = true;
    for (std::size_t i = 1; i < samples.size(); ++i) ascending = ascending && samples[i - 1].time <= samples[i].time;
    if (ascending) return {};
    std::vector<Nanoseconds> times;
    for (const Sample& sample : samples) times.push_back(sample.time);
    const auto reset = findClockReset(times);
    if (!reset) return {};
    return fail(name,
                "time runs backwards for good: " + std::to_string(toSeconds(reset->behind)) + " s before line " +
                    std::to_string(lineOf(reset->latestBefore)),
                lineOf(reset->row));
}

}  // namespace mrose
