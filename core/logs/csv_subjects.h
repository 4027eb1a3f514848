#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "logs/csv_cells.h"
#include "logs/robot_log.h"

namespace mrose {

/// The subjects of a CSV log while it is read, in the order in which they are first named.
class CsvSubjects {
public:
    /// The subject's place, of one that was not named yet too.
    std::size_t named(std::string_view name);

    /// A row without a time: it says where a landmark stands, or which robot a subject is. Error: it says something
    /// else, or of a subject of which another row has said otherwise.
    Expected<void> declare(const CsvRows& rows, const CsvCells& cells);

    /// The log's subjects. One that no row declares and that has the name of a robot is that robot; `incomplete` gets
    /// a sentence where landmarks have no position.
    std::vector<LogSubject> finish(const std::vector<RobotLog>& robots, std::vector<std::string>& incomplete);

private:
    std::vector<LogSubject> subjects_;
    std::vector<bool> declared_;
    std::map<std::string, std::size_t, std::less<>> byName_;
};

}  // namespace mrose
