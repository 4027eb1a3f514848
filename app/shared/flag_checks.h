#pragma once

#include <CLI/CLI.hpp>

namespace mrose {

/// Accepts numbers from `least` to `most`; CLI::Range has no objection to "nan".
CLI::Validator numberRange(double least, double most);

/// Accepts what is not empty.
CLI::Validator someName();

/// Accepts seeds: whole numbers of 64 bits. CLI11 itself takes what is too large for the largest there is.
CLI::Validator someSeed();

/// Accepts numbers of trials: whole ones from 0 on.
CLI::Validator someTrial();

}  // namespace mrose
