#include "drawing/svg.h"

#include <numbers>

namespace mrose {

SvgPath::SvgPath(std::span<const Point> points, bool closed) {
    bool lifted = true;
    for (const Point& point : points) {
        const bool draws = isFinite(point);
        if (draws) add(lifted ? 'M' : 'L', point);
        lifted = !draws;
    }
    if (closed) close();
}

SvgPath& SvgPath::add(char command, const Point& to) {
    text_ += command;
    text_ += cat(px(to.x), " ", px(to.y));
    return *this;
}

SvgPath& SvgPath::close() {
    text_ += 'Z';
    return *this;
}

SvgPath& SvgPath::operator+=(const SvgPath& more) {
    text_ += more.text_;
    return *this;
}

SvgArrow::SvgArrow(const Point& from, const Point& to, double headLength, double headWidth) {
    const Point along = (1 / length(to - from)) * (to - from), aside = headWidth / 2 * Point{-along.y, along.x};
    const Point neck = to - headLength * along, corners[] = {to, neck + aside, neck - aside}, ends[] = {from, neck};
    shaft = SvgPath(ends);
    head = SvgPath(corners, true);
}

SvgPath svgBar(const Point& from, const Point& to, double up, double down) {
    const Point ends[] = {from, to};
    SvgPath path(ends);
    for (const Point& end : ends) path.moveTo(end - Point{0, up}).lineTo(end + Point{0, down});
    return path;
}

std::string svgPath(const SvgPath& path, const Attributes& look) {
    return element("path", Attributes{{"d", path.text()}} + look);
}

std::string svgCircle(const Point& centre, double radius, const Attributes& look) {
    return element("circle", Attributes{{"cx", centre.x}, {"cy", centre.y}, {"r", radius}} + look);
}

std::string svgText(const Point& at, std::string_view text, const Attributes& look) {
    return element("text", Attributes{{"x", at.x}, {"y", at.y}} + look, escaped(text));
}

std::string svgHaloText(const Point& at, std::string_view text, const Attributes& look, std::string_view fill,
                        std::string_view halo, double haloWidth) {
    constexpr int copies = 8;
    std::string around;
    for (int i = 0; i < copies; ++i) {
        const Placement side({0, 0, 2 * std::numbers::pi * i / copies});
        around += svgText(at + side.rotate({haloWidth, 0}), text, {});
    }
    return element("g", look + Attributes{{"fill", halo}, {"aria-hidden", "true"}}, around) +
           svgText(at, text, look + Attributes{{"fill", fill}});
}

std::string svgClip(const Point& corner, double width, double height, std::string_view content) {
    const Attributes place{{"x", corner.x}, {"y", corner.y}, {"width", width}, {"height", height}};
    const std::string box = cat(px(corner.x), " ", px(corner.y), " ", px(width), " ", px(height));
    return element("svg", place + Attributes{{"viewBox", box}}, content);
}

}  // namespace mrose
