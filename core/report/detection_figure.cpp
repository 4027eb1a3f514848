#include "report/detection_figure.h"

#include <algorithm>
#include <cmath>

#include "drawing/svg.h"
#include "io/format.h"
#include "report/legend.h"
#include "report/page.h"
#include "report/view_plot.h"

namespace mrose {
namespace {

constexpr std::size_t fewestCases = 10;
constexpr int shareColours = 10;

bool isShown(const DetectionMap::Cell& cell) { return cell.cases >= fewestCases; }

/// The share that the last colour ends at, the same for both sides: a multiple of 20 %.
double highestShare(const DetectionMap& map) {
    double highest = 0.2;
    for (const DetectionMap::Cell& cell : map.cells)
        if (isShown(cell)) highest = std::max({highest, cell.real, cell.predicted});
    return 0.2 * std::ceil(5 * highest - 1e-9);
}

std::string shareClass(double share, double highest) {
    const int colour = static_cast<int>(share / highest * shareColours);
    return cat("v", std::to_string(std::clamp(colour, 0, shareColours - 1)));
}

}  // namespace

std::string detectionFigure(const SensorEvaluation& evaluation, DetectionSide side) {
    const DetectionMap& map = evaluation.map;
    const double far = map.ranges * map.rangeStep, wide = -map.firstBearing;
    const double highest = highestShare(map);
    const bool real = side == DetectionSide::real;
    ViewPlot view(far, wide,
                  cat("Share of the subjects that is reported, ", real ? evaluation.log.real() : "predicted"));
    view.cell(0, far, -wide, wide, "nothing");
    for (int b = 0; b < map.bearings; ++b)
        for (int r = 0; r < map.ranges; ++r) {
            const DetectionMap::Cell& cell = map.at(b, r);
            if (!isShown(cell)) continue;
            const double right = map.firstBearing + b * map.bearingStep;
            view.cell(r * map.rangeStep, (r + 1) * map.rangeStep, right, right + map.bearingStep,
                      shareClass(real ? cell.real : cell.predicted, highest));
        }
    view.scale();
    const double half = 0.5 * evaluation.view.fieldOfView, reach = std::min(far, evaluation.view.range);
    for (const double edge : {-half, half}) view.ray(0, reach, edge, "sight over");
    view.arc(reach, -half, half, "sight over");
    return view.text();
}

std::string shareLegend(const SensorEvaluation& evaluation) {
    constexpr double width = 26, height = 14, left = 22;
    constexpr int labels = 5;
    std::string marks;
    for (int i = 0; i < shareColours; ++i)
        marks += element("rect", {{"class", cat("v", std::to_string(i))},
                                  {"x", left + width * i},
                                  {"y", 0.0},
                                  {"width", width},
                                  {"height", height}});
    for (int i = 0; i < labels; ++i)
        marks += svgText({left + width * shareColours * i / (labels - 1), height + 15},
                         cat(fixed(100 * highestShare(evaluation.map) * i / (labels - 1), 0), " %"),
                         {{"class", "tick middle"}});
    const double whole = 2 * left + width * shareColours;
    const std::string scale = element("svg",
                                      {{"width", px(whole)},
                                       {"height", "32"},
                                       {"viewBox", cat("0 0 ", px(whole), " 32")},
                                       {"role", "img"},
                                       {"aria-label", "Colours by the share that is reported"}},
                                      marks);
    return legend(cat(element("span", "", cat(scale, "of the subjects there are reported")),
                      boxEntry("nothing", "fewer than 10 cases"),
                      lineEntry("sight", "field of view that the network’s file states")));
}

}  // namespace mrose
