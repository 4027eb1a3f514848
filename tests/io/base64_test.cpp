#include "io/base64.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

// The test vectors of RFC 4648, section 10.
TEST(Base64, IsThatOfTheStandard) {
    for (const auto& [bytes, text] : {std::pair("", ""),
                                      {"f", "Zg=="},
                                      {"fo", "Zm8="},
                                      {"foo", "Zm9v"},
                                      {"foob", "Zm9vYg=="},
                                      {"fooba", "Zm9vYmE="},
                                      {"foobar", "Zm9vYmFy"}}) {
        EXPECT_EQ(base64(bytes), text);
        EXPECT_EQ(fromBase64(text), bytes);
    }
}

TEST(Base64, ComesBackThroughLines) {
    std::string bytes;
    for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i * 7);
    const std::string text = base64(bytes, 20);
    EXPECT_EQ(text.find('\n'), 20u);
    EXPECT_EQ(fromBase64(text), bytes);
    EXPECT_EQ(fromBase64("Zm9v\r\n YmFy\n"), "foobar");
}

TEST(Base64, WhatIsNoneIsRefused) {
    for (const char* const text : {"Zg=", "Z", "Zg==Zg==", "Z===", "====", "Zm9_", "Zg=v"})
        EXPECT_FALSE(fromBase64(text)) << text;
}

}  // namespace
}  // namespace mrose
