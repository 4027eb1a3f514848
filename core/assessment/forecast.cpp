#include "assessment/forecast.h"

#include <algorithm>
#include <cmath>

#include "geometry/angle.h"
#include "geometry/elementary.h"
#include "learning/parallel_for.h"
#include "learning/sample_scores.h"

namespace mrose {
namespace {

using PerError = ForecastAt::PerError;

constexpr double half = 0.5, nineTenths = 0.9;
/// Windows whose samples are held at the same time.
constexpr std::size_t groupSize = 32;

/// 1/10, 1/5, 1/2 and all of the longest window, in steps.
std::vector<std::size_t> forecastInstants(const LogWindows& log) {
    int longest = 0;
    for (const Window& window : log.windows) longest = std::max(longest, window.steps());
    std::vector<std::size_t> instants;
    for (const double share : {0.1, 0.2, 0.5, 1.0}) {
        const auto instant = static_cast<std::size_t>(std::max(1L, std::lround(share * longest)));
        if (instants.empty() || instants.back() < instant) instants.push_back(instant);
    }
    return instants;
}

Pose meanPose(std::span<const Pose> samples) {
    Pose sum;
    double sine = 0, cosine = 0;
    for (const Pose& pose : samples) {
        sum.x += pose.x;
        sum.y += pose.y;
        sine += mrose::sine(pose.heading);
        cosine += mrose::cosine(pose.heading);
    }
    const auto count = static_cast<double>(samples.size());
    return {sum.x / count, sum.y / count, arcTangent(sine, cosine)};
}

PerError seenFrom(const Pose& frame, const Pose& pose) {
    const Pose seen = relative(frame, pose);
    return {seen.x, seen.y, wrapAngle(seen.heading)};
}

Point positionSeenFrom(const Pose& frame, const Pose& pose) { return position(relative(frame, pose)); }

/// Sums over windows of what is judged at one instant.
void addWindow(ForecastAt& at, std::size_t index, std::span<const Pose> samples, const Pose& truth) {
    const Pose frame = meanPose(samples);
    const PerError real = seenFrom(frame, truth);
    std::vector<Point> positions;
    std::array<std::vector<double>, ForecastAt::errors> errors;
    for (const Pose& sample : samples) {
        const PerError seen = seenFrom(frame, sample);
        positions.push_back({seen[0], seen[1]});
        for (std::size_t e = 0; e < seen.size(); ++e) errors[e].push_back(seen[e]);
    }
    at.energy += energyScore(positions, {real[0], real[1]});
    PerError ranks{};
    for (std::size_t e = 0; e < errors.size(); ++e) {
        at.ranked[e] += rankedScore(errors[e], real[e]);
        const auto below = std::count_if(errors[e].begin(), errors[e].end(), [&](double x) { return x < real[e]; });
        const auto equal = std::count(errors[e].begin(), errors[e].end(), real[e]);
        ranks[e] = (static_cast<double>(below) + 0.5 * static_cast<double>(equal) + 0.5) /
                   static_cast<double>(samples.size() + 1);
        const auto width = [&](double share) {
            return quantile(errors[e], (1 + share) / 2) - quantile(errors[e], (1 - share) / 2);
        };
        at.half[e] += width(half);
        at.nineTenths[e] += width(nineTenths);
    }
    at.windows.push_back(index);
    at.ranks.push_back(ranks);
}

void divide(ForecastAt& at) {
    const auto windows = static_cast<double>(at.ranks.size());
    at.energy /= windows;
    for (PerError* sums : {&at.ranked, &at.half, &at.nineTenths})
        for (double& sum : *sums) sum /= windows;
}

/// The rollouts of some windows: [sample][window], each a list of poses; and those of the mean alone.
struct GroupRollouts {
    std::vector<std::vector<std::vector<Pose>>> samples;
    std::vector<std::vector<Pose>> mean;
};

/// One model's forecast, window by window.
class Judge {
public:
    Judge(const LogWindows& log, const SampledModel& model) : log_(log), instants_(forecastInstants(log)) {
        forecast_.name = model.noisy.name;
        forecast_.model = model.model;
        forecast_.samples = model.samples;
        for (const std::size_t instant : instants_)
            forecast_.at.emplace_back().time = static_cast<Nanoseconds>(instant) * log.options.step;
        moves_.resize(instants_.size() - 1);
        positions_.resize(instants_.back());
        headings_.resize(instants_.back());
    }

    /// Windows in their order. `index`: in the log, `in`: in the group.
    void add(std::size_t index, const GroupRollouts& rollouts, std::size_t in) {
        const Window& window = log_.windows[index];
        const auto steps = static_cast<std::size_t>(window.steps());
        const auto samplesAt = [&](std::size_t step) {
            std::vector<Pose> poses;
            for (const auto& sample : rollouts.samples) poses.push_back(sample[in][step - 1]);
            return poses;
        };
        for (std::size_t i = 0; i < instants_.size() && instants_[i] <= steps; ++i) {
            const std::vector<Pose> samples = samplesAt(instants_[i]);
            addWindow(forecast_.at[i], index, samples, window.truth[instants_[i]]);
            if (i > 0)
                moves_[i - 1].add(samplesAt(instants_[i - 1]), samples, window.truth[instants_[i - 1]],
                                  window.truth[instants_[i]]);
        }
        if (rollouts.samples.size() < 2) return;
        std::vector<PoseRegion>& regions = forecast_.regions.emplace_back();
        for (std::size_t k = 0; k < steps; ++k) {
            regions.push_back(regionOf(samplesAt(k + 1), rollouts.mean[in][k]));
            for (const auto& sample : rollouts.samples) {
                positions_[k].push_back(length(position(sample[in][k]) - position(rollouts.mean[in][k])));
                headings_[k].push_back(std::abs(wrapAngle(sample[in][k].heading - rollouts.mean[in][k].heading)));
            }
        }
    }

    Forecast result() {
        std::erase_if(forecast_.at, [](const ForecastAt& at) { return at.ranks.empty(); });
        for (ForecastAt& at : forecast_.at) divide(at);
        for (const Moves& moves : moves_) forecast_.moves += moves.mean();
        for (std::size_t k = 0; k < positions_.size() && !positions_[k].empty(); ++k)
            forecast_.expected.push_back({toSeconds(static_cast<Nanoseconds>(k + 1) * log_.options.step),
                                          distribution(std::move(positions_[k])),
                                          distribution(std::move(headings_[k]))});
        return std::move(forecast_);
    }

private:
    /// Displacements from one instant to another.
    struct Moves {
        double sum = 0;
        std::size_t windows = 0;
        void add(std::span<const Pose> from, std::span<const Pose> to, const Pose& truthFrom, const Pose& truthTo) {
            std::vector<Point> moved;
            for (std::size_t s = 0; s < from.size(); ++s) moved.push_back(positionSeenFrom(from[s], to[s]));
            sum += energyScore(moved, positionSeenFrom(truthFrom, truthTo));
            ++windows;
        }
        double mean() const { return windows == 0 ? 0 : sum / static_cast<double>(windows); }
    };

    const LogWindows& log_;
    std::vector<std::size_t> instants_;
    Forecast forecast_;
    std::vector<Moves> moves_;
    std::vector<std::vector<double>> positions_, headings_;  ///< by step: of all windows' samples
};

/// The windows from `first` on, of which there are starts.
Expected<GroupRollouts> rollOutGroup(const SampledModel& model, const Log& log, std::span<const RolloutStart> starts,
                                     std::span<const std::size_t> robots, const RolloutOptions& options) {
    auto mean = rollOut(model.mean, log, starts, robots, options);
    if (!mean) return tl::unexpected(mean.error());
    GroupRollouts group{{}, std::move(*mean)};
    if (model.samples < 2) {
        group.samples.push_back(group.mean);
        return group;
    }
    std::vector<Expected<std::vector<std::vector<Pose>>>> drawn(static_cast<std::size_t>(model.samples));
    parallelFor(drawn.size(), [&](std::size_t k) {
        std::vector<RolloutStart> runs(starts.begin(), starts.end());
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[i].seed = sampleSeed(1, log.robots[robots[i]].robot, runs[i], static_cast<std::uint32_t>(k));
        drawn[k] = rollOut(model.noisy, log, runs, robots, options);
    });
    for (auto& sample : drawn) {
        if (!sample) return tl::unexpected(sample.error());
        group.samples.push_back(std::move(*sample));
    }
    return group;
}

}  // namespace

double ForecastAt::inside(double share, std::size_t error) const {
    std::size_t count = 0;
    for (std::size_t rank = 0; rank < ranks.size(); ++rank) count += isInside(rank, error, share);
    return static_cast<double>(count) / static_cast<double>(ranks.size());
}

double ForecastAt::inside(double share) const {
    double sum = 0;
    for (std::size_t e = 0; e < errors; ++e) sum += inside(share, e);
    return sum / static_cast<double>(errors);
}

double Forecast::energy() const {
    double sum = 0;
    for (const ForecastAt& one : at) sum += one.energy;
    return sum;
}

double Forecast::heading() const {
    double sum = 0;
    for (const ForecastAt& one : at) sum += one.ranked[2];
    return sum;
}

double Forecast::miss() const {
    if (samples < 2) return unknownNumber;
    double most = 0;
    for (const ForecastAt& one : at)
        for (const double share : {half, nineTenths}) most = std::max(most, 100 * std::abs(one.inside(share) - share));
    return most;
}

Expected<std::vector<Forecast>> forecast(const Log& log, const LogWindows& against,
                                         std::span<const SampledModel> models, const Progress& progress) {
    std::vector<RolloutStart> starts = rolloutStarts(log, against.windows);
    const std::vector<std::size_t> robots = robotsOf(against.windows);
    const RolloutOptions options{.step = against.options.step};
    std::vector<Forecast> forecasts;
    TrackerHistories histories;
    for (std::size_t m = 0; m < models.size(); ++m) {
        Judge judge(against, models[m]);
        fillTracked(models[m].mean, log, starts, robots, histories);
        for (std::size_t first = 0; first < starts.size(); first += groupSize) {
            const double share = static_cast<double>(first) / static_cast<double>(starts.size());
            if (!mayGoOn(progress, (static_cast<double>(m) + share) / static_cast<double>(models.size())))
                return fail("", "the evaluation was ended before its end");
            const std::size_t count = std::min(groupSize, starts.size() - first);
            const auto group = rollOutGroup(models[m], log, std::span(starts).subspan(first, count),
                                            std::span(robots).subspan(first, count), options);
            if (!group) return tl::unexpected(group.error());
            for (std::size_t i = 0; i < count; ++i) judge.add(first + i, *group, i);
        }
        forecasts.push_back(judge.result());
    }
    return forecasts;
}

}  // namespace mrose
