#include "logs/decimal.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace mrose {
namespace {

/// The value if the whole text is a number.
std::optional<double> number(const std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    return parseNumber(text.data(), end, value) == end ? std::optional(value) : std::nullopt;
}

std::optional<Nanoseconds> instant(const std::string& text) {
    Nanoseconds time = 0;
    const char* const end = text.data() + text.size();
    return parseInstant(text.data(), end, time) == end ? std::optional(time) : std::nullopt;
}

void expectAsStrtod(const std::string& text) {
    const auto value = number(text);
    ASSERT_TRUE(value.has_value()) << text;
    EXPECT_EQ(*value, std::strtod(text.c_str(), nullptr)) << text;
    EXPECT_EQ(std::signbit(*value), std::signbit(std::strtod(text.c_str(), nullptr))) << text;
}

TEST(Decimal, NumbersAreTheNearestDoubles) {
    for (const char* text : {"0",
                             "-0",
                             "1",
                             ".5",
                             "5.",
                             "-0.3e-2",
                             "+1.0",
                             "1e22",
                             "1e23",
                             "-3.89107760",
                             "9007199254740993",
                             "9007199254740992",
                             "123456789012345678901234567890",
                             "0.1234567890123456789012345",
                             "0.000000000000000000000001",
                             "1.7976931348623157e308",
                             "2.2250738585072014e-308",
                             "00000000000000000000000000001.5",
                             "1E+2",
                             "8.5e-1"})
        expectAsStrtod(text);
}

TEST(Decimal, RandomNumbersOfEveryLengthAreTheNearestDoubles) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 200'000; ++i) {
        std::string text = random() % 2 == 0 ? "-" : "";
        const std::size_t before = random() % 12, behind = random() % 14 + (before == 0);
        for (std::size_t k = 0; k < before; ++k) text += static_cast<char>('0' + random() % 10);
        if (behind > 0) text += '.';
        for (std::size_t k = 0; k < behind; ++k) text += static_cast<char>('0' + random() % 10);
        if (random() % 8 == 0) text += "e" + std::to_string(static_cast<int>(random() % 61) - 30);
        expectAsStrtod(text);
    }
}

TEST(Decimal, NumbersEndWhereTheyEnd) {
    const std::string text = "1.5,2";
    double value = 0;
    EXPECT_EQ(parseNumber(text.data(), text.data() + text.size(), value), text.data() + 3);
    EXPECT_EQ(value, 1.5);
}

TEST(Decimal, WhatIsNoFiniteNumberIsRejected) {
    for (const char* text :
         {"", "-", "+", ".", "e5", "1e", "1e+", "nan", "inf", "-inf", "x", "+-1", "--1", "1e400", " 1"}) {
        EXPECT_EQ(number(text), std::nullopt) << text;
        EXPECT_EQ(instant(text), std::nullopt) << text;
    }
    EXPECT_EQ(number("0x10"), std::nullopt);
}

TEST(Decimal, InstantsAreExactToTheNanosecond) {
    EXPECT_EQ(instant("1248444187.156"), 1'248'444'187'156'000'000);
    EXPECT_EQ(instant("1248444187.156000001"), 1'248'444'187'156'000'001);
    EXPECT_EQ(instant("-.000000001"), -1);
    EXPECT_EQ(instant("1.248444187156e9"), 1'248'444'187'156'000'000);
    EXPECT_EQ(instant("2500e-3"), 2'500'000'000);
    EXPECT_EQ(instant("0e99999"), 0);
}

TEST(Decimal, InstantsAreRoundedToTheNearestNanosecondHalvesAwayFromZero) {
    EXPECT_EQ(instant("0.0000000004999"), 0);
    EXPECT_EQ(instant("0.0000000005"), 1);
    EXPECT_EQ(instant("-0.0000000005"), -1);
    EXPECT_EQ(instant("1.9999999996"), 2'000'000'000);
    EXPECT_EQ(instant("1248444187.1560000004999999"), 1'248'444'187'156'000'000);
    EXPECT_EQ(instant("1248444187.1560000005"), 1'248'444'187'156'000'001);
    EXPECT_EQ(instant("5e-10"), 1);
    EXPECT_EQ(instant("5e-11"), 0);
}

TEST(Decimal, RandomMillisecondsSurvive) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 100'000; ++i) {
        const std::int64_t milliseconds = static_cast<std::int64_t>(random() % 4'000'000'000'000);
        char text[32];
        std::snprintf(text, sizeof text, "%lld.%03lld", static_cast<long long>(milliseconds / 1000),
                      static_cast<long long>(milliseconds % 1000));
        EXPECT_EQ(instant(text), milliseconds * 1'000'000) << text;
    }
}

TEST(Decimal, InstantsBeyondTheClockAreRejected) {
    EXPECT_EQ(instant("4000000000"), latestSecond * nanosecondsPerSecond);
    for (const char* text : {"4000000000.000000001", "-4000000001", "1e10", "99999999999999999999", "1e99999"})
        EXPECT_EQ(instant(text), std::nullopt) << text;
}

}  // namespace
}  // namespace mrose
