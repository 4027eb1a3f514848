#include "report/legend.h"

#include "drawing/svg.h"
#include "report/page.h"
#include "report/page_style.h"

namespace mrose {
namespace {

constexpr double sampleHeight = 12;                            // pixels
constexpr Point begin{1, 6}, middle{17, 6}, sampleEnd{33, 6};  // in it

std::string swatch(std::string_view marks) {
    return element("svg", {{"width", "34"}, {"height", "12"}, {"viewBox", "0 0 34 12"}, {"aria-hidden", "true"}},
                   marks);
}

std::string lineSample(std::string_view cssClass) {
    const Point ends[] = {begin, sampleEnd};
    return swatch(svgPath(SvgPath(ends), {{"class", cat("line ", cssClass)}}));
}

std::string entry(std::string_view sample, std::string_view label) {
    return element("span", "", cat(sample, escaped(label)));
}

}  // namespace

std::string seriesClass(std::size_t series) {
    return cat("s", std::to_string(series < seriesStyles ? series : 1 + (series - 1) % (seriesStyles - 1)));
}

std::string seriesName(const Assessment& assessment, std::size_t series) { return seriesName(assessment.name, series); }

std::string seriesName(std::string_view name, std::size_t series) {
    return cat("<span class=\"model\">", lineSample(seriesClass(series)), escaped(name), "</span>");
}

std::string lineEntry(std::string_view cssClass, std::string_view label) { return entry(lineSample(cssClass), label); }

std::string boxEntry(std::string_view cssClass, std::string_view label) {
    const Attributes box{{"class", cssClass}, {"x", begin.x}, {"y", 0.0}};
    return entry(swatch(element("rect", box + Attributes{{"width", 32.0}, {"height", sampleHeight}})), label);
}

std::string dotEntry(std::string_view cssClass, std::string_view label) {
    return entry(swatch(svgCircle(middle, 4.5, {{"class", cssClass}})), label);
}

std::string arrowEntry(std::string_view cssClass, std::string_view label) {
    SvgArrow arrow({6, 6}, {28, 6}, 6, 6);
    return entry(swatch(svgPath(arrow.shaft += arrow.head, {{"class", cat("arrow ", cssClass)}})), label);
}

std::string legend(std::string_view entries) { return element("div", "legend", entries); }

}  // namespace mrose
