#include "recording/crc32.h"

#include <string>

#include <gtest/gtest.h>

#include "io/compression.h"

namespace mrose {
namespace {

/// Bit by bit, as the standard defines it.
std::uint32_t slowCrc(std::string_view bytes) {
    std::uint32_t crc = 0xffffffff;
    for (const char c : bytes)
        for (int bit = 0; bit < 8; ++bit) {
            const bool one = ((crc ^ static_cast<unsigned char>(c) >> bit) & 1) != 0;
            crc = crc >> 1 ^ (one ? 0xedb88320 : 0);
        }
    return ~crc;
}

TEST(Crc32, IsThatOfZip) {
    EXPECT_EQ(crc32("123456789"), 0xcbf43926u);  // the check value that the standard's catalogues give
    EXPECT_EQ(crc32(""), 0u);
    std::string bytes;
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(crc32(bytes), slowCrc(bytes)) << i;
        bytes += static_cast<char>(37 * i);
    }
}

TEST(Crc32, GoesOnFromWhatWasBefore) {
    const std::string bytes = "any bytes, long enough for all ways through";
    for (std::size_t cut = 0; cut <= bytes.size(); ++cut)
        EXPECT_EQ(crc32(bytes.substr(cut), crc32(bytes.substr(0, cut))), crc32(bytes));
}

TEST(Compression, ComesBackAndBoundsWhatItTakes) {
    const std::string bytes(100000, 'a');
    const std::string packed = compressed(bytes);
    EXPECT_LT(packed.size(), 100u);
    EXPECT_EQ(decompressed(packed), bytes);
    EXPECT_FALSE(decompressed(packed, 99999));
    for (std::size_t cut = 0; cut < packed.size(); ++cut) EXPECT_FALSE(decompressed(packed.substr(0, cut)));
    EXPECT_FALSE(decompressed(packed + 'x'));
    EXPECT_EQ(decompressed(compressed("")), "");
    // A frame's head that promises a gigabyte, and nothing behind it.
    EXPECT_FALSE(decompressed(std::string("\x28\xb5\x2f\xfd\xa0\0\0\0\x40", 9)));
}

}  // namespace
}  // namespace mrose
