#pragma once

#include <cstdint>
#include <string_view>

namespace mrose {

/// CRC-32 of ISO 3309 (zip, png), as MCAP wants it. `before` is the CRC of what lies before the bytes.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

}  // namespace mrose
