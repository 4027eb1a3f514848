#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/error.h"

namespace mrose {

/// What is wrong: the file, and what else its line says.
template <class Result>
void expectError(const Expected<Result>& result, const std::string& file, const std::vector<std::string>& parts = {}) {
    ASSERT_FALSE(result) << "expected an error of " << file;
    EXPECT_EQ(result.error().file, file);
    const std::string message = result.error().message();
    for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message << '\n' << part;
}

}  // namespace mrose
