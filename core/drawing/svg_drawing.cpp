#include "drawing/svg_drawing.h"

#include <algorithm>
#include <cmath>

#include "drawing/label_placement.h"
#include "drawing/svg.h"
#include "io/format.h"

namespace mrose {
namespace {

// Pixels.
constexpr double margin = 28, titleHeight = 66, footHeight = 46, leastWidth = 420;
constexpr double titleSize = 20, textSize = 14, legendLine = 24, sampleWidth = 34, entryGap = 22;
constexpr double arrowHead = 10, headShare = 1 / 1.3;  // of its length is how wide it is
constexpr std::string_view ink = "#222222", quiet = "#666666", ground = "#ffffff";

std::string hexadecimal(const Colour& colour) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t channel : {colour.red, colour.green, colour.blue})
        (text += digits[channel >> 4]) += digits[channel & 15];
    return text;
}

/// The largest of 1, 2 and 5 times a power of ten up to `most`.
double roundLength(double most) {
    const double power = std::pow(10, std::floor(std::log10(most)));
    return most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
}

/// About how wide a text is; letters differ.
double textWidth(std::string_view text, double size) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return 0.6 * size * static_cast<double>(letters);
}

std::string plainText(const Point& at, std::string_view text, double size = textSize, std::string_view fill = ink) {
    return svgText(at, text, {{"font-size", size}, {"fill", fill}});
}

/// `at` is the middle of its base line.
std::string labelText(const Point& at, std::string_view text) {
    return svgHaloText(at, text, {{"font-size", textSize}, {"text-anchor", "middle"}}, ink, ground, 2);
}

/// `scale`: pixels in a metre.
Attributes look(const SvgDrawing::Style& style, double scale) {
    Attributes look{{"fill", style.fill ? hexadecimal(*style.fill) : "none"}};
    if (style.stroke) {
        look += {{"stroke", hexadecimal(*style.stroke)},
                 {"stroke-width", style.strokeWidth * (style.strokeInMetres ? scale : 1)}};
        if (style.dashed || style.dotted) look += {{"stroke-dasharray", style.dashed ? "4 3" : "1 4"}};
        look += {{"stroke-linejoin", "round"}};
    }
    if (style.opacity < 1) look += {{"opacity", style.opacity}};
    return look;
}

/// An arrow head about a point; `turn` is clockwise, as the page has it from above.
std::string pointerAt(const Point& at, double turn, double size, const Attributes& look) {
    const Placement placed({at.x, at.y, turn});
    Polygon corners;
    for (const Point& corner : {Point{0.6, 0}, Point{-0.4, -0.42}, Point{-0.2, 0}, Point{-0.4, 0.42}})
        corners.push_back(placed.place(size * corner));
    return svgPath(SvgPath(corners, true), look);
}

std::string arrowFromTo(const Point& from, const Point& to, std::string_view colour) {
    const double size = length(to - from), head = std::min(arrowHead, size / 2);
    if (size < 1) return {};
    const SvgArrow arrow(from, to, head, headShare * head);
    const auto line = [](std::string_view stroke, double wide) {
        return Attributes{{"fill", "none"}, {"stroke", stroke}, {"stroke-width", wide}};
    };
    return svgPath(arrow.shaft, line(ground, 4.5)) +
           svgPath(arrow.head, {{"fill", ground}, {"stroke", ground}, {"stroke-width", 3.0}}) +
           svgPath(arrow.shaft, line(colour, 2)) + svgPath(arrow.head, {{"fill", colour}});
}

std::string sample(const SvgDrawing::LegendEntry& entry, const Point& at) {
    using Symbol = SvgDrawing::LegendEntry::Symbol;
    const Attributes style = look(entry.style, 1);
    const Point ends[] = {at, at + Point{sampleWidth, 0}}, middle = 0.5 * (ends[0] + ends[1]);
    return entry.symbol == Symbol::line  ? svgPath(SvgPath(ends), style)
           : entry.symbol == Symbol::dot ? svgCircle(middle, 6, style)
                                         : pointerAt(middle, 0, 15, style);
}

}  // namespace

/// Where metres lie on the page.
struct SvgDrawing::Page {
    Point least;
    double scale = 1, top = 0, shownWidth = 0, shownHeight = 0;  ///< pixels in a metre; pixels
    double width = 0;                                            ///< within the margins
    std::string legend = {};

    Page(const Area& area, const Frame& frame) : least(area.least) {
        const Point size = area.most - area.least;
        scale = frame.longestSide / std::max({size.x, size.y, 1e-3});
        shownWidth = size.x * scale;
        shownHeight = size.y * scale;
        // A narrow picture has room for its words all the same.
        width =
            std::max({shownWidth, leastWidth, textWidth(frame.title, titleSize), textWidth(frame.subtitle, textSize)});
        top = titleHeight;
        if (!frame.legend.empty()) addLegend(frame.legend);
    }

    double pageWidth() const { return width + 2 * margin; }
    double pageHeight() const { return top + shownHeight + margin + footHeight; }
    PageBox box() const { return {margin, top, margin + shownWidth, top + shownHeight}; }
    Point onPage(const Point& p) const {
        return {margin + (p.x - least.x) * scale, top + shownHeight - (p.y - least.y) * scale};
    }
    Polygon onPage(std::span<const Point> points) const {
        Polygon placed;
        for (const Point& point : points) placed.push_back(onPage(point));
        return placed;
    }

    std::string grid(double step) const {
        SvgPath lines;
        const PageBox shown = box();
        const Point most = least + Point{shownWidth / scale, shownHeight / scale};
        for (double i = std::ceil(least.x / step); i * step <= most.x; ++i) {
            const double x = onPage(Point{i * step, 0}).x;
            lines.moveTo({x, shown.top}).lineTo({x, shown.bottom});
        }
        for (double i = std::ceil(least.y / step); i * step <= most.y; ++i) {
            const double y = onPage(Point{0, i * step}).y;
            lines.moveTo({shown.left, y}).lineTo({shown.right, y});
        }
        return svgPath(lines, {{"fill", "none"}, {"stroke", "#e6e6e6"}});
    }

    std::string scaleBar(double length) const {
        const Point from{margin, pageHeight() - 24}, to = from + Point{length * scale, 0};
        const std::string unit = length < 0.01 ? fixed(length * 1000, 0) + " mm"
                                 : length < 1  ? fixed(length * 100, 0) + " cm"
                                               : fixed(length, 0) + " m";
        return svgPath(svgBar(from, to, 4, 4), {{"fill", "none"}, {"stroke", ink}, {"stroke-width", 1.5}}) +
               plainText(to + Point{8, 5}, unit);
    }

private:
    /// Below the title, in as many lines as it takes.
    void addLegend(const std::vector<LegendEntry>& entries) {
        Point at{margin, titleHeight + 2};
        for (const LegendEntry& entry : entries) {
            const double wide = sampleWidth + 8 + textWidth(entry.text, textSize);
            if (at.x > margin && at.x + wide > margin + width) at = {margin, at.y + legendLine};
            legend += sample(entry, at) + plainText(at + Point{sampleWidth + 8, 5}, entry.text);
            at.x += wide + entryGap;
        }
        top = at.y + legendLine;
    }
};

void SvgDrawing::avoid(const Style& style, std::span<const Point> points) {
    if (style.labelsAvoid) avoided_.emplace_back(points.begin(), points.end());
}

void SvgDrawing::outline(std::span<const Point> points, bool closed, const Style& style) {
    if (std::none_of(points.begin(), points.end(), isFinite)) return;
    for (const Point& point : points)
        if (isFinite(point)) drawn_.include(point, style.strokeInMetres ? style.strokeWidth / 2 : 0);
    avoid(style, points);
    marks_.push_back([corners = Polygon(points.begin(), points.end()), closed, style](const Page& page) {
        return svgPath(SvgPath(page.onPage(corners), closed), look(style, page.scale));
    });
}

void SvgDrawing::area(std::vector<Polygon> pieces, const Style& style) {
    if (pieces.empty()) return;
    for (const Polygon& piece : pieces)
        for (const Point& point : piece) drawn_.include(point);
    marks_.push_back([pieces = std::move(pieces), style](const Page& page) {
        SvgPath path;
        for (const Polygon& piece : pieces) path += SvgPath(page.onPage(piece), true);
        return svgPath(path, look(style, page.scale));
    });
}

void SvgDrawing::circle(const Point& centre, double radius, const Style& style) {
    drawn_.include(centre, radius + (style.strokeInMetres ? style.strokeWidth / 2 : 0));
    marks_.push_back(
        [=](const Page& page) { return svgCircle(page.onPage(centre), radius * page.scale, look(style, page.scale)); });
}

void SvgDrawing::dot(const Point& centre, double pixels, const Style& style) {
    drawn_.include(centre);
    avoid(style, {&centre, 1});
    marks_.push_back([=](const Page& page) { return svgCircle(page.onPage(centre), pixels, look(style, page.scale)); });
}

void SvgDrawing::arrow(const Point& from, const Point& to, const Colour& colour) {
    drawn_.include(from);
    drawn_.include(to);
    marks_.push_back(
        [=](const Page& page) { return arrowFromTo(page.onPage(from), page.onPage(to), hexadecimal(colour)); });
}

void SvgDrawing::pointer(const Point& at, double heading, double pixels, const Colour& colour) {
    drawn_.include(at);
    const Style style{.fill = colour, .stroke = Colour{255, 255, 255}};
    // y points down on the page.
    marks_.push_back([=](const Page& page) { return pointerAt(page.onPage(at), -heading, pixels, look(style, 1)); });
}

void SvgDrawing::label(const Point& at, double below, std::string_view text) {
    marks_.push_back([=, text = std::string(text)](const Page& page) {
        return labelText(page.onPage(at) + Point{0, below}, text);
    });
}

void SvgDrawing::labelBeside(const Point& at, std::string_view text) {
    labelsBeside_.push_back({at, std::string(text)});
}

/// Those that find their places themselves, one after another.
std::string SvgDrawing::labels(const Page& page) const {
    constexpr double every = 6;  // pixels, along lines
    std::vector<Point> avoided;
    for (const std::vector<Point>& line : avoided_)
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (!isFinite(line[i])) continue;
            const Point to = page.onPage(line[i]),
                        from = i > 0 && isFinite(line[i - 1]) ? page.onPage(line[i - 1]) : to;
            const int parts = 1 + static_cast<int>(distance(from, to) / every);
            for (int k = 1; k <= parts; ++k) avoided.push_back(from + (k / static_cast<double>(parts)) * (to - from));
        }
    std::string text;
    std::vector<PageBox> taken;
    for (const LabelBeside& label : labelsBeside_) {
        taken.push_back(
            placeLabel(page.onPage(label.at), textWidth(label.text, textSize), textSize, avoided, taken, page.box()));
        text += labelText({taken.back().centre().x, taken.back().bottom - 0.15 * textSize}, label.text);
    }
    return text;
}

std::string SvgDrawing::text(const Frame& frame) const {
    const Page page(frame.shown.value_or(drawn_.empty() ? Area{{}, {1, 1}} : drawn_), frame);
    const std::string width = px(page.pageWidth()), height = px(page.pageHeight());
    const double bar = roundLength(std::min(page.pageWidth() / 4, 220.0) / page.scale);
    std::string marks;
    for (const auto& mark : marks_) marks += mark(page);
    marks += labels(page);
    std::string text = element("title", {}, escaped(frame.title));
    text += element("rect", {{"width", "100%"}, {"height", "100%"}, {"fill", ground}});
    text += svgText({margin, 30}, frame.title, {{"font-size", titleSize}, {"fill", ink}, {"font-weight", "bold"}});
    text += plainText({margin, 51}, frame.subtitle, textSize, quiet);
    text += page.legend;
    if (frame.grid) text += page.grid(bar);
    text += frame.shown ? svgClip({margin, page.top}, page.shownWidth, page.shownHeight, marks) : marks;
    return element("svg",
                   {{"xmlns", "http://www.w3.org/2000/svg"},
                    {"width", width},
                    {"height", height},
                    {"viewBox", cat("0 0 ", width, " ", height)},
                    {"font-family", "DejaVu Sans, Helvetica, Arial, sans-serif"}},
                   text + page.scaleBar(bar));
}

}  // namespace mrose
