#include "io/bytes.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(Bytes, NumbersAreLittleEndian) {
    std::string bytes;
    appendNumber(bytes, std::uint32_t{0x01020304});
    appendNumber(bytes, std::int16_t{-2});
    EXPECT_EQ(bytes, std::string("\4\3\2\1\xfe\xff"));
    ByteReader reader(bytes);
    EXPECT_EQ(reader.number<std::uint32_t>(), 0x01020304u);
    EXPECT_EQ(reader.number<std::int16_t>(), -2);
    EXPECT_TRUE(reader.done());
}

TEST(Bytes, NothingIsReadBeyondTheEnd) {
    ByteReader reader("abcde");
    EXPECT_EQ(reader.take(2), "ab");
    EXPECT_EQ(reader.number<std::uint64_t>(), 0u);
    EXPECT_TRUE(reader.failed());
    EXPECT_EQ(reader.take(1), "");
    EXPECT_FALSE(reader.done());
    ByteReader huge("abc");
    EXPECT_EQ(huge.take(~std::uint64_t{0}), "");
    EXPECT_TRUE(huge.failed());
    ByteReader empty("");
    EXPECT_EQ(empty.take(0), "");
    EXPECT_TRUE(empty.done());
}

}  // namespace
}  // namespace mrose
