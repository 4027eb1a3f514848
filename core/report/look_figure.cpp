#include "report/look_figure.h"

#include <algorithm>
#include <cmath>

#include "assessment/reading_scores.h"
#include "drawing/label_placement.h"
#include "geometry/normal_distribution.h"
#include "io/format.h"
#include "report/legend.h"
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

ViewPlot viewOf(const SensorEvaluation& evaluation, std::string_view description) {
    double far = 1, wide = 0.5 * evaluation.view.fieldOfView;
    forEachCase(evaluation, [&](std::size_t, const LoggedCase& one) {
        far = std::max({far, one.range + 0.4, one.reported ? one.measuredRange + 0.4 : 0});
        wide = std::max(wide, std::abs(one.bearing));
    });
    far = std::min(far, evaluation.log.rule.range);
    ViewPlot view(far, std::min(wide + 0.1, evaluation.log.rule.bearing), description);
    view.scale();
    for (const double side : {-0.5, 0.5})
        view.ray(0, std::min(far, evaluation.view.range), side * evaluation.view.fieldOfView, "sight");
    for (const Point& robot : evaluation.shown.robots) view.plot().circle({-robot.y, robot.x}, pixelsOfRobot, "body");
    return view;
}

enum class LookSide { real, predicted };

/// Writes labels beside the subjects that are on nothing else.
class SubjectLabels {
public:
    SubjectLabels(const SensorEvaluation& evaluation, ViewPlot& view) : view_(view) {
        forEachCase(evaluation, [&](std::size_t, const LoggedCase& one) {
            marks_.push_back(pixels(ViewPlot::place(one.range, one.bearing)));
            if (one.reported) marks_.push_back(pixels(ViewPlot::place(one.measuredRange, one.measuredBearing)));
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

/// The subjects themselves, with their names or the predicted shares.
void drawSubjects(const SensorEvaluation& evaluation, ViewPlot& view, LookSide side) {
    SubjectLabels labels(evaluation, view);
    forEachCase(evaluation, [&](std::size_t i, const LoggedCase& one) {
        const Point place = ViewPlot::place(one.range, one.bearing);
        view.plot().circle(place, pixelsOfSubject, one.reported ? "subject" : "unreported");
        const double chance = evaluation.models.front().scores[i].probability;
        labels.write(place,
                     side == LookSide::real ? evaluation.log.subjects[one.subject] : cat(fixed(100 * chance, 0), " %"));
    });
}

/// Round about what a normal distribution with such central parts would have 90 % of inside.
void drawRegion(const CasePrediction& prediction, ViewPlot& view) {
    constexpr double wider = 2.146 / 1.645;  // for both dimensions at once
    const auto middleAndHalf = [&](int dimension) {
        const double low = errorQuantile(prediction.distribution, dimension, 0.05);
        const double high = errorQuantile(prediction.distribution, dimension, 0.95);
        return std::pair{0.5 * (low + high), 0.5 * wider * (high - low)};
    };
    const auto [range, farther] = middleAndHalf(0);
    const auto [bearing, aside] = middleAndHalf(1);
    std::vector<Point> low, high;
    for (int k = 0; k <= 24; ++k) {
        const double angle = std::numbers::pi * k / 24;
        const double at = prediction.bearing + bearing + aside * cosine(angle), half = farther * sine(angle);
        low.push_back(ViewPlot::place(prediction.range + range - half, at));
        high.push_back(ViewPlot::place(prediction.range + range + half, at));
    }
    view.plot().band(low, high, "band inner");
}

void drawDraws(const CasePrediction& prediction, std::size_t index, ViewPlot& view) {
    for (int k = 0; k < shownDraws; ++k) {
        const auto draw = static_cast<std::int64_t>(k);
        const auto of = static_cast<std::uint32_t>(index);
        const NoisePair errors = normalPair({1, draw, of, 0}), others = uniformPair({1, draw, of, 1});
        const ReadingDraw numbers{normalQuantile(others.first), others.second, {errors.first, errors.second}};
        if (!prediction.distribution.reports(numbers)) continue;
        const ReadingError error = prediction.distribution.error(numbers);
        view.plot().circle(ViewPlot::place(prediction.range + error[0], prediction.bearing + error[1]), pixelsOfDraw,
                           "sample");
    }
}

}  // namespace

std::string realLookFigure(const SensorEvaluation& evaluation) {
    ViewPlot view = viewOf(evaluation, "One look: what was there, and what was reported");
    drawSubjects(evaluation, view, LookSide::real);
    forEachCase(evaluation, [&](std::size_t, const LoggedCase& one) {
        if (!one.reported) return;
        const Point ends[] = {ViewPlot::place(one.range, one.bearing),
                              ViewPlot::place(one.measuredRange, one.measuredBearing)};
        view.plot().line(ends, "realmiss");
        view.plot().circle(ends[1], pixelsOfReading, "realmark");
    });
    return view.text();
}

std::string predictedLookFigure(const SensorEvaluation& evaluation) {
    ViewPlot view = viewOf(evaluation, "The same look: what the model would report");
    const std::vector<CasePrediction>& predictions = evaluation.models.front().predictions;
    forEachCase(evaluation, [&](std::size_t i, const LoggedCase&) { drawRegion(predictions[i], view); });
    forEachCase(evaluation, [&](std::size_t i, const LoggedCase&) { drawDraws(predictions[i], i, view); });
    drawSubjects(evaluation, view, LookSide::predicted);
    return view.text();
}

std::string lookLegend(const SensorEvaluation& evaluation) {
    const std::string real = evaluation.log.real();
    return legend(cat(dotEntry("subject", "reported"), dotEntry("unreported", "not reported"),
                      dotEntry("realmark", cat(real, " reading")), dotEntry("sample", "reading drawn from the model"),
                      boxEntry("band inner", "90 % of these"), dotEntry("body", "another robot"),
                      lineEntry("sight", "field of view that the network’s file states")));
}

}  // namespace mrose
