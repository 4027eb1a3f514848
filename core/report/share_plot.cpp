#include "report/share_plot.h"

namespace mrose {

SvgPlot sharePlot(std::string_view description, std::string_view xTitle, std::string_view yTitle) {
    SvgPlot plot({.width = 350, .height = 340}, {0, 100}, {0, 100}, description);
    plot.axes(xTitle, yTitle);
    const Point diagonal[] = {{0, 0}, {100, 100}};
    plot.line(diagonal, "floorline");
    return plot;
}

}  // namespace mrose
