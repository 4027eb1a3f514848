#include "world/memory.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(EntryName, IsItsPartsOneAfterTheOther) {
    const std::string number = "12";
    const EntryName name("object ", number, " x");
    EXPECT_EQ(name.text(), "object 12 x");
    EXPECT_TRUE(name.is("object 12 x"));
    for (const char* const other : {"object 12", "object 12 xx", "object 1 x", "Object 12 x", ""})
        EXPECT_FALSE(name.is(other)) << other;
    EXPECT_TRUE(EntryName("").is(""));
}

TEST(MemoryEntries, TakeTheWantedOneAlone) {
    const auto fill = [](MemoryEntries& entries) {
        entries.add("state", "waiting");
        entries.add(EntryName("cost of ", "a"), 2.5, "s");
        entries.add("cost of a", 7);  // a name that is there twice
        entries.add(MemoryEntry{"count", 3});
    };
    MemoryEntries all;
    EXPECT_TRUE(all.wants("anything"));
    fill(all);
    ASSERT_EQ(all.all().size(), 4u);
    EXPECT_EQ(all.all()[0].text, "waiting");
    EXPECT_EQ(all.all()[1].name, "cost of a");
    EXPECT_EQ(all.all()[1].unit, "s");
    for (const MemoryEntry& expected : all.all()) {
        MemoryEntries one(expected.name);
        EXPECT_TRUE(one.wants(expected.name));
        fill(one);
        ASSERT_EQ(one.all().size(), 1u) << expected.name;
        EXPECT_FALSE(one.wants(expected.name)) << "it is there already";
        EXPECT_EQ(one.all()[0].value, expected.name == "cost of a" ? 2.5 : expected.value) << "the first counts";
        EXPECT_EQ(one.all()[0].text, expected.text);
    }
    MemoryEntries none("goal");
    fill(none);
    EXPECT_TRUE(none.all().empty());
}

}  // namespace
}  // namespace mrose
