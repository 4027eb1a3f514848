#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/results_table.h"
#include "io/error.h"

namespace mrose {

/// What is to be learned of an experiment's rows.
struct TaskQuestion {
    std::vector<std::string>
        inputs;          ///< names of features, of draws as "draw.x", or "swept"; empty: all features not in `beside`
    std::string target;  ///< the name of a measure
    std::vector<std::string> beside;  ///< features that are guesses of the target, to be judged beside what is learned
    bool unfinished = false;          ///< of rows that `until` did not end, too
    bool byVariant = false;           ///< what each variant comes to, so that one can be chosen; without `beside`
    bool greatest = false;            ///< by variant: the greatest target is best, not the least
};

/// The rows as numbers.
struct TaskData {
    std::vector<std::string> inputs;
    std::string target;
    std::vector<std::string> variants;  ///< by variant: their names; a row is a trial then, and y the mean of its runs
    std::vector<double> x;              ///< [row][input]
    std::vector<double> y;              ///< [row][output]: the target, or that of each variant
    std::vector<std::uint32_t> trial;   ///< [row]
    std::vector<std::string> window;    ///< [row][output]: what opens it, or its first run, in the window
    struct Guess {
        std::string name;
        std::vector<double> of;  ///< [row]
    };
    std::vector<Guess> beside;
    std::size_t seeds = 0;                                 ///< by variant: how many runs each trial has of each
    std::vector<double> bySeed;                            ///< by variant: [row][seed][variant]
    std::int64_t unfinished = 0, faulty = 0, unknown = 0;  ///< runs that were left out; by variant, of the last, trials

    std::size_t rows() const { return trial.size(); }
    std::size_t outputs() const { return variants.empty() ? 1 : variants.size(); }
    const double* inputsOf(std::size_t row) const { return x.data() + row * inputs.size(); }
    /// The rows whose trials are held out, or the others.
    TaskData part(int every, int offset, bool heldOut) const;
};

/// By variant, trials of which a run is left out are left out whole, and counted as `unknown`; of the inputs those of
/// the first run of the first variant count. Error: a column that is asked for is missing, with those that there are;
/// no row is left; by variant, there is only one; a name is given twice.
Expected<TaskData> taskData(const ResultsTable& table, const TaskQuestion& question);

}  // namespace mrose
