#include "io/format.h"

#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <locale>
#include <random>

#include <gtest/gtest.h>

namespace mrose {
namespace {

/// Random bits are numbers of every size.
template <class Float, class Bits>
Float arbitrary(std::mt19937_64& random) {
    for (;;) {
        const auto value = std::bit_cast<Float>(static_cast<Bits>(random()));
        if (std::isfinite(value)) return value;
    }
}

bool looksLikeAFloat(const std::string& text) {
    return text.find_first_not_of("-+.e0123456789") == std::string::npos && text.find_first_of(".e") != text.npos;
}

TEST(NumberText, ReadsBackAsTheSameBits) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 100'000; ++i) {
        const auto d = arbitrary<double, std::uint64_t>(random);
        const auto f = arbitrary<float, std::uint32_t>(random);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(std::strtod(numberText(d).c_str(), nullptr)),
                  std::bit_cast<std::uint64_t>(d));
        ASSERT_EQ(std::bit_cast<std::uint32_t>(std::strtof(numberText(f).c_str(), nullptr)),
                  std::bit_cast<std::uint32_t>(f));
        ASSERT_TRUE(looksLikeAFloat(numberText(d)) && looksLikeAFloat(numberText(f))) << numberText(d);
    }
}

TEST(NumberText, IsShortAndAlwaysAFloat) {
    EXPECT_EQ(numberText(0.1), "0.1");
    EXPECT_EQ(numberText(0.1f), "0.1");
    EXPECT_EQ(numberText(3.0), "3.0");
    EXPECT_EQ(numberText(-0.0), "-0.0");
    EXPECT_EQ(numberText(100000.0), "100000.0");
    EXPECT_EQ(numberText(-1e7f), "-10000000.0");
    EXPECT_EQ(numberText(123456789012345.0), "123456789012345.0");
    EXPECT_EQ(numberText(0.001), "0.001");
    EXPECT_EQ(numberText(1e-4), "1e-04");
    EXPECT_EQ(numberText(1e15), "1e+15");
    EXPECT_EQ(numberText(1e300), "1e+300");
    EXPECT_EQ(numberText(5e-324), "5e-324");
    EXPECT_EQ(numberText(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(numberText(-std::numeric_limits<double>::infinity()), "-inf");
    EXPECT_EQ(numberText(std::numeric_limits<double>::quiet_NaN()), "nan");
}

class DecimalComma : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

/// Both kinds of locale; few machines have one of C's that writes a comma.
TEST(NumberText, DoesNotDependOnTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    const std::locale old = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) std::setlocale(LC_NUMERIC, name);
    const std::string text = numberText(0.5);
    std::locale::global(old);
    std::setlocale(LC_ALL, before.c_str());
    EXPECT_EQ(text, "0.5");
}

}  // namespace
}  // namespace mrose
