#include "tuning/tuner.h"

#include <map>
#include <numeric>
#include <optional>
#include <span>

#include "tuning/paired_statistics.h"
#include "tuning/search.h"

namespace mrose {
namespace {

/// Where the search asks so often for what it knows, there is nothing more to find.
constexpr int mostRepeats = 1000;

double meanOf(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

class Tuner {
public:
    Tuner(const TunerOptions& options, const TrialCosts& costs, const TunerProgress& progress)
        : options_(options), costs_(costs), progress_(progress), race_(options.trials, options.racing) {}

    Expected<TunerResult> run() {
        std::vector<double> start, shares, steps;
        for (const TunedParameter& parameter : options_.parameters) {
            start.push_back(parameter.start);
            shares.push_back(shareOf(parameter, parameter.start));
            steps.push_back(leastStep(parameter));
        }
        // What is now, as it is and not as it would be rounded.
        if (evaluate(start)) {
            known_[valuesAt(shares)] = 0;
            searchUnitCube(shares, steps, options_.seed,
                           [this](std::span<const double> point) { return costAt(point); });
        }
        if (!stopped_ && !error_) judge();
        if (error_) return tl::unexpected(*error_);
        result_.complete = !stopped_;
        return std::move(result_);
    }

private:
    std::vector<double> valuesAt(std::span<const double> point) const {
        std::vector<double> values;
        for (std::size_t i = 0; i < point.size(); ++i) values.push_back(valueAt(options_.parameters[i], point[i]));
        return values;
    }

    std::optional<double> costAt(std::span<const double> point) {
        const std::vector<double> values = valuesAt(point);
        if (const auto found = known_.find(values); found != known_.end())
            return ++repeats_ > mostRepeats ? std::nullopt : std::optional(result_.candidates[found->second].cost);
        repeats_ = 0;
        return evaluate(values);
    }

    /// nullopt: the budget is spent, it was stopped, or something is wrong.
    std::optional<double> evaluate(const std::vector<double>& values) {
        std::vector<Candidate>& candidates = result_.candidates;
        std::int64_t& spent = result_.evaluations;
        std::size_t& best = result_.best;
        Candidate candidate{values, {}};
        for (const std::uint32_t look : race_.looks()) {
            const auto done = static_cast<std::uint32_t>(candidate.costs.size());
            if (spent + (look - done) > options_.evaluations) return std::nullopt;
            const auto more = costsOf(candidates.size(), values, done + 1, look - done);
            if (!more) return std::nullopt;
            candidate.costs.insert(candidate.costs.end(), more->begin(), more->end());
            spent += look - done;
            candidate.dropped =
                !candidates.empty() && look < options_.trials && race_.drops(candidate.costs, candidates[best].costs);
            if (candidate.dropped) break;
        }
        candidate.cost = meanOf(candidate.costs);
        if (candidate.dropped)
            candidate.cost = candidates[best].cost + meanOf(differences(candidate.costs, candidates[best].costs));
        candidate.evaluations = spent;
        candidate.best = !candidate.dropped && (candidates.empty() || candidate.cost < candidates[best].cost);
        if (candidate.best) best = candidates.size();
        known_[values] = candidates.size();
        candidates.push_back(std::move(candidate));
        if (progress_) progress_(spent, candidates[best].cost);
        return candidates.back().cost;
    }

    std::optional<std::vector<double>> costsOf(std::size_t candidate, const std::vector<double>& values,
                                               std::uint32_t first, std::uint32_t count) {
        auto costs = costs_(candidate, values, first, count);
        if (!costs) error_ = costs.error();
        if (costs && costs->size() < count) stopped_ = true;
        if (error_ || stopped_) return std::nullopt;
        return std::move(*costs);
    }

    void judge() {
        const std::size_t best = result_.best;
        auto before = costsOf(0, result_.candidates[0].values, options_.trials + 1, options_.heldOut);
        if (!before) return;
        auto after =
            best == 0 ? before : costsOf(best, result_.candidates[best].values, options_.trials + 1, options_.heldOut);
        if (!after) return;
        result_.before = std::move(*before);
        result_.after = std::move(*after);
    }

    const TunerOptions& options_;
    const TrialCosts& costs_;
    const TunerProgress& progress_;
    Race race_;
    TunerResult result_;
    std::map<std::vector<double>, std::size_t> known_;
    int repeats_ = 0;
    bool stopped_ = false;
    std::optional<Error> error_;
};

}  // namespace

Expected<TunerResult> tune(const TunerOptions& options, const TrialCosts& costs, const TunerProgress& progress) {
    return Tuner(options, costs, progress).run();
}

}  // namespace mrose
