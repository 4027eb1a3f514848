#pragma once

#include <string>

namespace mrose {

/// The shortest decimal text that reads back as the same number; always with '.', exponent, "inf" or "nan", so that it
/// is a float wherever integers and floats differ. Independent of the locale.
std::string numberText(double value);
std::string numberText(float value);

}  // namespace mrose
