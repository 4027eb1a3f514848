#pragma once

#include <functional>

namespace mrose {

/// Called with the share of a long work that is done, 0 ... 1, never less than before. False: the work is to end.
/// Empty: progress is not reported.
using Progress = std::function<bool(double share)>;

/// Asked now and then by a work of unknown length; false: it is to end.
using GoesOn = std::function<bool()>;

/// Whether a work that has come so far is to go on.
inline bool mayGoOn(const Progress& progress, double share) { return !progress || progress(share); }

}  // namespace mrose
