#include "report/look_figure.h"

#include <algorithm>
#include <cmath>

#include "assessment/reading_scores.h"
#include "drawing/label_placement.h"
#include "geometry/angle.h"
#include "geometry/normal_distribution.h"
#include "io/format.h"
#include "report/legend.h"
#include "report/page.h"
#include "report/view_plot.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr double pixelsOfRobot = 7, pixelsOfSubject = 3.4, pixelsOfReading = 3.4, pixelsOfDraw = 1.6;

struct ShownCases {
    std::size_t first = 0, count = 0;
};
ShownCases casesOf(const SensorEvaluation& evaluation) {
    const LoggedLook& look = evaluation.log.looks[evaluation.shown.look];
    return {look.first, look.count};
}

template <class Use>
void forEachCase(const SensorEvaluation& evaluation, const Use& use) {
    const auto [first, count] = casesOf(evaluation);
    for (std::size_t i = first; i < first + count; ++i) use(i, evaluation.log.cases[i]);
}

struct SightView {
    double range = 1;
    PlotRange bearings;  ///< of what was there
    double half = 0;     ///< of the field of view

    bool shows(double bearing) const { return bearing > bearings.low && bearing < bearings.high; }
};

SightView sightOf(const SensorEvaluation& evaluation) {
    constexpr double beside = 0.12, least = 0.25;  // rad
    SightView sight{.half = 0.5 * evaluation.view.fieldOfView};
    PlotRange& bearings = sight.bearings = {INFINITY, -INFINITY};
    forEachCase(evaluation, [&](std::size_t, const LoggedCase& one) {
        sight.range = std::max({sight.range, one.range + 0.4, one.reported ? one.measuredRange + 0.4 : 0});
        bearings = {std::min(bearings.low, one.bearing - beside), std::max(bearings.high, one.bearing + beside)};
    });
    const double most = evaluation.log.rule.bearing;
    bearings = {std::max(-most, std::min(bearings.low, -least)), std::min(most, std::max(bearings.high, least))};
    sight.range = std::min(sight.range, evaluation.log.rule.range);
    return sight;
}

ViewPlot viewOf(const SensorEvaluation& evaluation, const SightView& sight) {
    ViewPlot view(sight.range, sight.bearings, "One look: what was there, and what was reported");
    view.scale();
    for (const double side : {-sight.half, sight.half})
        if (sight.shows(side)) view.ray(0, std::min(sight.range, evaluation.view.range), side, "sight");
    for (const Point& robot : evaluation.shown.robots) view.plot().circle({-robot.y, robot.x}, pixelsOfRobot, "body");
    return view;
}

/// Writes labels beside the subjects that are on nothing else, nor across the edges of the field of view.
class SubjectLabels {
public:
    SubjectLabels(const SensorEvaluation& evaluation, const SightView& sight, ViewPlot& view) : view_(view) {
        const double apart = 8 * view.plot().unitsPerPixel();
        for (const double bearing : {-sight.half, 0.0, sight.half})
            for (int i = 0; i * apart < sight.range; ++i) marks_.push_back(pixels(ViewPlot::place(i * apart, bearing)));
        forEachCase(evaluation, [&](std::size_t, const LoggedCase& one) {
            marks_.push_back(pixels(ViewPlot::place(one.range, one.bearing)));
            if (!one.reported) return;
            for (const double share : {0.5, 1.0})
                marks_.push_back(pixels(ViewPlot::place(one.range + share * (one.measuredRange - one.range),
                                                        one.bearing + share * (one.measuredBearing - one.bearing))));
        });
    }

    void write(const Point& place, std::string_view text) {
        constexpr double letter = 7.6, height = 13, descent = 3;
        const Point at = pixels(place);
        const PageBox box = placeLabel(at, letter * static_cast<double>(text.size()), height, marks_, taken_, page_);
        taken_.push_back(box);
        view_.plot().label(place, box.left - at.x, box.bottom - descent - at.y, text, "tick");
    }

private:
    /// On a page without margins.
    Point pixels(const Point& place) const {
        const double scale = 1 / view_.plot().unitsPerPixel();
        return {scale * place.x, -scale * place.y};
    }

    ViewPlot& view_;
    const PageBox page_{-1e4, -1e4, 1e4, 1e4};
    std::vector<Point> marks_;
    std::vector<PageBox> taken_;
};

/// The subjects themselves, with their names.
void drawSubjects(const SensorEvaluation& evaluation, const SightView& sight, ViewPlot& view) {
    SubjectLabels labels(evaluation, sight, view);
    forEachCase(evaluation, [&](std::size_t, const LoggedCase& one) {
        const Point place = ViewPlot::place(one.range, one.bearing);
        view.plot().circle(place, pixelsOfSubject, one.reported ? "subject" : "unreported");
        labels.write(place, evaluation.log.subjects[one.subject]);
    });
}

/// What is shown enlarged: aside (to the right) and away from the robot, cm from where the subject truly is.
Point enlarged(double range, const ReadingError& error) { return {-100 * range * error[1], 100 * error[0]}; }

/// Round about what a normal distribution with such central parts would have 90 % of inside.
std::vector<Point> regionOf(const CasePrediction& prediction) {
    constexpr double wider = 2.146 / 1.645;  // for both dimensions at once
    const auto middleAndHalf = [&](int dimension) {
        const double low = errorQuantile(prediction.distribution, dimension, 0.05);
        const double high = errorQuantile(prediction.distribution, dimension, 0.95);
        return std::pair{0.5 * (low + high), 0.5 * wider * (high - low)};
    };
    const auto [range, farther] = middleAndHalf(0);
    const auto [bearing, aside] = middleAndHalf(1);
    std::vector<Point> round;
    for (int k = 0; k <= 48; ++k) {
        const double angle = 2 * std::numbers::pi * k / 48;
        round.push_back(enlarged(prediction.range, {range + farther * sine(angle), bearing + aside * cosine(angle)}));
    }
    return round;
}

std::vector<Point> drawsOf(const CasePrediction& prediction, std::size_t index) {
    std::vector<Point> draws;
    for (int k = 0; k < shownDraws; ++k) {
        const auto draw = static_cast<std::int64_t>(k);
        const auto of = static_cast<std::uint32_t>(index);
        const NoisePair errors = normalPair({1, draw, of, 0}), others = uniformPair({1, draw, of, 1});
        const ReadingDraw numbers{normalQuantile(others.first), others.second, {errors.first, errors.second}};
        draws.push_back(enlarged(prediction.range, prediction.distribution.error(numbers)));
    }
    return draws;
}

/// One subject enlarged, in a scale of its own.
std::string closeUp(const CasePrediction& prediction, const LoggedCase& one, std::size_t index) {
    const std::vector<Point> region = regionOf(prediction);
    const Point real = enlarged(
        prediction.range, {one.measuredRange - prediction.range, wrapAngle(one.measuredBearing - prediction.bearing)});
    PlotRange x{0, 0}, y{0, 0};
    const auto include = [&](const Point& point) {
        x = {std::min(x.low, point.x), std::max(x.high, point.x)};
        y = {std::min(y.low, point.y), std::max(y.high, point.y)};
    };
    for (const Point& point : region) include(point);
    if (one.sound) include(real);
    const double half = 0.56 * std::max({x.high - x.low, y.high - y.low, 0.1});
    const Point middle{0.5 * (x.low + x.high), 0.5 * (y.low + y.high)};
    SvgPlot plot = SvgPlot::equalScale({160, 160, 2, 2, 2, 18}, {middle.x - half, middle.x + half},
                                       {middle.y - half, middle.y + half}, "One subject of the look, enlarged");
    const std::vector<Point> low(region.begin() + 24, region.end()), high(region.rbegin() + 24, region.rend());
    plot.band(low, high, "band inner");
    for (const Point& draw : drawsOf(prediction, index)) plot.circle(draw, pixelsOfDraw, "sample");
    const Point miss[] = {{0, 0}, real};
    if (one.sound) plot.line(miss, "realmiss");
    plot.circle({0, 0}, pixelsOfSubject, one.reported ? "subject" : "unreported");
    if (one.sound) plot.circle(real, pixelsOfReading + 1, "realmark");
    const double bar = roundStep(0.5 * half);
    plot.scaleBar(bar, cat(fixed(bar, bar < 1 ? 1 : 0), " cm"));
    return plot.text();
}

}  // namespace

std::string lookFigure(const SensorEvaluation& evaluation) {
    const SightView sight = sightOf(evaluation);
    ViewPlot view = viewOf(evaluation, sight);
    drawSubjects(evaluation, sight, view);
    forEachCase(evaluation, [&](std::size_t, const LoggedCase& one) {
        if (!one.reported) return;
        const Point ends[] = {ViewPlot::place(one.range, one.bearing),
                              ViewPlot::place(one.measuredRange, one.measuredBearing)};
        view.plot().line(ends, "realmiss");
        view.plot().circle(ends[1], pixelsOfReading, "realmark");
    });
    return view.text();
}

std::string lookCloseUps(const SensorEvaluation& evaluation) {
    const SensorAssessment& model = evaluation.models.front();
    std::string all;
    forEachCase(evaluation, [&](std::size_t i, const LoggedCase& one) {
        const double chance = model.scores[i].probability;
        if (!one.reported && chance < leastShownChance) return;
        all += element("div", "closeup",
                       cat("<b>", escaped(evaluation.log.subjects[one.subject]), "</b>: ", fixed(100 * chance, 0),
                           "\u00a0% likely", closeUp(model.predictions[i], one, i)));
    });
    return element("div", "closeups", all);
}

std::string lookLegend(const SensorEvaluation& evaluation) {
    const SightView sight = sightOf(evaluation);
    const std::string real = evaluation.log.real();
    const auto inSight = [&](const Point& robot) {
        return length(robot) < sight.range && sight.shows(direction(robot));
    };
    const bool edge = sight.shows(-sight.half) || sight.shows(sight.half);
    return legend(cat(dotEntry("subject", "true place, reported"), dotEntry("unreported", "not reported"),
                      dotEntry("realmark", cat(real, " reading")), dotEntry("sample", "reading drawn from the model"),
                      boxEntry("band inner", "90 % of these"),
                      std::ranges::none_of(evaluation.shown.robots, inSight) ? "" : dotEntry("body", "another robot"),
                      edge ? lineEntry("sight", "field of view that the network’s file states") : ""));
}

}  // namespace mrose
