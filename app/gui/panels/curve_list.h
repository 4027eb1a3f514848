#pragma once

#include <QPen>
#include <QTreeWidget>
#include <vector>

#include "widgets/theme.h"

namespace mrose::gui {

/// A legend of the plots with the numbers of an instant: the curves, and below them what they are held against.
class CurveList final : public QTreeWidget {
    Q_OBJECT

public:
    explicit CurveList(const QFont& font);

    struct Line {
        QPen pen;
        QString label, unit, tip;
    };
    void setLines(const std::vector<Line>& lines, const Theme& theme);
    /// Of a line. The column grows with its numbers and stays so: nothing jumps.
    void setNumber(int line, double number, int decimals);
};

}  // namespace mrose::gui
