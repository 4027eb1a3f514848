#include "motion/actuator_limits.h"

#include "io/format.h"

namespace mrose {

std::string limitsInWords(const ActuatorLimits& limits) {
    std::string text;
    const auto add = [&](double limit, std::string_view between, int decimals, std::string_view unit) {
        if (limit > 0)
            text += (text.empty() ? "" : std::string(between)) + fixed(limit, decimals) + ' ' + std::string(unit);
    };
    add(limits.accelerationV, "", 2, "m/s²");
    add(limits.accelerationW, " and ", 1, "rad/s²");
    if (limits.wheelSpeed > 0)
        text += (text.empty() ? "wheels " : ", wheels ") + fixed(limits.wheelSpeed, 2) + " m/s, " +
                fixed(2 * limits.halfTrack, 2) + " m apart";
    return text;
}

}  // namespace mrose
