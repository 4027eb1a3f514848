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
        inputs;          ///< names of features, or of draws as "draw.x"; empty: all features not in `beside`
    std::string target;  ///< the name of a measure
    std::vector<std::string> beside;  ///< features that are guesses of the target, to be judged beside what is learned
    bool unfinished = false;          ///< of rows that `until` did not end, too
};

/// The rows as numbers.
struct TaskData {
    std::vector<std::string> inputs;
    std::string target;
    std::vector<double> x;             ///< [row][input]
    std::vector<double> y;             ///< [row]
    std::vector<std::uint32_t> trial;  ///< [row]
    struct Guess {
        std::string name;
        std::vector<double> of;  ///< [row]
    };
    std::vector<Guess> beside;
    std::int64_t unfinished = 0, faulty = 0, unknown = 0;  ///< rows that were left out

    std::size_t rows() const { return y.size(); }
    const double* inputsOf(std::size_t row) const { return x.data() + row * inputs.size(); }
    /// The rows whose trials are held out, or the others.
    TaskData part(int every, int offset, bool heldOut) const;
};

/// Error: a column that is asked for is missing, with those that there are; no row is left.
Expected<TaskData> taskData(const ResultsTable& table, const TaskQuestion& question);

}  // namespace mrose
