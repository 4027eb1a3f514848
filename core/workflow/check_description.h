#pragma once

#include <string>
#include <vector>

#include "drawing/scene_drawing.h"
#include "io/error.h"

namespace mrose {

/// A description file that is to be checked and drawn: a shape, an environment, a robot, a scenario.
struct CheckRequest {
    std::string file;      ///< or the name of one that ships
    std::string log = {};  ///< read instead of those that scenarios name
    DrawingOptions drawing = {};
};

struct CheckedDescription {
    std::string file, kind, name;
    std::string holds;               ///< in words
    std::string picture;             ///< SVG
    std::vector<std::string> notes;  ///< what is most likely a mistake, a sentence each
};

/// Runs nobody's code: plug-ins are not loaded. Error: the first thing wrong in any file that it is made from.
Expected<CheckedDescription> checkDescription(const CheckRequest& request);

/// Writes all pictures, or none: to one .svg file, or into a folder, which is made where it is missing, as files named
/// after the descriptions and their kinds. Error: several for one file; one name twice; a file cannot be written, or is
/// there already.
Expected<void> writePictures(const std::vector<CheckedDescription>& checked, const std::string& out, bool overwrite);

}  // namespace mrose
