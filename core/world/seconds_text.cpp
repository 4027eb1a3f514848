#include "world/seconds_text.h"

#include "io/number_text.h"

namespace mrose {

std::string secondsText(Nanoseconds duration) { return numberText(static_cast<double>(duration) / 1e9); }

}  // namespace mrose
