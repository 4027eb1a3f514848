#include "drawing/svg_drawing.h"

#include <algorithm>
#include <cmath>

#include "drawing/label_placement.h"
#include "drawing/markup.h"
#include "geometry/point.h"
#include "io/format.h"

namespace mrose {
namespace {

// Pixels.
constexpr double margin = 28, titleHeight = 66, footHeight = 46, leastWidth = 420;
constexpr double titleSize = 20, textSize = 14, legendLine = 24, sampleWidth = 34, entryGap = 22;
constexpr std::string_view ink = "#222222", quiet = "#666666";

std::string hexadecimal(const Colour& colour) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t channel : {colour.red, colour.green, colour.blue})
        (text += digits[channel >> 4]) += digits[channel & 15];
    return text;
}

std::string attribute(std::string_view key, std::string_view value) { return cat(" ", key, "=\"", value, "\""); }

/// The largest of 1, 2 and 5 times a power of ten up to `most`.
double roundLength(double most) {
    const double power = std::pow(10, std::floor(std::log10(most)));
    return most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
}

std::string textAt(double x, double y, double size, std::string_view fill, std::string_view more,
                   std::string_view text) {
    return cat("<text x=\"", px(x), "\" y=\"", px(y), "\" font-size=\"", px(size), "\" fill=\"", fill, "\"", more, ">",
               escaped(text), "</text>\n");
}

/// About how wide a text is; letters differ.
double textWidth(std::string_view text, double size) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return 0.6 * size * static_cast<double>(letters);
}

Point rotated(const Point& vector, double angle) { return Placement({0, 0, angle}).rotate(vector); }

}  // namespace

/// Where metres lie on the page.
class SvgDrawing::Page {
public:
    Page(const Point& least, const Point& most, const Frame& frame) : least_(least) {
        const Point size = most - least;
        scale_ = frame.longestSide / std::max({size.x, size.y, 1e-3});
        // A narrow picture has room for its words all the same.
        shownWidth_ = size.x * scale_;
        width_ =
            std::max({shownWidth_, leastWidth, textWidth(frame.title, titleSize), textWidth(frame.subtitle, textSize)});
        height_ = size.y * scale_;
        legend_ = legend(frame.legend);
    }

    double width() const { return width_ + 2 * margin; }
    double height() const { return bottom() + margin + footHeight; }
    double top() const { return titleHeight + legendHeight_; }
    double bottom() const { return top() + height_; }
    double scale() const { return scale_; }
    double left() const { return margin; }
    double right() const { return margin + shownWidth_; }
    double x(const Point& p) const { return margin + (p.x - least_.x) * scale_; }
    double y(const Point& p) const { return bottom() - (p.y - least_.y) * scale_; }

    std::string style(const Style& style) const {
        std::string text = attribute("fill", style.fill ? hexadecimal(*style.fill) : "none");
        if (style.stroke) {
            text += attribute("stroke", hexadecimal(*style.stroke)) +
                    attribute("stroke-width", px(style.strokeWidth * (style.strokeInMetres ? scale_ : 1)));
            if (style.dashed) text += attribute("stroke-dasharray", "4 3");
            if (style.dotted) text += attribute("stroke-dasharray", "1 4");
        }
        if (style.opacity < 1) text += attribute("opacity", px(style.opacity));
        return text;
    }

    std::string mark(const Mark& mark) const {
        switch (mark.kind) {
            case Mark::Kind::path:
                return path(mark);
            case Mark::Kind::circle:
                return circle(mark.points[0], mark.size * scale_, mark.style);
            case Mark::Kind::dot:
                return circle(mark.points[0], mark.size, mark.style);
            case Mark::Kind::arrow:
                return arrow(mark);
            case Mark::Kind::pointer:
                // y points down on the page.
                return pointer(onPage(mark.points[0]), -mark.heading, mark.size, mark.style);
            case Mark::Kind::label:
                return label(onPage(mark.points[0]) + Point{0, mark.size}, mark.text);
            case Mark::Kind::labelBeside:
                break;
        }
        return {};
    }

    Point onPage(const Point& p) const { return {x(p), y(p)}; }
    PageBox box() const { return {left(), top(), right(), bottom()}; }
    std::string_view legendText() const { return legend_; }

    /// `at` is the middle of its base line.
    std::string label(const Point& at, std::string_view text) const {
        constexpr std::string_view halo =
            " text-anchor=\"middle\" stroke=\"#ffffff\" stroke-width=\"4\" stroke-linejoin=\"round\" "
            "paint-order=\"stroke\"";
        return textAt(at.x, at.y, textSize, ink, halo, text);
    }

    /// What follows is seen within the picture only.
    std::string beginClip() const {
        const std::string x = px(left()), y = px(top()), width = px(shownWidth_), height = px(height_);
        return cat("<svg x=\"", x, "\" y=\"", y, "\" width=\"", width, "\" height=\"", height, "\" viewBox=\"", x, " ",
                   y, " ", width, " ", height, "\">\n");
    }

    std::string grid(double step) const {
        std::string text;
        const double right = least_.x + shownWidth_ / scale_, highest = least_.y + height_ / scale_;
        for (double i = std::ceil(least_.x / step); i * step <= right; ++i)
            text += cat("M", px(x({i * step, 0})), " ", px(top()), "V", px(bottom()));
        for (double i = std::ceil(least_.y / step); i * step <= highest; ++i)
            text += cat("M", px(left()), " ", px(y({0, i * step})), "H", px(this->right()));
        return cat("<path d=\"", text, "\" fill=\"none\" stroke=\"#e6e6e6\"/>\n");
    }

    std::string scaleBar(double length) const {
        const double from = margin, to = margin + length * scale_, y = height() - 24;
        std::string unit = length < 0.01 ? fixed(length * 1000, 0) + " mm"
                           : length < 1  ? fixed(length * 100, 0) + " cm"
                                         : fixed(length, 0) + " m";
        return cat("<path d=\"M", px(from), " ", px(y - 4), "v8m0 -4H", px(to), "m0 -4v8\" fill=\"none\" stroke=\"",
                   ink, "\" stroke-width=\"1.5\"/>\n") +
               textAt(to + 8, y + 5, textSize, ink, "", unit);
    }

private:
    std::string path(const Mark& mark) const {
        std::string d;
        for (const Point& p : mark.points) d += cat(d.empty() ? "M" : "L", px(x(p)), " ", px(y(p)));
        return cat("<path d=\"", d, mark.closed ? "Z" : "", "\"", style(mark.style), " stroke-linejoin=\"round\"/>\n");
    }

    std::string circle(const Point& centre, double radius, const Style& look) const {
        return circleAt(onPage(centre), radius, look);
    }

    std::string circleAt(const Point& centre, double radius, const Style& look) const {
        return cat("<circle cx=\"", px(centre.x), "\" cy=\"", px(centre.y), "\" r=\"", px(radius), "\"", style(look),
                   "/>\n");
    }

    /// `turn` is clockwise, as the page has it from above.
    std::string pointer(const Point& at, double turn, double size, const Style& look) const {
        std::string d;
        for (const Point& corner : {Point{0.6, 0}, Point{-0.4, -0.42}, Point{-0.2, 0}, Point{-0.4, 0.42}}) {
            const Point p = at + size * rotated(corner, turn);
            d += cat(d.empty() ? "M" : "L", px(p.x), " ", px(p.y));
        }
        return cat("<path d=\"", d, "Z\"", style(look), " stroke-linejoin=\"round\"/>\n");
    }

    std::string sample(const LegendEntry& entry, const Point& at) const {
        const Point middle = at + Point{sampleWidth / 2, 0};
        switch (entry.symbol) {
            case LegendEntry::Symbol::line:
                return cat("<path d=\"M", px(at.x), " ", px(at.y), "h", px(sampleWidth), "\"", style(entry.style),
                           "/>\n");
            case LegendEntry::Symbol::dot:
                return circleAt(middle, 6, entry.style);
            case LegendEntry::Symbol::pointer:
                break;
        }
        return pointer(middle, 0, 15, entry.style);
    }

    /// Below the title, in as many lines as it takes.
    std::string legend(const std::vector<LegendEntry>& entries) {
        std::string text;
        if (entries.empty()) return text;
        Point at{margin, titleHeight + 2};
        for (const LegendEntry& entry : entries) {
            const double wide = sampleWidth + 8 + textWidth(entry.text, textSize);
            if (at.x > margin && at.x + wide > margin + width_) at = {margin, at.y + legendLine};
            text += sample(entry, at) + textAt(at.x + sampleWidth + 8, at.y + 5, textSize, ink, "", entry.text);
            at.x += wide + entryGap;
        }
        legendHeight_ = at.y + legendLine - titleHeight;
        return text;
    }

    std::string arrow(const Mark& mark) const {
        const Point from{x(mark.points[0]), y(mark.points[0])}, to{x(mark.points[1]), y(mark.points[1])};
        const double size = length(to - from);
        if (size < 1) return {};
        const Point along = (1 / size) * (to - from), aside{-along.y, along.x};
        const double head = std::min(10.0, size / 2);
        const Point neck = to - head * along, left = neck + head / 2.6 * aside, right = neck - head / 2.6 * aside;
        const std::string shaft = cat("M", px(from.x), " ", px(from.y), "L", px(neck.x), " ", px(neck.y));
        const std::string tip = cat("M", px(to.x), " ", px(to.y), "L", px(left.x), " ", px(left.y), "L", px(right.x),
                                    " ", px(right.y), "Z");
        const auto part = [](const std::string& d, const std::string& fill, const std::string& stroke, double wide) {
            return cat("<path d=\"", d, "\" fill=\"", fill, "\" stroke=\"", stroke, "\" stroke-width=\"", px(wide),
                       "\"/>");
        };
        const std::string colour = hexadecimal(*mark.style.stroke), halo = "#ffffff";
        return part(shaft, "none", halo, 4.5) + part(tip, halo, halo, 3) + part(shaft, "none", colour, 2) +
               part(tip, colour, "none", 0) + '\n';
    }

    Point least_;
    double scale_ = 1, shownWidth_ = 0, width_ = 0, height_ = 0, legendHeight_ = 0;
    std::string legend_;
};

void SvgDrawing::grow(const Point& point, double by) {
    least_ = {std::min(least_.x, point.x - by), std::min(least_.y, point.y - by)};
    most_ = {std::max(most_.x, point.x + by), std::max(most_.y, point.y + by)};
}

void SvgDrawing::outline(std::span<const Point> points, bool closed, const Style& style) {
    for (const Point& point : points) grow(point, style.strokeInMetres ? style.strokeWidth / 2 : 0);
    if (!points.empty())
        marks_.push_back(
            {.kind = Mark::Kind::path, .points = {points.begin(), points.end()}, .closed = closed, .style = style});
}

void SvgDrawing::circle(const Point& centre, double radius, const Style& style) {
    grow(centre, radius + (style.strokeInMetres ? style.strokeWidth / 2 : 0));
    marks_.push_back({.kind = Mark::Kind::circle, .points = {centre}, .size = radius, .style = style});
}

void SvgDrawing::dot(const Point& centre, double pixels, const Style& style) {
    grow(centre, 0);
    marks_.push_back({.kind = Mark::Kind::dot, .points = {centre}, .size = pixels, .style = style});
}

void SvgDrawing::arrow(const Point& from, const Point& to, const Colour& colour) {
    grow(from, 0);
    grow(to, 0);
    marks_.push_back({.kind = Mark::Kind::arrow, .points = {from, to}, .style = {.stroke = colour}});
}

void SvgDrawing::pointer(const Point& at, double heading, double pixels, const Colour& colour) {
    grow(at, 0);
    constexpr Colour halo{255, 255, 255};
    marks_.push_back({.kind = Mark::Kind::pointer,
                      .points = {at},
                      .size = pixels,
                      .heading = heading,
                      .style = {.fill = colour, .stroke = halo}});
}

void SvgDrawing::label(const Point& at, double below, std::string_view text) {
    marks_.push_back({.kind = Mark::Kind::label, .points = {at}, .size = below, .text = std::string(text)});
}

void SvgDrawing::labelBeside(const Point& at, std::string_view text) {
    marks_.push_back({.kind = Mark::Kind::labelBeside, .points = {at}, .text = std::string(text)});
}

/// Those that find their places themselves, one after another.
std::string SvgDrawing::labels(const Page& page) const {
    constexpr double every = 6;  // pixels, along lines
    std::vector<Point> avoided;
    for (const Mark& mark : marks_) {
        if (!mark.style.labelsAvoid) continue;
        for (std::size_t i = 0; i < mark.points.size(); ++i) {
            const Point to = page.onPage(mark.points[i]), from = i > 0 ? page.onPage(mark.points[i - 1]) : to;
            const int parts = 1 + static_cast<int>(distance(from, to) / every);
            for (int k = 1; k <= parts; ++k) avoided.push_back(from + (k / static_cast<double>(parts)) * (to - from));
        }
    }
    std::string text;
    std::vector<PageBox> taken;
    for (const Mark& mark : marks_) {
        if (mark.kind != Mark::Kind::labelBeside) continue;
        taken.push_back(placeLabel(page.onPage(mark.points[0]), textWidth(mark.text, textSize), textSize, avoided,
                                   taken, page.box()));
        text += page.label({taken.back().centre().x, taken.back().bottom - 0.15 * textSize}, mark.text);
    }
    return text;
}

std::string SvgDrawing::text(const Frame& frame) const {
    const bool empty = most_.x < least_.x;
    const Area area = frame.shown.value_or(empty ? Area{{}, {1, 1}} : Area{least_, most_});
    const Page page(area.least, area.most, frame);
    const double bar = roundLength(std::min(page.width() / 4, 220.0) / page.scale());
    std::string text = cat("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", px(page.width()), "\" height=\"",
                           px(page.height()), "\" viewBox=\"0 0 ", px(page.width()), " ", px(page.height()),
                           "\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n<title>",
                           escaped(frame.title), "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
    text += textAt(margin, 30, titleSize, ink, " font-weight=\"bold\"", frame.title);
    text += textAt(margin, 51, textSize, quiet, "", frame.subtitle);
    text += page.legendText();
    if (frame.grid) text += page.grid(bar);
    if (frame.shown) text += page.beginClip();
    for (const Mark& mark : marks_) text += page.mark(mark);
    text += labels(page);
    if (frame.shown) text += "</svg>\n";
    return text + page.scaleBar(bar) + "</svg>\n";
}

}  // namespace mrose
