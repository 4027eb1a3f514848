#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mrose {

/// Zstandard, one frame. The level says how much time is given for how little space.
enum class Compression { quick = 3, thorough = 6 };
std::string compressed(std::string_view bytes, Compression level);

/// The content of one whole frame; nothing where it is none, or holds more than `most` bytes. No more memory is taken
/// than the frame may fill, whatever it says of itself.
std::optional<std::string> decompressed(std::string_view bytes, std::size_t most = std::size_t{1} << 30);

}  // namespace mrose
