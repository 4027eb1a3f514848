#include "widgets/fixed_text.h"

#include <cmath>

namespace mrose {

QString fixedText(double value, int decimals) {
    if (!std::isfinite(value)) return QString::fromUtf8("\u2013");
    const double rounding = 0.5 * std::pow(10, -decimals);
    return QString::number(std::abs(value) < rounding ? 0.0 : value, 'f', decimals);
}

}  // namespace mrose
