#include "tuning/search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include <nlopt.h>

#include "world/noise.h"

namespace mrose {
namespace {

constexpr std::size_t spreadPerDimension = 5;
constexpr double firstStep = 0.2, smallestStep = 0.05, tolerance = 0.02;  // shares of the ranges
/// So that a search draws nothing that trials or runs do.
constexpr std::uint64_t searchSeed = 0x74756e65;

class Search {
public:
    Search(const std::vector<double>& start, const std::vector<double>& leastSteps, std::uint64_t seed,
           const PointCost& cost)
        : start_(start), leastSteps_(leastSteps), seed_(seed ^ searchSeed), cost_(cost) {}

    void goOn() {
        ask(start_);
        spread();
        // From the cheapest; again, with a smaller step, where that has moved; else from anywhere.
        std::vector<double> refined;
        for (double step = firstStep; !over_;) {
            if (refined.empty() || isApart(refined, best_)) {
                refined = best_;
                descend(best_, step);
                step = std::max(step / 2, smallestStep);
            } else {
                std::vector<double> from(start_.size());
                for (double& share : from) share = draw();
                descend(from, firstStep);
            }
        }
    }

private:
    /// Farther than where a simplex ends tells.
    static bool isApart(const std::vector<double>& a, const std::vector<double>& b) {
        for (std::size_t i = 0; i < a.size(); ++i)
            if (std::abs(a[i] - b[i]) > 2 * tolerance) return true;
        return false;
    }

    double draw() { return uniformNoise({seed_, drawn_++, 0, 0}); }

    double ask(std::span<const double> point) {
        const auto cost = over_ ? std::nullopt : cost_(point);
        if (!cost) over_ = true;
        if (cost && *cost < least_) {
            least_ = *cost;
            best_.assign(point.begin(), point.end());
        }
        return cost.value_or(HUGE_VAL);
    }

    void spread() {
        const std::size_t count = spreadPerDimension * start_.size();
        std::vector<std::vector<double>> points(count, std::vector<double>(start_.size()));
        for (std::size_t dimension = 0; dimension < start_.size(); ++dimension) {
            std::vector<std::size_t> places(count);
            std::iota(places.begin(), places.end(), std::size_t{0});
            for (std::size_t i = count; i > 1; --i)
                std::swap(places[i - 1], places[static_cast<std::size_t>(draw() * static_cast<double>(i))]);
            for (std::size_t i = 0; i < count; ++i)
                points[i][dimension] = (static_cast<double>(places[i]) + draw()) / static_cast<double>(count);
        }
        for (std::size_t i = 0; i < count && !over_; ++i) ask(points[i]);
    }

    void descend(std::vector<double> point, double step) {
        if (over_) return;
        const auto dimensions = static_cast<unsigned>(point.size());
        const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> subplex(nlopt_create(NLOPT_LN_SBPLX, dimensions),
                                                                             &nlopt_destroy);
        std::vector<double> steps;
        for (const double least : leastSteps_) steps.push_back(std::min(std::max(step, least), 1.0));
        running_ = subplex.get();
        nlopt_set_lower_bounds1(running_, 0);
        nlopt_set_upper_bounds1(running_, 1);
        nlopt_set_initial_step(running_, steps.data());
        nlopt_set_xtol_abs1(running_, tolerance);
        nlopt_set_min_objective(
            running_,
            [](unsigned n, const double* at, double*, void* self) {
                auto& search = *static_cast<Search*>(self);
                const double cost = search.ask({at, n});
                if (search.over_) nlopt_force_stop(search.running_);
                return cost;
            },
            this);
        double cost = 0;
        nlopt_optimize(running_, point.data(), &cost);
    }

    const std::vector<double>& start_;
    const std::vector<double>& leastSteps_;
    std::uint64_t seed_;
    const PointCost& cost_;
    std::int64_t drawn_ = 0;
    bool over_ = false;
    double least_ = HUGE_VAL;
    std::vector<double> best_ = start_;
    nlopt_opt running_ = nullptr;
};

}  // namespace

void searchUnitCube(const std::vector<double>& start, const std::vector<double>& leastSteps, std::uint64_t seed,
                    const PointCost& cost) {
    Search(start, leastSteps, seed, cost).goOn();
}

}  // namespace mrose
