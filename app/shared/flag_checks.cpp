#include "shared/flag_checks.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

namespace mrose {

CLI::Validator numberRange(double least, double most) {
    const CLI::Range range(least, most);
    return range & CLI::Validator(
                       [](std::string& text) {
                           return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number"
                                                                                 : std::string();
                       },
                       "");
}

CLI::Validator someName() {
    return CLI::Validator(
        [](const std::string& text) { return text.empty() ? "is empty; expected a name" : std::string(); }, "");
}

namespace {

/// Whole numbers from `least` to `most`; `what` they are.
CLI::Validator wholeNumber(const char* what, std::uint64_t least, std::uint64_t most) {
    return CLI::Validator(
        [what, least, most](std::string& text) {
            std::uint64_t value = 0;
            const char* const end = text.data() + text.size();
            const auto parsed = std::from_chars(text.data(), end, value);
            if (parsed.ec == std::errc::result_out_of_range || (parsed.ec == std::errc() && value > most))
                return text + " is above " + std::to_string(most);
            if (parsed.ec == std::errc() && parsed.ptr == end && value >= least) return std::string();
            double number = 0;
            const auto below = std::from_chars(text.data(), end, number);
            return text + (below.ec == std::errc() && below.ptr == end && number < static_cast<double>(least)
                               ? " is below " + std::to_string(least)
                               : std::string(" is no ") + what + "; expected a whole number from " +
                                     std::to_string(least) + " on");
        },
        "");
}

}  // namespace

CLI::Validator someSeed() { return wholeNumber("seed", 0, std::numeric_limits<std::uint64_t>::max()); }

CLI::Validator someTrial() { return wholeNumber("trial", 1, std::numeric_limits<std::uint32_t>::max()); }

}  // namespace mrose
