#include "world/plain_seconds.h"

#include "io/number_text.h"

namespace mrose {

std::string plainSeconds(Nanoseconds duration) { return numberText(static_cast<double>(duration) / 1e9); }

}  // namespace mrose
