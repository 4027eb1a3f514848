#pragma once

#include <string>
#include <vector>

#include "io/error.h"
#include "learning/learned_network.h"

namespace mrose {

/// Something learned that a controller asks: numbers to numbers.
struct TaskNetwork {
    static constexpr const char* kind = "task";  ///< of its network files

    /// What an input was seen at while it was learned.
    struct Range {
        double least = 0, most = 0;
        bool operator==(const Range&) const = default;
    };

    LearnedNetwork learned;
    std::vector<Range> seen;        ///< by input; empty: not known
    std::vector<bool> logarithmic;  ///< by output: what is learned is its logarithm
    double heldOutError = 0;        ///< the sum of absolute errors over that of absolute values, held out; 0: not known
    bool operator==(const TaskNetwork&) const = default;
};

std::string taskFileText(const TaskNetwork& network);
/// From the text of a network file. Error: as of readNetworkFile(), in a file called `name`.
Expected<TaskNetwork> parseTask(const std::string& text, const std::string& name);

/// A task's network made ready for use; const, so that threads may share it. The same bits wherever it is asked.
class TaskInference {
public:
    explicit TaskInference(const TaskNetwork& network);

    std::size_t inputs() const { return inputs_.size(); }
    std::size_t outputs() const { return outputs_.size(); }
    /// `from` has inputs() numbers, `to` outputs().
    void evaluate(const double* from, double* to) const;
    /// How far outside of what was seen the input lies that is farthest out, as a share of the range that it was seen
    /// in; 0: all are within, or nothing is known of it.
    double beyond(const double* from) const;

private:
    std::vector<NetworkVariable> inputs_, outputs_;
    std::vector<TaskNetwork::Range> seen_;
    std::vector<bool> logarithmic_;
    RegressorInference inference_;
};

}  // namespace mrose
