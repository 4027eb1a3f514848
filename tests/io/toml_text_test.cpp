#include "io/toml_text.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "io/file.h"
#include "support/places.h"

namespace mrose {
namespace {

TEST(TomlText, ReadsLikeAFileOfOurs) {
    const auto value = parseToml(
        "seed = 3\nformat = \"f\"\nversion = 1\n[floor]\nb = 1.0\na = true\n[[robot]]\nname = \"x\"\nstart = { y_m = "
        "2.5, x_m = 1.0 }\n"
        "[[robot]]\nname = \"y\"\n[robot.controller]\nkind = \"k\"\n[[robot.controller.targets]]\nx_m = 1.0\n",
        "f");
    ASSERT_TRUE(value);
    EXPECT_EQ(
        tomlText(*value, "Two\nlines"),
        "# Two\n# lines\nformat = \"f\"\nversion = 1\nseed = 3\n\n[floor]\na = true\nb = 1.0\n\n[[robot]]\nname = "
        "\"x\"\nstart = { x_m = 1.0, y_m = 2.5 }\n\n[[robot]]\nname = \"y\"\n\n[robot.controller]\nkind = \"k\"\n\n"
        "[[robot.controller.targets]]\nx_m = 1.0\n");
}

/// All that ships comes back as it was, to the bit.
TEST(TomlText, OfEveryShippedDescriptionGivesItAgain) {
    int files = 0;
    for (const char* const folder : {"resources", "shapes", "nets"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder() / folder)) {
            if (entry.path().extension() != ".toml" && entry.path().extension() != ".net") continue;
            const auto value = parseToml(*readFile(entry.path()), entry.path().string());
            ASSERT_TRUE(value) << value.error().message();
            const auto again = parseToml(tomlText(*value), "again");
            ASSERT_TRUE(again) << entry.path() << again.error().message() << tomlText(*value);
            EXPECT_EQ(*again, *value) << entry.path();
            ++files;
        }
    EXPECT_GT(files, 20);
}

TEST(TomlText, OddTextsKeysAndNumbers) {
    const Value odd = Value::Table{{"a b", 1},
                                   {"", "\"\\\n\x7f"},
                                   {"n", Value::Array{-0.0, 1e300, 5e-324, std::int64_t{1} << 62}},
                                   {"e", Value::Array{}},
                                   {"t", Value::Table{}},
                                   {"f", std::make_shared<const DescriptionFile>(DescriptionFile{"x", "named", 1})}};
    const auto again = parseToml(tomlText(odd), "f");
    ASSERT_TRUE(again) << again.error().message() << tomlText(odd);
    EXPECT_EQ(*again, *odd.with("f", "named"));
    EXPECT_EQ(tomlString("a\"b\\c\n\x7f"), "\"a\\\"b\\\\c\\u000A\\u007F\"");
}

TEST(TomlText, WhatIsNoTomlIsSaidWithItsPlace) {
    const auto wrong = parseToml("a = 1\nb = \n", "f.toml");
    ASSERT_FALSE(wrong);
    EXPECT_TRUE(wrong.error().message().starts_with("f.toml:2:5: is not TOML: ")) << wrong.error().message();
    const auto placed = parseToml("a = 1\n  b = 2", "f");
    EXPECT_EQ(placed->find("b")->line, 2u);
    EXPECT_EQ(placed->find("b")->column, 7u);
}

}  // namespace
}  // namespace mrose
