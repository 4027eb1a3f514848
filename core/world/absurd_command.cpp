#include "world/absurd_command.h"

#include <cmath>

#include "io/format.h"

namespace mrose {

std::string absurdity(const Command& command) {
    if (!std::isfinite(command.v) || !std::isfinite(command.w)) return "gave a command that is not finite";
    std::string absurd = absurdity(command.v, " m/s");
    if (absurd.empty()) absurd = absurdity(command.w, " rad/s");
    return absurd.empty() ? absurd : "gave a command of " + absurd;
}

std::string absurdity(double speed, const char* unit) {
    if (!isAbsurd(speed)) return {};
    return numberText(speed) + unit + "; expected at most " + fixed(absurdSpeed, 0) + unit;
}

}  // namespace mrose
