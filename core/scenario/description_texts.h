#pragma once

#include <map>
#include <string>

namespace mrose {

/// What a scenario was made from, as its loader gave it and takes it again.
struct Descriptions {
    std::string scenario;                      ///< name of the scenario's own text
    std::map<std::string, std::string> texts;  ///< all of them by their names
    bool operator==(const Descriptions&) const = default;
};

}  // namespace mrose
