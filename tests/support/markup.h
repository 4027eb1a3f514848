#pragma once

#include <string>

namespace mrose {

/// What is wrong with the nesting of tags, with attributes and with the escaping of text; nothing if all is well. A
/// page is written so that it is XML but for its first line.
std::string markupError(const std::string& text);

std::size_t countOf(const std::string& text, const std::string& what);

}  // namespace mrose
