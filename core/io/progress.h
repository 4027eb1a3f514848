#pragma once

#include <functional>

namespace mrose {

/// Told which share of a long work is done, 0 ... 1, never less than before. False: the work is to end. Empty: nobody
/// asks.
using Progress = std::function<bool(double share)>;

}  // namespace mrose
