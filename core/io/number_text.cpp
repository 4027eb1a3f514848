#include "io/number_text.h"

#include <charconv>

namespace mrose {
namespace {

constexpr double leastPlain = 1e-3, mostPlain = 1e15;

template <class Float>
std::string shortest(Float value) {
    char text[40];
    const Float size = value < 0 ? -value : value;
    // to_chars itself prefers 1e+05 where that is the shorter text.
    const bool plain = size >= Float(leastPlain) && size < Float(mostPlain);
    const auto end = plain ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr
                           : std::to_chars(text, text + sizeof text, value).ptr;
    std::string result(text, end);
    if (result.find_first_of(".en") == std::string::npos) result += ".0";
    return result;
}

}  // namespace

std::string numberText(double value) { return shortest(value); }
std::string numberText(float value) { return shortest(value); }

}  // namespace mrose
