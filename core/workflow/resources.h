#pragma once

#include <filesystem>
#include <string>

#include "scenario/description_source.h"
#include "scenario/robot_kind.h"

namespace mrose {

/// The folder that holds resources/, shapes/ and nets/ as they ship: the one that MROSE_RESOURCES names; otherwise
/// share/mrose beside the program's folder, where it is installed, or the source tree that it is in; then the one that
/// it was built from.
std::filesystem::path resourceFolder();

/// The kinds of robots that ship. Error: what is wrong with one of their files.
Expected<RobotKinds> robotKinds();

/// Where a log of that name is: as it is named; otherwise in the folder that MROSE_DATA names, or in mrclam/ or drive/
/// there; as it is named, too, where it is nowhere.
std::string placeOfLog(const std::string& name);
/// Likewise. Error: there is none; says where it was looked for.
Expected<std::string> existingLog(const std::string& name);

/// Where a network file of that name is: as it is named, or among those that ship; as it is named, too, where it is
/// nowhere.
std::string placeOfNetwork(const std::string& name);

/// That there is a robot file of that name, as given or among those that ship, where --robot names it: errors would
/// name what is made from it otherwise.
Expected<void> checkRobotFile(const std::string& name);

/// Description files on disk. `log`, unless it is empty, is read instead of the logs that scenarios name.
DiskDescriptions openDescriptions(const std::string& log = {});

}  // namespace mrose
