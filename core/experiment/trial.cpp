#include "experiment/trial.h"

#include <algorithm>
#include <cmath>

#include "scenario/start_check.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

constexpr int mostDraws = 100;
constexpr std::uint32_t mostNormalDraws = 1000;
/// So that an experiment's draws are none of a batch's, nor a run's noise.
constexpr std::uint64_t drawSeed = 0x6578706572696d65;

double within(const Draw& draw, double u) {
    if (!draw.whole && draw.kind != Draw::Kind::bodies) return draw.least + u * (draw.most - draw.least);
    return draw.least + std::floor(u * (draw.most - draw.least + 1));
}

std::string who(std::uint32_t number) { return inTrial(std::to_string(number)); }

Expected<ScenarioValue> with(ScenarioValue value, const Draw& draw, const Value& drawn) {
    for (const std::string& path : draw.paths) {
        auto changed = value.with(path, drawn);
        if (!changed) return changed;
        value = std::move(*changed);
    }
    return value;
}

Expected<ScenarioValue> with(ScenarioValue value, const Variant& variant) {
    for (const auto& [path, set] : variant.set) {
        auto changed = value.with(path, set);
        if (!changed) return changed;
        value = std::move(*changed);
    }
    return value;
}

}  // namespace

TrialMaker::TrialMaker(const Experiment& experiment, TrialExpressions& expressions, ScenarioLoading loading)
    : experiment_(experiment),
      expressions_(expressions),
      loading_(std::move(loading)),
      computed_(experiment.draws.size()) {
    loading_.checkStarts = false;
}

Expected<void> TrialMaker::loadBase() {
    if (base_) return {};
    auto loaded = loadScenario(experiment_.scenario, library_, loading_);
    if (!loaded) return tl::unexpected(loaded.error());
    base_.emplace(std::move(loaded->parts));
    return {};
}

Expected<Value> TrialMaker::valueOf(const Draw& draw, std::uint32_t index, std::uint32_t number, int attempt,
                                    const DrawnValues& drawn) {
    NoiseKey key{experiment_.seed ^ drawSeed, attempt, number, channelOf(NoiseChannel::trial, index)};
    switch (draw.kind) {
        case Draw::Kind::uniform:
        case Draw::Kind::bodies:
            return Value(within(draw, uniformNoise(key)));
        case Draw::Kind::choice:
            return draw.choices[static_cast<std::size_t>(uniformNoise(key) * static_cast<double>(draw.choices.size()))];
        case Draw::Kind::normal:
            for (std::uint32_t times = 0; times < mostNormalDraws; ++times, key.tick += mostDraws) {
                const double value = draw.mean + draw.deviation * normalNoise(key);
                if (value >= draw.least && value <= draw.most) return Value(value);
            }
            return fail(experiment_.file, "a thousand normal draws were outside of `least` to `most`" + who(number), 0,
                        "draw[\"" + draw.name + "\"]");
        case Draw::Kind::computed:
            break;
    }
    if (const auto loaded = loadBase(); !loaded) return tl::unexpected(loaded.error());
    const WorldState start = base_->initialState();
    const Moment moment{.scenario = &*base_, .state = &start, .drawn = &drawn};
    std::optional<WorldValue>& computed = computed_[index];
    if (!computed) {
        auto compiled = compileWorldValue(draw.expression.text, *base_, "", nullptr, &drawn);
        if (!compiled) return tl::unexpected(draw.expression.placed(compiled.error(), experiment_.file));
        computed.emplace(std::move(*compiled));
    }
    const auto value = computed->value(moment);
    if (!value) return tl::unexpected(draw.expression.placed(value.error(), experiment_.file));
    return Value(*value);
}

Expected<DrawnValues> TrialMaker::draw(std::uint32_t number, int attempt) {
    DrawnValues drawn;
    for (std::uint32_t i = 0; i < experiment_.draws.size(); ++i) {
        auto value = valueOf(experiment_.draws[i], i, number, attempt, drawn);
        if (!value) return tl::unexpected(value.error());
        drawn.push_back({experiment_.draws[i].name, std::move(*value)});
    }
    if (!experiment_.branch.empty()) drawn.push_back({branchedAt, 0.0});
    return drawn;
}

Expected<ScenarioValue> TrialMaker::drawnScenario(std::uint32_t number, const DrawnValues& drawn) const {
    auto value = experiment_.scenario.with("seed", static_cast<std::int64_t>(experiment_.noiseSeed(number, 0)));
    for (const DrawPlace& place : experiment_.drawPlaces)
        if (value) value = value->with(place.path, drawn[place.draw].value);
    return value;
}

ScenarioValue TrialMaker::withoutBodies(ScenarioValue value, const DrawnValues& drawn) const {
    for (std::size_t i = 0; i < experiment_.draws.size(); ++i) {
        const Draw& draw = experiment_.draws[i];
        if (draw.kind != Draw::Kind::bodies) continue;
        for (auto k = static_cast<std::size_t>(*drawn[i].value.asFloat()); k < draw.bodies.size(); ++k)
            value = value.without(value.bodyPath(draw.bodies[k]));
    }
    return value;
}

Expected<std::optional<LoadedScenario>> TrialMaker::scenarioOf(const ScenarioValue& value) {
    auto loaded = loadScenario(value, library_, loading_);
    if (!loaded) return tl::unexpected(loaded.error());
    if (findStartOverlap(loaded->parts.scene)) return std::optional<LoadedScenario>();
    return std::optional<LoadedScenario>(std::move(*loaded));
}

Expected<bool> TrialMaker::isWanted(const LoadedScenario& loaded, const DrawnValues& drawn) {
    if (experiment_.require.empty()) return true;
    const Scenario scenario(loaded.parts);
    const WorldState start = scenario.initialState();
    const Moment moment{.scenario = &scenario, .state = &start, .drawn = &drawn};
    const auto compiled = expressions_.of(moment);
    if (!compiled) return tl::unexpected(compiled.error());
    auto holds = (*compiled)->require->holds(moment);
    if (!holds) return tl::unexpected(experiment_.require.placed(holds.error(), experiment_.file));
    return *holds;
}

Expected<Trial> TrialMaker::make(std::uint32_t number) {
    auto trial = makeOrFault(number);
    if (trial && trial->fault) return tl::unexpected(std::move(*trial->fault));
    return trial;
}

Expected<Trial> TrialMaker::makeOrFault(std::uint32_t number) {
    const auto faulty = [](Error error) {
        Trial trial;
        trial.fault = std::move(error);
        return trial;
    };
    if (std::ranges::count(experiment_.draws, Draw::Kind::computed, &Draw::kind) > 0)
        if (const auto loaded = loadBase(); !loaded) return tl::unexpected(loaded.error());
    for (int attempt = 0; attempt < mostDraws; ++attempt) {
        auto drawn = draw(number, attempt);
        if (!drawn) return faulty(drawn.error());
        const auto value = drawnScenario(number, *drawn);
        if (!value) return tl::unexpected(value.error());
        Trial trial{std::move(*drawn), {}};
        const auto unmade = [&](const Error& error, const ScenarioValue& scenario,
                                const Variant* variant) -> Expected<Trial> {
            Error of = told(error, trial.drawn, variant, who(number));
            if (isOfTheTrial(error, scenario, variant)) return faulty(std::move(of));
            return tl::unexpected(std::move(of));
        };
        bool wanted = true;
        if (!experiment_.branch.empty()) {
            const ScenarioValue before = withoutBodies(*value, trial.drawn);
            auto loaded = scenarioOf(before);
            if (!loaded) return unmade(loaded.error(), before, nullptr);
            if (!*loaded) continue;
            trial.before = std::move(**loaded);
        }
        for (const Variant& variant : experiment_.variants) {
            const auto varied = with(*value, variant);
            if (!varied) return tl::unexpected(varied.error());
            const ScenarioValue own = withoutBodies(*varied, trial.drawn);
            auto loaded = scenarioOf(own);
            if (!loaded) return unmade(loaded.error(), own, &variant);
            if (!*loaded) wanted = false;
            if (wanted && &variant == experiment_.variants.data()) {
                const auto asked = isWanted(**loaded, trial.drawn);
                if (!asked) return faulty(asked.error());
                wanted = *asked;
            }
            if (!wanted) break;
            trial.scenarios.push_back(std::move(**loaded));
        }
        if (wanted) return trial;
    }
    const std::string cause =
        "in a hundred draws bodies overlapped, or what is required did not hold; expected ranges with room" +
        who(number);
    return faulty(experiment_.require.placed(cause, experiment_.file));
}

/// Whether it is made by what is drawn: without that there is no such error, and with it there is again. What a missing
/// file or a program that cannot be started says, other trials would say as well.
bool TrialMaker::isOfTheTrial(const Error& error, const ScenarioValue& value, const Variant* variant) {
    const auto loads = [&](const Expected<ScenarioValue>& scenario) {
        return scenario && loadScenario(*scenario, library_, loading_);
    };
    if (!loads(experiment_.scenario)) return false;
    if (variant != nullptr && !loads(with(experiment_.scenario, *variant))) return false;
    const auto again = loadScenario(value, library_, loading_);
    return !again && again.error().message() == error.message();
}

/// What is wrong with a trial's scenario, of the scenario's own file where it is wrong as it is written, else of the
/// draw or the variant that makes the same mistake alone; of what is set twice the last one counts.
Error TrialMaker::told(Error error, const DrawnValues& drawn, const Variant* variant, const std::string& where) {
    const auto isMadeBy = [&](const Expected<ScenarioValue>& alone) {
        if (!alone) return false;
        const auto loaded = loadScenario(*alone, library_, loading_);
        return !loaded && loaded.error().message() == error.message();
    };
    const auto toldAt = [&](std::uint32_t line, std::uint32_t column, const char* kind, const std::string& name) {
        return Error{experiment_.file, static_cast<int>(line), static_cast<int>(column),
                     std::string(kind) + "[\"" + name + "\"]", error.key + ": " + error.cause + where};
    };
    if (isMadeBy(experiment_.scenario)) return error;
    if (variant != nullptr && isMadeBy(with(experiment_.scenario, *variant)))
        return toldAt(variant->line, variant->column, "variant", variant->name);
    for (std::size_t i = experiment_.draws.size(); i-- > 0;) {
        const Draw& draw = experiment_.draws[i];
        if (isMadeBy(with(experiment_.scenario, draw, drawn[i].value)))
            return toldAt(draw.line, draw.column, "draw", draw.name);
    }
    error.cause += where;
    return error;
}

/// As it is drawn where draw `i` gives `value`: what is computed of it changes with it.
Expected<DrawnValues> TrialMaker::drawnWith(DrawnValues drawn, std::size_t i, const Value& value) {
    drawn[i].value = value;
    for (std::size_t k = i + 1; k < experiment_.draws.size(); ++k) {
        if (experiment_.draws[k].kind != Draw::Kind::computed) continue;
        auto computed = valueOf(experiment_.draws[k], static_cast<std::uint32_t>(k), experiment_.firstTrial, 0, drawn);
        if (!computed) return tl::unexpected(computed.error());
        drawn[k].value = std::move(*computed);
    }
    return drawn;
}

/// Whatever is drawn must make a scenario: each draw's ends and choices are tried, beside the others as first drawn.
Expected<void> TrialMaker::checkEnds(const DrawnValues& first) {
    for (std::size_t i = 0; i < experiment_.draws.size(); ++i) {
        const Draw& draw = experiment_.draws[i];
        std::vector<Value> ends = draw.choices;
        if (draw.kind == Draw::Kind::uniform || draw.kind == Draw::Kind::normal)
            for (const double end : {draw.least, draw.most})
                if (std::isfinite(end)) ends.emplace_back(end);
        for (const Value& end : ends) {
            const auto drawn = drawnWith(first, i, end);
            if (!drawn) return tl::unexpected(drawn.error());
            const auto value = drawnScenario(experiment_.firstTrial, *drawn);
            if (!value) return tl::unexpected(value.error());
            if (loadScenario(*value, library_, loading_)) continue;
            // Wrong as it is drawn; a variant may set it otherwise.
            for (const Variant& variant : experiment_.variants) {
                const auto varied = with(*value, variant);
                if (!varied) return tl::unexpected(varied.error());
                if (const auto loaded = loadScenario(*varied, library_, loading_); !loaded)
                    return tl::unexpected(told(loaded.error(), *drawn, &variant, " (as it may be drawn)"));
            }
        }
    }
    return {};
}

Expected<void> TrialMaker::check() {
    constexpr std::size_t mostSets = 256;
    const auto trial = make(experiment_.firstTrial);
    if (!trial) return tl::unexpected(trial.error());
    if (auto fits = checkEnds(trial->drawn); !fits) return fits;
    std::vector<DrawnValues> sets{trial->drawn};
    for (std::size_t i = 0; i < experiment_.draws.size(); ++i) {
        const Draw& draw = experiment_.draws[i];
        if (draw.kind != Draw::Kind::bodies) continue;
        std::vector<DrawnValues> more;
        const bool all = static_cast<double>(sets.size()) * (draw.most - draw.least + 1) <= mostSets;
        for (const DrawnValues& drawn : sets)
            for (auto count = static_cast<int>(draw.least); count <= static_cast<int>(draw.most); ++count) {
                if (!all && count != static_cast<int>(draw.least) && count != static_cast<int>(draw.most)) continue;
                more.push_back(drawn);
                more.back()[i].value = static_cast<double>(count);
            }
        sets = std::move(more);
    }
    for (const DrawnValues& drawn : sets)
        if (auto fits = checkExpressions(experiment_.firstTrial, drawn); !fits) return fits;
    return {};
}

Expected<void> TrialMaker::checkExpressions(std::uint32_t number, const DrawnValues& drawn) {
    auto value = drawnScenario(number, drawn);
    if (!value) return tl::unexpected(value.error());
    *value = withoutBodies(std::move(*value), drawn);
    auto loaded = loadScenario(*value, library_, loading_);
    if (!loaded) return tl::unexpected(told(loaded.error(), drawn, nullptr, who(number)));
    const Scenario scenario(std::move(loaded->parts));
    const WorldState start = scenario.initialState();
    const std::vector<RobotInsight> none(start.robots.size());
    const Moment moment{.scenario = &scenario, .state = &start, .insights = none, .drawn = &drawn};
    return expressions_.check(moment);
}

}  // namespace mrose
