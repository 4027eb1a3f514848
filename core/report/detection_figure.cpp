#include "report/detection_figure.h"

#include <algorithm>
#include <cmath>

#include "drawing/svg.h"
#include "report/legend.h"
#include "report/page.h"
#include "report/view_plot.h"

namespace mrose {
namespace {

constexpr std::size_t fewestCases = 10;
constexpr int shareColours = 10;

std::string shareClass(double share) {
    return cat("v", std::to_string(std::clamp(static_cast<int>(share * shareColours), 0, shareColours - 1)));
}

}  // namespace

std::string detectionFigure(const SensorEvaluation& evaluation, DetectionSide side) {
    const DetectionMap& map = evaluation.map;
    const double far = map.ranges * map.rangeStep, wide = -map.firstBearing;
    const bool real = side == DetectionSide::real;
    ViewPlot view(far, wide,
                  cat("Share of the subjects that is reported, ", real ? evaluation.log.real() : "predicted"));
    view.cell(0, far, -wide, wide, "nothing");
    for (int b = 0; b < map.bearings; ++b)
        for (int r = 0; r < map.ranges; ++r) {
            const DetectionMap::Cell& cell = map.at(b, r);
            if (cell.cases < fewestCases) continue;
            const double right = map.firstBearing + b * map.bearingStep;
            view.cell(r * map.rangeStep, (r + 1) * map.rangeStep, right, right + map.bearingStep,
                      shareClass(real ? cell.real : cell.predicted));
        }
    view.scale();
    for (const double side_ : {-0.5, 0.5})
        view.ray(0, std::min(far, evaluation.view.range), side_ * evaluation.view.fieldOfView, "sight");
    return view.text();
}

std::string shareLegend() {
    constexpr double width = 26, height = 14, left = 18;
    std::string marks;
    for (int i = 0; i < shareColours; ++i)
        marks += element("rect", {{"class", cat("v", std::to_string(i))},
                                  {"x", left + width * i},
                                  {"y", 0.0},
                                  {"width", width},
                                  {"height", height}});
    for (const int percent : {0, 20, 40, 60, 80, 100})
        marks += svgText({left + width * percent / 10, height + 15}, cat(std::to_string(percent), " %"),
                         {{"class", "tick middle"}});
    const double whole = 2 * left + width * shareColours;
    const std::string scale = element("svg",
                                      {{"width", px(whole)},
                                       {"height", "32"},
                                       {"viewBox", cat("0 0 ", px(whole), " 32")},
                                       {"role", "img"},
                                       {"aria-label", "Colours from 0 to 100 % reported"}},
                                      marks);
    return legend(cat(element("span", "", cat(scale, "of the subjects there are reported")),
                      boxEntry("nothing", "fewer than 10 cases"),
                      lineEntry("sight", "field of view that the network’s file states")));
}

}  // namespace mrose
