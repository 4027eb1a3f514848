#include "report/task_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "drawing/svg_plot.h"
#include "io/format.h"
#include "report/legend.h"
#include "report/mean_figure.h"
#include "report/measure_label.h"

namespace mrose {
namespace {

constexpr std::size_t mostDots = 1500;
constexpr std::size_t tenths = 10;

/// Those of which a line says something: all but the mean of all.
std::size_t shownPredictors(const TaskJudgement& judgement) {
    return std::min<std::size_t>(judgement.predictors.size() - 1, 6);
}

double meanError(const TaskData& data, const std::vector<double>& predicted, std::span<const std::size_t> rows) {
    double sum = 0, count = 0;
    for (const std::size_t row : rows)
        for (std::size_t i = row * data.outputs(); i < (row + 1) * data.outputs(); ++i)
            if (!std::isnan(predicted[i])) sum += std::abs(predicted[i] - data.y[i]), ++count;
    return sum / count;
}

double meanInput(const TaskData& data, std::size_t input, std::span<const std::size_t> rows) {
    double sum = 0;
    for (const std::size_t row : rows) sum += data.inputsOf(row)[input];
    return sum / static_cast<double>(rows.size());
}

/// Rows in order of an input; none where it is the same in all, or there are too few.
std::vector<std::size_t> ordered(const TaskData& data, std::size_t input) {
    std::vector<std::size_t> order(data.rows());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t row) { return data.inputsOf(row)[input]; });
    if (data.rows() < tenths || data.inputsOf(order.front())[input] == data.inputsOf(order.back())[input]) return {};
    return order;
}

/// Tenths of rows that are in order of an input, as nearly as rows with the same value are in the same one: where it
/// has few values, one for each.
std::vector<std::span<const std::size_t>> tenthsOf(const TaskData& data, std::size_t input,
                                                   const std::vector<std::size_t>& order) {
    const auto valueOf = [&](std::size_t row) { return data.inputsOf(row)[input]; };
    std::vector<std::span<const std::size_t>> parts;
    std::size_t from = 0;
    for (std::size_t tenth = 1; tenth <= tenths; ++tenth) {
        std::size_t to = order.size() * tenth / tenths;
        if (to < order.size()) {
            const auto first = std::ranges::lower_bound(order, valueOf(order[to]), {}, valueOf);
            const auto last = std::ranges::upper_bound(order, valueOf(order[to]), {}, valueOf);
            const auto before = static_cast<std::size_t>(first - order.begin());
            const auto behind = static_cast<std::size_t>(last - order.begin());
            to = to - before <= behind - to ? before : behind;
        }
        if (to > from) parts.push_back(std::span(order).subspan(from, to - from));
        from = to;
    }
    return parts;
}

/// By how much the mean errors of the tenths differ.
double differenceAlong(const TaskJudgement& judgement, std::size_t input) {
    const TaskData& data = judgement.heldOut;
    const std::vector<std::size_t> order = ordered(data, input);
    if (order.empty()) return -1;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const auto rows : tenthsOf(data, input, order)) {
        const double error = meanError(data, judgement.predictors.front().predicted, rows);
        least = std::min(least, error);
        most = std::max(most, error);
    }
    return most - least;
}

}  // namespace

std::vector<std::size_t> inputsByError(const TaskJudgement& judgement) {
    std::vector<std::pair<double, std::size_t>> inputs;
    for (std::size_t i = 0; i < judgement.heldOut.inputs.size(); ++i)
        if (const double difference = differenceAlong(judgement, i); difference >= 0)
            inputs.emplace_back(difference, i);
    std::ranges::stable_sort(inputs, std::greater(), [](const auto& input) { return input.first; });
    std::vector<std::size_t> order;
    for (const auto& input : inputs) order.push_back(input.second);
    return order;
}

std::string predictionFigure(const TaskJudgement& judgement, std::size_t output) {
    const TaskData& data = judgement.heldOut;
    const std::vector<double>& predicted = judgement.predictors.front().predicted;
    std::vector<Point> dots;
    const std::size_t every = std::max<std::size_t>(1, data.rows() / mostDots);
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t row = 0; row < data.rows(); row += every) {
        const std::size_t i = row * data.outputs() + output;
        dots.push_back({data.y[i], predicted[i]});
        least = std::min({least, data.y[i], predicted[i]});
        most = std::max({most, data.y[i], predicted[i]});
    }
    const double room = 0.03 * (most - least);
    const PlotRange range = usable({least - room, most + room});
    SvgPlot plot({.width = 440, .height = 420}, range, range, "Predicted against simulated, held out");
    plot.axes(cat(measureLabel(data.target), ", simulated"), cat(measureLabel(data.target), ", predicted"));
    const Point diagonal[] = {{range.low, range.low}, {range.high, range.high}};
    plot.line(diagonal, "floorline");
    for (const Point& dot : dots) plot.circle(dot, 2.2, "sample");
    return plot.text();
}

std::string inputErrorFigure(const TaskJudgement& judgement, std::size_t input) {
    const TaskData& data = judgement.heldOut;
    const std::vector<std::size_t> order = ordered(data, input);
    if (order.empty()) return {};
    std::vector<std::vector<Point>> lines(shownPredictors(judgement));
    const auto parts = tenthsOf(data, input, order);
    const PlotRange x{meanInput(data, input, parts.front()), meanInput(data, input, parts.back())};
    double most = 0;
    for (std::size_t k = 0; k < lines.size(); ++k)
        for (const auto rows : parts) {
            lines[k].push_back(
                {meanInput(data, input, rows), meanError(data, judgement.predictors[k].predicted, rows)});
            if (k == 0 || lines[k].back().y < 5 * lines[0].back().y) most = std::max(most, lines[k].back().y);
        }
    SvgPlot plot({.width = 350, .height = 230}, usable(x), {0, 1.1 * most},
                 cat("Mean absolute error against ", data.inputs[input]));
    plot.axes(data.inputs[input], cat("mean |error| of ", measureLabel(data.target)));
    for (std::size_t k = lines.size(); k-- > 0;) plot.line(lines[k], seriesClass(k));
    return plot.text();
}

std::string inputErrorLegend(const TaskJudgement& judgement) {
    std::string entries;
    for (std::size_t k = 0; k < shownPredictors(judgement); ++k)
        entries += lineEntry(seriesClass(k), judgement.predictors[k].name);
    return legend(entries);
}

std::string choiceFigure(const TaskJudgement& judgement) {
    const VariantChoice& choice = *judgement.predictors.front().choice;
    const auto alone = [](double mean) { return Estimate{mean, mean, mean}; };
    std::vector<NamedMean> rows;
    for (const VariantChoice::Variant& variant : choice.variants) rows.push_back({variant.name, alone(variant.mean)});
    rows.push_back({"chosen as learned", alone(choice.mean), "realmark"});
    if (choice.oracle) rows.push_back({"best of each trial", alone(choice.oracle->mean)});
    return meanFigure(rows, "mean " + measureLabel(judgement.heldOut.target));
}

}  // namespace mrose
