#pragma once

#include <string>

#include "control/controller.h"
#include "io/bytes.h"

namespace mrose {

// Decisions as recordings keep them and as plug-ins' processes send them. README.md tells the layout.

/// What was ordered and why the controller failed, exact to the bit; what is only to be looked at (annotations, breaks)
/// is left out. `fromOutside`: told to the robot instead of what its controller decided.
void appendOrders(const Decision& decision, bool fromOutside, std::string& bytes);

/// Whether there was a sound one; nothing is allocated for more elements than there are bytes for.
bool readOrders(ByteReader& reader, Decision& decision, bool& fromOutside);

/// The orders, then annotations and break.
void appendDecision(const Decision& decision, std::string& bytes);
bool readDecision(ByteReader& reader, Decision& decision);

}  // namespace mrose
