#include "io/toml_table.h"

#include <functional>

#include <gtest/gtest.h>

namespace mrose {
namespace {

using Read = std::function<void(TomlTable&)>;

/// The first error that reading `text` gives, "" for none.
std::string errorOf(std::string_view text, const Read& read) {
    TomlTable table(text, "f");
    read(table);
    return table.failed() ? table.error().message() : "";
}

TEST(TomlTable, GivesWhatTheFileHolds) {
    TomlTable table(R"(
n = 1.5
whole = 3
i = -7
b = true
s = "text"
c = "two"
list = ["a", "b"]
row = [1, 2.5]
m = [[1, 2, 3], [4, 5, 6]]
t = { inner = 4.0 }
[[e]]
x = 1
[[e]]
x = 2
)",
                    "f");
    EXPECT_EQ(table.number("n"), 1.5);
    EXPECT_EQ(table.number("whole", {3, 3}), 3);
    EXPECT_EQ(table.integer("i", -7, -7), -7);
    EXPECT_TRUE(table.boolean("b"));
    EXPECT_EQ(table.string("s"), "text");
    EXPECT_EQ(table.choice("c", {"one", "two"}), 1u);
    EXPECT_EQ(table.strings("list"), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(table.numbers("row", 2), (std::vector<double>{1, 2.5}));
    EXPECT_EQ(table.matrix("m", 2, 3), (std::vector<double>{1, 2, 3, 4, 5, 6}));
    TomlTable inner = table.table("t");
    EXPECT_EQ(inner.number("inner"), 4);
    inner.rejectUnknown();
    std::vector<TomlTable> elements = table.tables("e");
    ASSERT_EQ(elements.size(), 2u);
    EXPECT_EQ(elements[1].integer("x", 0, 9), 2);
    table.rejectUnknown();
    EXPECT_FALSE(table.failed());
    EXPECT_TRUE(table.has("n") && !table.has("absent"));
}

TEST(TomlTable, EveryErrorSaysLineColumnKeyAndWhatWasExpected) {
    const std::pair<const char*, Read> numbers[] = {
        {"f:2:5: k: expected a finite number", [](TomlTable& t) { t.number("k"); }},
        {"f:2:5: k: expected a whole number from 1 to 9", [](TomlTable& t) { t.integer("k", 1, 9); }},
        {"f:2:5: k: expected true or false", [](TomlTable& t) { t.boolean("k"); }},
        {"f:2:5: k: is \"text\"; expected one of \"one\", \"two\"",
         [](TomlTable& t) {
             t.choice("k", {"one", "two"});
         }},
        {"f:2:5: k: expected an array of texts", [](TomlTable& t) { t.strings("k"); }},
        {"f:2:5: k: expected an array of numbers", [](TomlTable& t) { t.numbers("k", 1); }},
        {"f:2:5: k: expected 2 arrays of numbers", [](TomlTable& t) { t.matrix("k", 2, 2); }},
        {"f:2:5: k: expected a table", [](TomlTable& t) { t.table("k"); }},
        {"f:2:5: k: expected an array of tables", [](TomlTable& t) { t.tables("k"); }},
        {"f:2:5: k: is not a known key", [](TomlTable& t) { t.rejectUnknown(); }},
        {"f:2:5: k: because", [](TomlTable& t) { t.reject("k", "because"); }},
    };
    for (const auto& [message, read] : numbers) EXPECT_EQ(errorOf("# a\nk = \"text\"\n", read), message);
}

TEST(TomlTable, ElementsOfTheWrongKindAreFoundWhereTheyStand) {
    EXPECT_EQ(errorOf("k = 1", [](TomlTable& t) { t.string("k"); }), "f:1:5: k: expected a text in quotes");
    EXPECT_EQ(errorOf("k = [\"a\",\n 1]", [](TomlTable& t) { t.strings("k"); }), "f:2:2: k: expected a text in quotes");
    EXPECT_EQ(errorOf("k = [1,\n  true]", [](TomlTable& t) { t.numbers("k", 2); }),
              "f:2:3: k: expected a finite number");
    EXPECT_EQ(errorOf("k = [1, 2]", [](TomlTable& t) { t.numbers("k", 3); }), "f:1:5: k: has 2 numbers; expected 3");
    EXPECT_EQ(errorOf("k = [[1, 2],\n [1]]", [](TomlTable& t) { t.matrix("k", 2, 2); }),
              "f:2:2: k: has 1 number; expected 2");
    EXPECT_EQ(errorOf("k = [[1, 2],\n 5]", [](TomlTable& t) { t.matrix("k", 2, 2); }),
              "f:2:2: k: expected an array of numbers");
    EXPECT_EQ(errorOf("k = [{},\n 5]", [](TomlTable& t) { t.tables("k"); }), "f:2:2: k[2]: expected a table");
    EXPECT_EQ(errorOf("k = nan", [](TomlTable& t) { t.number("k"); }), "f:1:5: k: expected a finite number");
    EXPECT_EQ(errorOf("k = 2.5", [](TomlTable& t) { t.integer("k", 0, 9); }),
              "f:1:5: k: expected a whole number from 0 to 9");
    TomlTable computed("k = 3.0", "f");
    EXPECT_EQ(computed.integer("k", 0, 9), 3) << "a whole number all the same";
    EXPECT_FALSE(computed.failed());
    for (const char* const no : {"k = 1e300", "k = inf", "k = nan", "k = 12.0"})
        EXPECT_EQ(errorOf(no, [](TomlTable& t) { t.integer("k", 0, 9); }),
                  "f:1:5: k: expected a whole number from 0 to 9");
    EXPECT_EQ(errorOf("k = 12", [](TomlTable& t) { t.integer("k", 0, 9); }),
              "f:1:5: k: expected a whole number from 0 to 9");
    EXPECT_EQ(errorOf("k = -1", [](TomlTable& t) { t.number("k", {0, 2}); }), "f:1:5: k: is -1.0; expected 0.0 to 2.0");
}

TEST(TomlTable, RowsAreAsManyAsThereAre) {
    TomlTable table("k = [[1, 2], [3, 4.5], [-1, 0]]", "f");
    EXPECT_EQ(table.rows("k", 2, 1, 3), (std::vector<double>{1, 2, 3, 4.5, -1, 0}));
    EXPECT_FALSE(table.failed());
    const auto refused = [](std::string_view text, NumberRange range = {}) {
        return errorOf(text, [&](TomlTable& t) { EXPECT_TRUE(t.rows("k", 2, 2, 3, range).empty()); });
    };
    EXPECT_EQ(refused("k = [[1, 2]]"), "f:1:5: k: has 1 elements; expected 2 to 3 arrays of 2 numbers");
    EXPECT_EQ(refused("k = 1"), "f:1:5: k: expected 2 to 3 arrays of 2 numbers");
    EXPECT_EQ(refused("k = [[1, 2],\n [1]]"), "f:2:2: k: has 1 number; expected 2");
    EXPECT_EQ(refused("k = [[1, 2],\n 1]"), "f:2:2: k: expected an array of numbers");
    EXPECT_EQ(refused("k = [[1, 2], [3,\n 9]]", {0, 5}), "f:2:2: k: is 9.0; expected 0.0 to 5.0");
    EXPECT_EQ(refused(""), "f:1:1: k: is missing");
}

TEST(TomlTable, KeysThatMayBeMissingHaveAValueAllTheSame) {
    TomlTable table("i = 5\nb = true\ns = \"text\"\n[t]\nx = 1\n[[e]]\n", "f");
    EXPECT_EQ(table.numberOr("i", 1), 5);
    EXPECT_EQ(table.numberOr("none", 1), 1);
    EXPECT_EQ(table.integerOr("i", 1, 0, 9), 5);
    EXPECT_EQ(table.integerOr("none", 1, 0, 9), 1);
    EXPECT_TRUE(table.booleanOr("b", false));
    EXPECT_TRUE(table.booleanOr("none", true));
    EXPECT_EQ(table.stringOr("s", "else"), "text");
    EXPECT_EQ(table.stringOr("none", "else"), "else");
    EXPECT_EQ(table.tableOrEmpty("t").number("x"), 1);
    EXPECT_EQ(table.tableOrEmpty("none").numberOr("x", 3), 3);
    EXPECT_EQ(table.tablesOrNone("e").size(), 1u);
    EXPECT_TRUE(table.tablesOrNone("none").empty());
    table.rejectUnknown();
    EXPECT_FALSE(table.failed());
    // What is there must fit all the same.
    EXPECT_EQ(errorOf("k = 12", [](TomlTable& t) { t.integerOr("k", 0, 0, 9); }),
              "f:1:5: k: expected a whole number from 0 to 9");
    EXPECT_EQ(errorOf("k = 1", [](TomlTable& t) { t.booleanOr("k", true); }), "f:1:5: k: expected true or false");
    EXPECT_EQ(errorOf("k = 1", [](TomlTable& t) { t.stringOr("k", ""); }), "f:1:5: k: expected a text in quotes");
    EXPECT_EQ(errorOf("k = 1", [](TomlTable& t) { t.tableOrEmpty("k"); }), "f:1:5: k: expected a table");
    EXPECT_EQ(errorOf("k = 1", [](TomlTable& t) { t.tablesOrNone("k"); }), "f:1:5: k: expected an array of tables");
}

TEST(TomlTable, ElementsAndOtherFilesCanBeRejected) {
    EXPECT_EQ(errorOf("k = [1,\n 2]", [](TomlTable& t) { t.rejectElement("k", 1, "because"); }),
              "f:2:2: k[2]: because");
    EXPECT_EQ(errorOf("k = 1", [](TomlTable& t) { t.rejectElement("k", 1, "because"); }), "f:1:5: k[2]: because");
    EXPECT_EQ(errorOf("k = 1",
                      [](TomlTable& t) {
                          t.adopt({"other", 3, 4, "key", "because"});
                      }),
              "other:3:4: key: because");
    EXPECT_EQ(errorOf("k = 1",
                      [](TomlTable& t) {
                          t.reject("k", "first");
                          t.adopt({"other", 3, 4, "key", "because"});
                      }),
              "f:1:5: k: first");
}

TEST(TomlTable, TextOfATableReadsBack) {
    TomlTable table("[t]\nx = 1.5\nname = \"a \\\"b\\\"\"\ninner = { y = [1, 2] }\n", "f");
    TomlTable again(table.table("t").text(), "g");
    EXPECT_EQ(again.number("x"), 1.5);
    EXPECT_EQ(again.string("name"), "a \"b\"");
    EXPECT_EQ(again.table("inner").numbers("y", 2), (std::vector<double>{1, 2}));
    EXPECT_FALSE(again.failed());
    TomlTable braces("t = { x = 1.5, inner = { y = 2.5 } }\n", "f");
    TomlTable lines(braces.table("t").text(), "g");
    EXPECT_EQ(lines.number("x"), 1.5);
    EXPECT_EQ(lines.table("inner").number("y"), 2.5);
    EXPECT_FALSE(lines.failed());
    EXPECT_EQ(table.tableOrEmpty("none").text(), "");
}

TEST(TomlTable, RangesHoldForEveryElement) {
    EXPECT_EQ(errorOf("k = [1,\n 5]",
                      [](TomlTable& t) {
                          t.numbers("k", 2, {0, 2});
                      }),
              "f:2:2: k: is 5.0; expected 0.0 to 2.0");
    EXPECT_EQ(errorOf("k = [[1, -1]]",
                      [](TomlTable& t) {
                          t.matrix("k", 1, 2, {0, 2});
                      }),
              "f:1:10: k: is -1.0; expected 0.0 to 2.0");
    EXPECT_EQ(errorOf("k = [0, 2]", [](TomlTable& t) { t.numbers("k", 2, {0, 2}); }), "");
}

TEST(TomlTable, KeysOfInnerTablesAreNamedFromTheRoot) {
    const auto inner = [](TomlTable& t) { t.table("a").table("b").number("k"); };
    EXPECT_EQ(errorOf("[a.b]\nk = true\n", inner), "f:2:5: a.b.k: expected a finite number");
    EXPECT_EQ(errorOf("[a]\n", inner), "f:1:1: a.b: is missing");
    EXPECT_EQ(errorOf("e = [{ k = 1 },\n {}]", [](TomlTable& t) { t.tables("e")[1].number("k"); }),
              "f:2:2: e[2].k: is missing");
}

TEST(TomlTable, SyntaxErrorsAreFoundOnConstruction) {
    const TomlTable table("a = 1\nb = = 2\n", "f");
    ASSERT_TRUE(table.failed());
    EXPECT_EQ(table.error().line, 2);
    EXPECT_EQ(table.error().column, 5);
    EXPECT_TRUE(table.error().cause.starts_with("is not TOML: "));
    EXPECT_EQ(table.error().message().find('\n'), std::string::npos);
}

TEST(TomlTable, TheFirstErrorStaysAndLaterReadsAreNeutral) {
    TomlTable table("a = true\nb = true\n", "f");
    EXPECT_EQ(table.number("a"), 0);
    EXPECT_EQ(table.number("b"), 0);
    EXPECT_EQ(table.integer("none", 4, 5), 4);
    EXPECT_EQ(table.numbers("none", 3), std::vector<double>(3));
    EXPECT_EQ(table.matrix("none", 2, 2), std::vector<double>(4));
    EXPECT_EQ(table.table("none").string("x"), "");
    EXPECT_EQ(table.error().message(), "f:1:5: a: expected a finite number");
}

TEST(TomlTable, AMisspeltKeyIsToldBeforeTheOneThatItWasMeantFor) {
    const auto start = [](TomlTable& t) {
        t.number("start_s");
        t.has("speed_mps");
        t.rejectUnknown();
    };
    EXPECT_EQ(errorOf("other = 1\nstrat_s = 2", start), "f:2:11: strat_s: is not a known key; did you mean start_s?");
    // not near enough for a key that a reader may still ask for
    EXPECT_EQ(errorOf("start = 1", start), "f:1:9: start: is not a known key; did you mean start_s?");
    EXPECT_EQ(errorOf("y_m = 1", [](TomlTable& t) { t.number("x_m"), t.number("y_m"), t.rejectUnknown(); }),
              "f:1:1: x_m: is missing");
    EXPECT_EQ(errorOf("start_s = 1\nspede_mps = 2", start),
              "f:2:13: spede_mps: is not a known key; did you mean speed_mps?");
    EXPECT_EQ(errorOf("start_s = 1\ncolour = 2", start),
              "f:2:10: colour: is not a known key; expected one of speed_mps, start_s");
    EXPECT_EQ(errorOf("colour = 2", start), "f:1:1: start_s: is missing");
    // what is wrong with another table stays what is told
    EXPECT_EQ(errorOf("a = { k = \"\" }\nstrat_s = 1",
                      [&](TomlTable& t) {
                          t.table("a").number("k");
                          start(t);
                      }),
              "f:1:11: a.k: expected a finite number");
}

TEST(TomlTable, ElementsAreToldByTheirNamesOrCountedFromOne) {
    const auto second = [](TomlTable& t) { t.tables("e")[1].number("k"); };
    EXPECT_EQ(errorOf("[[e]]\n[[e]]\nname = \"red 2\"", second), "f:2:1: e[\"red 2\"].k: is missing");
    EXPECT_EQ(errorOf("[[e]]\n[[e]]\nname = \"\"", second), "f:2:1: e[2].k: is missing");
    EXPECT_EQ(errorOf("[[e]]\n[[e]]\nname = 7", second), "f:2:1: e[2].k: is missing");
}

}  // namespace
}  // namespace mrose
