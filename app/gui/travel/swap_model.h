#pragma once

#include <string>

#include "io/error.h"
#include "travel/course.h"

namespace mrose::gui {

/// The same course with the network of a file as one robot's motion. Plug-ins go on in their processes. Error: it is no
/// network, or none for this robot.
Expected<CoursePointer> withSwappedModel(const Course& course, std::size_t robot, const std::string& file);

/// What the network's name is in the names of branches: the file's, without its folder.
std::string modelName(const std::string& file);

}  // namespace mrose::gui
