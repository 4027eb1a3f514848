#include "io/caught.h"

#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

namespace mrose {
namespace {

template <class Thrown>
std::string causeOf(const Thrown& thrown) {
    const Expected<void> outcome = caught([&]() -> void { throw thrown; });
    return outcome ? "" : outcome.error().message();
}

TEST(Caught, WhatIsReturnedComesThrough) {
    int calls = 0;
    EXPECT_TRUE(caught([&] { ++calls; }));
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(caught([] { return 7; }).value(), 7);
    const Expected<int> seven = caught([] { return Expected<int>(7); });
    EXPECT_EQ(seven.value(), 7);
    EXPECT_EQ(caught([]() -> Expected<int> { return fail("f", "is none"); }).error().message(), "f: is none");
}

TEST(Caught, WhatIsThrownIsAnErrorOfOneLine) {
    EXPECT_EQ(causeOf(std::length_error("vector::_M_default_append")), "failed: vector::_M_default_append");
    EXPECT_EQ(causeOf(std::runtime_error("two\nlines")), "failed: two?lines");
    EXPECT_EQ(causeOf(std::bad_alloc()), "needs more memory than this computer has");
    EXPECT_EQ(causeOf(7), "failed for an unknown reason");
}

}  // namespace
}  // namespace mrose
