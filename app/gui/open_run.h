#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/error.h"
#include "scenario/scenario.h"

namespace mrose::gui {

/// What the window is given to show.
struct OpenRun {
    std::string name;  ///< for the title
    std::shared_ptr<const Scenario> scenario;
    WorldState start;
};

/// Opens a scenario file, or the one of that name that ships.
Expected<OpenRun> openRun(const std::string& name, std::optional<std::uint64_t> seed);

}  // namespace mrose::gui
