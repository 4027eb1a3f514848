#include "control/controller.h"

namespace mrose {

void Decision::clear() {
    command.reset();
    earlier.clear();
    kicks.clear();
    annotations.clear();
    breakReason.clear();
    fault.clear();
}

}  // namespace mrose
