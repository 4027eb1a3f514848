#include "report/shown_windows.h"

#include <algorithm>
#include <cmath>

#include "drawing/markup.h"

namespace mrose {
namespace {

using Indices = std::vector<std::size_t>;

template <class Score>
Indices ranked(Indices windows, Score score) {
    std::stable_sort(windows.begin(), windows.end(), [&](std::size_t a, std::size_t b) { return score(a) < score(b); });
    return windows;
}

std::size_t atQuantile(const Indices& rankedWindows, double q) {
    return rankedWindows[static_cast<std::size_t>(std::lround(q * static_cast<double>(rankedWindows.size() - 1)))];
}

class Choice {
public:
    void add(std::size_t window, std::string reason) {
        for (ShownWindow& known : shown)
            if (known.window == window) {
                if (known.reason.find(reason) == std::string::npos) known.reason += cat(", ", reason);
                return;
            }
        shown.push_back({window, std::move(reason)});
    }
    std::vector<ShownWindow> shown;
};

}  // namespace

std::vector<ShownWindow> shownWindows(const Evaluation& evaluation, const std::vector<std::size_t>& chosen) {
    const auto& errors = evaluation.models.front().errors;
    Indices all, driving;
    for (std::size_t i = 0; i < evaluation.log.windows.size(); ++i) {
        all.push_back(i);
        if (drives(evaluation.log.windows[i], evaluation.log.options)) driving.push_back(i);
    }
    const auto byHeading = ranked(all, [&](std::size_t i) { return errors[i].headingFinal; });
    const auto byPosition = driving.empty() ? byHeading : ranked(driving, [&](std::size_t i) {
        return errors[i].positionMean / evaluation.log.windows[i].path;
    });
    Choice choice;
    choice.add(atQuantile(byPosition, 0.1), "10th percentile");
    choice.add(atQuantile(byPosition, 0.5), "median window");
    choice.add(atQuantile(byPosition, 0.75), "75th percentile");
    choice.add(atQuantile(byPosition, 0.9), "90th percentile");
    choice.add(byPosition.back(), "worst position");
    choice.add(byHeading.back(), "worst heading");
    for (int kind = 0; kind < manoeuvreCount; ++kind) {
        Indices ofKind;
        for (const std::size_t i : byPosition)
            if (evaluation.log.windows[i].manoeuvre == static_cast<Manoeuvre>(kind)) ofKind.push_back(i);
        if (!ofKind.empty()) choice.add(atQuantile(ofKind, 0.5), cat("median of ", name(static_cast<Manoeuvre>(kind))));
    }
    for (const std::size_t i : chosen)
        if (i < evaluation.log.windows.size()) choice.add(i, "chosen");
    return std::move(choice.shown);
}

}  // namespace mrose
