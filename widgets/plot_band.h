#pragma once

#include <qcustomplot.h>

#include "widgets/plot_view.h"

namespace mrose {

constexpr int leftMargin = 46, rightMargin = 12;  ///< pixels beside a plot's axes

struct PlotView::Band {
    QString unit;
    QCPAxisRect* rect = nullptr;
    QCPItemLine *now = nullptr, *mouse = nullptr, *instant = nullptr;
    std::vector<std::pair<std::size_t, QCPGraph*>> levels;  ///< with the level's index
    QCPItemRect* unknown = nullptr;                         ///< the ground where nothing has happened yet
    std::vector<std::pair<std::size_t, QCPGraph*>> graphs;  ///< with the curve's index
    std::vector<std::pair<std::size_t, QCPGraph*>> ahead;   ///< the same, of what has not happened yet
    QCPItemText* title = nullptr;
    QString called;  ///< all of its title

    QCPAxis* time() const { return rect->axis(QCPAxis::atBottom); }
    QCPAxis* value() const { return rect->axis(QCPAxis::atLeft); }
};

}  // namespace mrose
