#pragma once

#include <QString>

#include "world/time.h"

namespace mrose {

/// A number as the window writes it, with a fixed number of digits and never "-0.00"; a dash where it is unknown.
QString fixedText(double value, int decimals);
/// "12.40 s", "1:02.40", "1:00:02.40": an instant of a run.
QString clockText(Nanoseconds time);

}  // namespace mrose
