#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mrose {

/// Bytes as letters (RFC 4648), in lines of at most `width`.
std::string base64(std::string_view bytes, std::size_t width = 100);
/// And back, whatever the lines; nullopt where the text is none.
std::optional<std::string> fromBase64(std::string_view text);

}  // namespace mrose
