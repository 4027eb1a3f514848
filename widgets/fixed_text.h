#pragma once

#include <QString>

#include "world/time.h"

namespace mrose {

/// A number as the window writes it, with a fixed number of digits and never "-0.00"; a dash where it is unknown.
QString fixedText(double value, int decimals);
/// "12.40 s", "1:02.40", "1:00:02.40": an instant of a run.
QString clockText(Nanoseconds time);

/// "0:12.4", "14:51.9", "1:00:02.4": an instant or a length of a log.
QString logTimeText(Nanoseconds time);

}  // namespace mrose
