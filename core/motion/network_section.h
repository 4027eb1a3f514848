#pragma once

#include "io/toml_table.h"
#include "motion/motion_network.h"

namespace mrose {

// Parts of a network file that all versions of it have. For .cpp files of their readers: it shows TomlTable.

/// Form, robots, period and traits of the drive.
void readMotionBasics(TomlTable& table, MotionNetwork& network);
/// [wheel_phase], [drive], [recovery] and [[identified]], as far as they are there or the form needs them.
void readMotionParts(TomlTable& table, MotionNetwork& network);
/// Quantity and part of the history.
NetworkInput readNetworkInput(TomlTable& table, const std::vector<std::string>& robots);
void readHeldOutError(TomlTable& table, MotionNetwork::HeldOut& heldOut);
/// What inputs need of the rest.
void checkMotionInputs(TomlTable& table, const MotionNetwork& network);

/// A file of the first version, which knew motion only: "mrose motion network".
bool isFirstMotionVersion(TomlTable& root);
Expected<MotionNetwork> readFirstMotionVersion(TomlTable& root);

}  // namespace mrose
