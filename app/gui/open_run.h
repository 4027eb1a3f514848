#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "course.h"
#include "io/error.h"

namespace mrose::gui {

/// What the window is given to show.
struct OpenRun {
    std::string name;    ///< for the title
    std::string source;  ///< as it was opened
    CoursePointer course;
    WorldState start;
    std::vector<std::string> notes = {};  ///< what the user should know of it, a sentence each
};

/// Opens a scenario file, or the one of that name that ships.
Expected<OpenRun> openRun(const std::string& name, std::optional<std::uint64_t> seed);

}  // namespace mrose::gui
