#pragma once

#include <string>
#include <string_view>

#include "geometry/shape.h"
#include "io/error.h"
#include "io/value.h"

namespace mrose {

/// A shape file's text (shapes/README.md explains the keys) as a shape about its reference point. Error: file, line,
/// column and key of the first thing wrong.
Expected<Shape> parseShape(std::string_view text, const std::string& file);
/// The same of its content as it was parsed before.
Expected<Shape> readShape(const Value& content, const std::string& file);

}  // namespace mrose
