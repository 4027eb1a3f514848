#include "shared/flag_checks.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
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

CLI::Validator someSeed() {
    return CLI::Validator(
        [](std::string& text) {
            std::uint64_t value = 0;
            const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
            if (parsed.ec == std::errc::result_out_of_range) return text + " is above 18446744073709551615";
            return text.starts_with('-') ? text + " is below 0" : std::string();
        },
        "");
}

}  // namespace mrose
