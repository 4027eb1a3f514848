#include "quantities/quantity.h"

#include <limits>
#include <numbers>

namespace mrose {

double inDegrees(double radians) { return wrapAngle(radians) * 180 / std::numbers::pi; }

const char* Unit::shown() const { return isAngle() ? degreeSign : *other != '\0' ? other : name; }

double Unit::inShown(double number) const { return isAngle() ? inDegrees(number) : factor * number; }

QuantityValue Quantity::value(const Subject& subject) const {
    return std::visit([&](auto* reader) { return QuantityValue(reader(subject)); }, read);
}

double numberOf(const QuantityValue& value) {
    if (const double* const number = std::get_if<double>(&value)) return *number;
    if (const bool* const truth = std::get_if<bool>(&value)) return *truth ? 1 : 0;
    if (const auto* const count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace mrose
