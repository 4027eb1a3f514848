#include "widgets/curve_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mrose {
namespace {

constexpr float unknownNumber = std::numeric_limits<float>::quiet_NaN();

class PointWriter {
public:
    PointWriter(bool angle, QVector<QPointF>& points) : angle_(angle), points_(points) {}

    void add(std::int64_t tick, float value) {
        const auto x = static_cast<double>(tick);
        if (!points_.isEmpty() && points_.back().x() >= x) return;
        const bool round = angle_ && std::abs(static_cast<double>(value) - last_) > 180;
        if (round) points_.append({x - 0.5, std::numeric_limits<double>::quiet_NaN()});
        // Of a gap one point says enough.
        if (!std::isnan(value) || points_.isEmpty() || !std::isnan(points_.back().y()))
            points_.append({x, static_cast<double>(value)});
        last_ = static_cast<double>(value);
    }

private:
    bool angle_;
    QVector<QPointF>& points_;
    double last_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

void sampleCurve(const TickNumbers& numbers, std::int64_t from, std::int64_t to, std::int64_t step, bool angle,
                 QVector<QPointF>& points) {
    from = std::max(from, numbers.first);
    to = std::min(to, numbers.end() - 1);
    PointWriter writer(angle, points);
    if (step <= 1) {
        for (std::int64_t tick = from; tick <= to; ++tick) writer.add(tick, numbers.at(tick));
        return;
    }
    // Steps begin at multiples, so that a curve that scrolls does not flicker.
    for (std::int64_t begin = from; begin <= to;) {
        const std::int64_t end = std::min(to + 1, (begin / step + 1) * step);
        std::array<std::int64_t, 4> chosen{begin, begin, begin, end - 1};
        float least = std::numeric_limits<float>::infinity(), most = -least;
        const float* value = numbers.values.data() + (begin - numbers.first);
        for (std::int64_t tick = begin; tick < end; ++tick, ++value) {
            // Of what is unknown neither holds.
            if (*value < least) least = *value, chosen[1] = tick;
            if (*value > most) most = *value, chosen[2] = tick;
        }
        std::sort(chosen.begin(), chosen.end());
        for (const std::int64_t tick : chosen) writer.add(tick, numbers.at(tick));
        begin = end;
    }
}

}  // namespace mrose
