#include "io/number_text.h"

#include <charconv>

namespace mrose {
namespace {

template <class Float>
std::string shortest(Float value) {
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    std::string result(text, end);
    if (result.find_first_of(".en") == std::string::npos) result += ".0";
    return result;
}

}  // namespace

std::string numberText(double value) { return shortest(value); }
std::string numberText(float value) { return shortest(value); }

}  // namespace mrose
