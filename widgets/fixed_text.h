#pragma once

#include <QString>

namespace mrose {

/// A number as the window writes it, with a fixed number of digits and never "-0.00"; a dash where it is unknown.
QString fixedText(double value, int decimals);

}  // namespace mrose
