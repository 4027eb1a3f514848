#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/error.h"
#include "io/value.h"
#include "scenario/description_source.h"
#include "scenario/scenario_file.h"
#include "world/time.h"

namespace mrose {

/// An expression (condition/README.md) of a file, and where it stands there.
struct FileExpression {
    std::string text, key;
    std::uint32_t line = 0, column = 0;

    bool empty() const { return text.empty(); }
    /// What is wrong within the text, said of the file.
    Error placed(Error inText, const std::string& file) const;
    /// Likewise of the whole of it.
    Error placed(std::string cause, const std::string& file) const;
};

/// What differs from trial to trial.
struct Draw {
    enum class Kind {
        uniform,   ///< from `least` to `most`
        normal,    ///< of `mean` and `deviation`, drawn again until it is within `least` to `most`
        choice,    ///< one of `choices`, each as likely
        computed,  ///< what `expression` gives, of draws above it
        bodies     ///< how many of `bodies`, from the first on, there are: from `least` to `most`
    };
    std::string name;
    std::uint32_t line = 0, column = 0;  ///< where its name stands
    Kind kind = Kind::uniform;
    std::vector<std::string> paths;  ///< of the scenario's value: where it is put
    double least = 0, most = 0, mean = 0, deviation = 0;
    bool whole = false;  ///< of uniform ones: whole numbers, the ends among them
    std::vector<Value> choices;
    FileExpression expression;
    std::vector<std::string> bodies;
};

/// Where a draw is put.
struct DrawPlace {
    std::string path;
    std::size_t draw = 0;  ///< which one
};

/// A number that a trial gives, by an expression.
struct Measure {
    enum class Of {
        end,      ///< as it is at the trial's end
        least,    ///< over the trial, as it is looked at
        most,     ///< likewise
        mean,     ///< likewise
        seconds,  ///< for how long it holds
        times,    ///< how often it begins to hold
        first,    ///< s, when it holds first; NaN: never
        longest   ///< s, for how long it holds without a break at most
    };
    std::string name;
    Of of = Of::end;
    FileExpression expression;
};

/// A number that is asked at a trial's start.
struct Feature {
    std::string name;
    FileExpression expression;
};

/// Where in a sweep a variant is.
struct SweepPoint {
    std::string name, unit;  ///< of the sweep, "lost messages" and "%"; the unit may be ""
    double at = 0;
};

/// Another way to do the same trials: what it sets in the scenario, after all draws.
struct Variant {
    std::string name;
    std::optional<SweepPoint> sweep = {};
    std::uint32_t line = 0, column = 0;              ///< where its name, or that of its sweep, stands
    std::vector<std::pair<std::string, Value>> set;  ///< of its settings file first
};

/// Many trials of a scenario: what varies, what is asked at their starts, when they end, and what is measured
/// (resources/experiments/README.md).
struct Experiment {
    std::string file, name;
    ScenarioValue scenario;  ///< with all that it and the draws' choices name
    std::uint32_t firstTrial = 1, trials = 0;
    std::uint64_t seed = 0;   ///< of the draws, and of the first trial's first run
    std::uint32_t seeds = 1;  ///< runs of each trial
    Nanoseconds every = 0;    ///< how often a trial is looked at; a tick where it is 0
    FileExpression require, until;
    /// Until it holds, a trial goes as the scenario is written; then each variant goes on from a copy of that state,
    /// where features are asked and measuring begins. Empty: variants differ from the start on.
    FileExpression branch;
    Nanoseconds branchWithin = 0;       ///< after so long it does not branch any more
    std::vector<Draw> draws;            ///< in the order in which they are drawn
    std::vector<DrawPlace> drawPlaces;  ///< in the order in which they are put, those of all elements first
    std::vector<Variant> variants;      ///< at least one; without any in the file one without a name. Sweeps come last
    std::vector<Value::File> settings;  ///< files that variants name
    std::vector<Feature> features;
    std::vector<Measure> measures;

    /// Of a trial's run, from 0; each run has one of its own, the same for all variants.
    std::uint64_t noiseSeed(std::uint32_t trial, std::uint32_t run) const {
        return seed + (std::uint64_t{trial} - 1) * seeds + run;
    }
};

/// What expressions of an experiment that branches have among what was drawn: when it did, s.
constexpr const char* branchedAt = "branch_s";

/// Error: file, line, column and key of the first thing wrong, in the scenario too. What expressions say is not looked
/// at.
Expected<Experiment> readExperiment(const Value::File& file, DescriptionSource& source,
                                    const ScenarioLoading& loading = {});
/// Whether a description is one.
bool isExperiment(const Value& content);

}  // namespace mrose
