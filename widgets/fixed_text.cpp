#include "widgets/fixed_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mrose {

QString fixedText(double value, int decimals) {
    if (!std::isfinite(value)) return QString::fromUtf8("\u2013");
    const double rounding = 0.5 * std::pow(10, -decimals);
    return QString::number(std::abs(value) < rounding ? 0.0 : value, 'f', decimals);
}

QString clockText(Nanoseconds time) {
    const double seconds = toSeconds(time);
    if (seconds < 60) return QString::number(seconds, 'f', 2) + " s";
    const auto minutes = static_cast<std::int64_t>(seconds / 60);
    const QString rest = QString::number(seconds - 60 * static_cast<double>(minutes), 'f', 2).rightJustified(5, '0');
    if (minutes < 60) return QString("%1:%2").arg(minutes).arg(rest);
    return QString("%1:%2:%3").arg(minutes / 60).arg(minutes % 60, 2, 10, QChar('0')).arg(rest);
}

QString logTimeText(Nanoseconds time) {
    const auto tenths = static_cast<std::int64_t>(std::llround(10 * toSeconds(std::max<Nanoseconds>(0, time))));
    const std::int64_t minutes = tenths / 600;
    const QString rest = QString::number(static_cast<double>(tenths % 600) / 10, 'f', 1).rightJustified(4, '0');
    if (minutes < 60) return QString("%1:%2").arg(minutes).arg(rest);
    return QString("%1:%2:%3").arg(minutes / 60).arg(minutes % 60, 2, 10, QChar('0')).arg(rest);
}

}  // namespace mrose
