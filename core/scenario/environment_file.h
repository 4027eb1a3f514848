#pragma once

#include <string>
#include <string_view>

#include "io/error.h"
#include "io/value.h"
#include "scene/environment.h"

namespace mrose {

/// An environment file's text (resources/README.md explains the keys). Walls become obstacles of one part for each of
/// their segments, mitred where they bend. Error: file, line, column and key of the first thing wrong.
Expected<Environment> parseEnvironment(std::string_view text, const std::string& file);
/// The same of its content as it was parsed before.
Expected<Environment> readEnvironment(const Value& content, const std::string& file);

}  // namespace mrose
