#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mrose {

/// Zstandard, one frame, at its quickest level: a thorough one takes four times as long for a tenth less.
std::string compressed(std::string_view bytes);

/// The content of one whole frame; nullopt where it is none, or holds more than `most` bytes. No more memory is taken
/// than the frame may fill, whatever it says of itself.
std::optional<std::string> decompressed(std::string_view bytes, std::size_t most = std::size_t{1} << 30);

}  // namespace mrose
