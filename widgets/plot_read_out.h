#pragma once

#include <QLabel>
#include <cstdint>
#include <functional>
#include <vector>

#include "widgets/plot_axis.h"
#include "widgets/plot_curve.h"

namespace mrose {

/// A box beside the mouse with what curves are at a tick.
class PlotReadOut final : public QLabel {
public:
    explicit PlotReadOut(QWidget* parent);

    /// Beside the mouse, within a room, and where the curves that it covers cost the least.
    void place(const QPoint& mouse, const QRect& room, const std::function<int(const QRect& place)>& cost);

private:
    std::size_t place_ = 0;  ///< among those that it may have
};

/// Its text. `ghostName` is that of the other branch.
QString readOutText(const std::vector<PlotCurve>& curves, const QString& ghostName, const PlotAxis::Time& time,
                    std::int64_t tick);

}  // namespace mrose
