#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "condition/condition.h"
#include "experiment/experiment_file.h"

namespace mrose {

/// The expressions of an experiment, compiled for scenarios with the same bodies and goals.
struct CompiledExpressions {
    std::optional<Condition> require, branch, until;
    std::vector<WorldValue> features, measures;
    bool follows = false;  ///< `until` or a measure reads what robots saw and decided
};

/// Compiles them once for all scenarios with the same bodies and goals. For one thread.
class TrialExpressions {
public:
    /// The experiment must stay where it is.
    explicit TrialExpressions(const Experiment& experiment) : experiment_(experiment) {}

    /// `start`: of a trial, with what was drawn for it. Error: file, line and column of the first thing wrong.
    Expected<CompiledExpressions*> of(const Moment& start);
    /// That they can be answered at a start, and that what they ask of controllers' and motion models' memories is
    /// there: otherwise it is NaN. For the scenario without a variant: in variants with other controllers it may be
    /// missing. Error: likewise.
    Expected<void> check(const Moment& start) const;

private:
    Expected<CompiledExpressions> compiled(const Moment& start, bool tried) const;

    const Experiment& experiment_;
    std::map<std::string, CompiledExpressions> compiled_;  ///< by the names of bodies and goals
};

/// What one run of a trial gives.
class TrialMeasurement {
public:
    /// `between`: from look to look.
    TrialMeasurement(const Experiment& experiment, CompiledExpressions& expressions, Nanoseconds between);

    /// Asks the features, at the run's start.
    Expected<void> begin(const Moment& start);
    /// Of a run that did not come to where it begins, or of which something cannot be measured: no measure is known,
    /// and of the features those that were asked.
    void skip();
    /// A look at it. Gives whether the trial is over.
    Expected<bool> look(const Moment& at);
    /// At its end, after the last look.
    Expected<void> end(const Moment& at);

    const std::vector<double>& features() const { return features_; }
    const std::vector<double>& measures() const { return measures_; }

private:
    Expected<double> valueOf(std::size_t measure, const Moment& at);
    Expected<bool> isOver(const Moment& at);
    double inSeconds(double looks) const;

    const Experiment& experiment_;
    CompiledExpressions& expressions_;
    Nanoseconds between_;
    std::vector<double> features_, measures_;
    std::vector<std::size_t> firstOfText_;     ///< by measure, the first with the same text
    std::vector<bool> isUntil_;                ///< by measure, whether it asks during the run what `until` does
    std::vector<std::optional<double>> seen_;  ///< by measure, what this look gave
    std::optional<bool> over_;                 ///< what `until` gave at this look
    std::vector<std::int64_t> held_;           ///< by measure, for how many looks up to the last
    std::int64_t looks_ = 0;
};

}  // namespace mrose
