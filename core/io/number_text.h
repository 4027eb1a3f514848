#pragma once

#include <string>

namespace mrose {

/// The shortest decimal text that reads back as the same number, without exponent from 0.001 on to below 1e15; always
/// with '.', exponent, "inf" or "nan", so that it is a float wherever integers and floats differ. Independent of the
/// locale.
std::string numberText(double value);
std::string numberText(float value);

}  // namespace mrose
