#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mrose {

/// A number of a scenario that is searched for.
struct TunedParameter {
    std::string name;
    std::uint32_t line = 0, column = 0;  ///< where its name stands
    std::vector<std::string> paths;      ///< of the scenario's value: where it is put
    double from = 0, to = 1;
    double start = 0;          ///< what it is now
    bool logarithmic = false;  ///< searched by its logarithm; `from` is above 0
    bool whole = false;        ///< whole numbers, both ends among them
};

/// What lies at a share, 0 to 1, of the way from `from` to `to`, as a short decimal number: to a thousandth of the
/// range at most, of a logarithmic one to a thousandth of the number.
double valueAt(const TunedParameter& parameter, double share);
/// Where a value between them lies.
double shareOf(const TunedParameter& parameter, double value);
/// How far one has to go, as a share, for another value: of whole numbers far where there are few.
double leastStep(const TunedParameter& parameter);

}  // namespace mrose
