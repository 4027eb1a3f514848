#include "control/controller.h"

#include <algorithm>

namespace mrose {
namespace {

template <class T>
bool allIdentical(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return identical(x, y); });
}

}  // namespace

void Decision::clear() {
    command.reset();
    earlier.clear();
    kicks.clear();
    messages.clear();
    annotations.clear();
    breakReason.clear();
    fault.clear();
}

bool Decision::sameOrders(const Decision& other) const {
    const bool sameCommand =
        command.has_value() == other.command.has_value() && (!command || identical(*command, *other.command));
    return sameCommand && allIdentical(earlier, other.earlier) && allIdentical(kicks, other.kicks) &&
           allIdentical(messages, other.messages);
}

}  // namespace mrose
