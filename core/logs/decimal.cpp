#include "logs/decimal.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace mrose {
namespace {

constexpr int mostDigits = 19;  // as many as a uint64 always holds
constexpr std::int64_t farExponent = 100'000;

constexpr std::array<double, 23> powersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                                1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// sign * (digits + the rest of them) * 10^exponent.
struct Decimal {
    bool negative = false;
    std::uint64_t digits = 0;
    int digitCount = 0;         // of `digits`, without leading zeros
    int nextDigit = 0;          // the first one left out
    std::int64_t exponent = 0;  // of ten
};

bool isDigit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

void takeDigit(Decimal& number, int digit, bool fraction) {
    if (number.digitCount < mostDigits) {
        number.digits = number.digits * 10 + static_cast<std::uint64_t>(digit);
        number.digitCount += number.digits != 0;
        number.exponent -= fraction;
        return;
    }
    if (number.digitCount++ == mostDigits) number.nextDigit = digit;
    number.exponent += !fraction;
}

const char* takeExponent(const char* at, const char* end, Decimal& number) {
    const char* digit = at + 1;
    const bool negative = digit < end && *digit == '-';
    if (digit < end && (*digit == '-' || *digit == '+')) ++digit;
    if (digit == end || !isDigit(*digit)) return nullptr;
    std::int64_t exponent = 0;
    for (; digit < end && isDigit(*digit); ++digit)
        if (exponent < farExponent) exponent = exponent * 10 + (*digit - '0');
    number.exponent += negative ? -exponent : exponent;
    return digit;
}

const char* scan(const char* at, const char* end, Decimal& number) {
    number.negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) ++at;
    const char* const first = at;
    for (; at < end && isDigit(*at); ++at) takeDigit(number, *at - '0', false);
    std::ptrdiff_t count = at - first;
    if (at < end && *at == '.') {
        const char* const fraction = ++at;
        for (; at < end && isDigit(*at); ++at) takeDigit(number, *at - '0', true);
        count += at - fraction;
    }
    if (count == 0) return nullptr;
    return at < end && (*at == 'e' || *at == 'E') ? takeExponent(at, end, number) : at;
}

/// Digits and a power of ten that are both exact doubles: their quotient or product is rounded once. Where digits were
/// left out those that were kept exceed 2^53.
bool fromExactParts(const Decimal& number, double& value) {
    if (number.digits > (1ULL << 53) || number.exponent < -22 || number.exponent > 22) return false;
    const auto digits = static_cast<double>(number.digits);
    value = number.exponent < 0 ? digits / powersOfTen[static_cast<std::size_t>(-number.exponent)]
                                : digits * powersOfTen[static_cast<std::size_t>(number.exponent)];
    if (number.negative) value = -value;
    return true;
}

/// False where the magnitude does not fit an instant.
bool toMagnitude(const Decimal& number, std::uint64_t& nanoseconds) {
    constexpr auto limit = static_cast<std::uint64_t>(latestSecond) * nanosecondsPerSecond;
    std::int64_t exponent = number.exponent + 9;
    nanoseconds = number.digits;
    if (nanoseconds == 0) return true;
    int lastDropped = exponent == 0 ? number.nextDigit : 0;
    for (; exponent < 0; ++exponent) {
        lastDropped = static_cast<int>(nanoseconds % 10);
        nanoseconds /= 10;
        if (nanoseconds == 0 && exponent < -1) return true;
    }
    nanoseconds += lastDropped >= 5;
    for (; exponent > 0 && nanoseconds <= limit; --exponent) {
        if (nanoseconds > limit / 10) return false;
        nanoseconds *= 10;
    }
    return nanoseconds <= limit;
}

}  // namespace

const char* parseNumber(const char* begin, const char* end, double& value) {
    Decimal number;
    const char* const behind = scan(begin, end, number);
    if (behind == nullptr || fromExactParts(number, value)) return behind;
    if (*begin == '+') ++begin;
    return std::from_chars(begin, behind, value).ec == std::errc{} ? behind : nullptr;
}

const char* parseInstant(const char* begin, const char* end, Nanoseconds& time) {
    Decimal number;
    const char* const behind = scan(begin, end, number);
    std::uint64_t magnitude = 0;
    if (behind == nullptr || !toMagnitude(number, magnitude)) return nullptr;
    time = number.negative ? -static_cast<Nanoseconds>(magnitude) : static_cast<Nanoseconds>(magnitude);
    return behind;
}

}  // namespace mrose
