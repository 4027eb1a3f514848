#include "io/value.h"

#include <gtest/gtest.h>

#include "io/bytes.h"
#include "io/toml_text.h"
#include "io/value_bytes.h"

namespace mrose {
namespace {

Value::File file(const std::string& name, Value content) {
    return std::make_shared<const DescriptionFile>(DescriptionFile{name, name, std::move(content)});
}

/// A scenario of two robots of one kind, whose file names another one.
Value game() {
    const Value::File shape = file("disc.toml", Value::Table{{"radius_m", 0.2}});
    const Value::File type = file("robot.toml", Value::Table{{"mass_kg", 10.0}, {"shape", shape}});
    const auto robot = [&](const char* name) {
        return Value::Table{{"name", name}, {"type", type}, {"start", Value::Table{{"x_m", 1.0}}}};
    };
    return Value::Table{{"seed", 7}, {"kick_off", true}, {"robot", Value::Array{robot("a"), robot("keeper")}}};
}

TEST(Value, PathsLeadIntoTablesArraysAndFiles) {
    const Value value = game();
    ASSERT_TRUE(value.at("robot[2].start.x_m"));
    EXPECT_EQ(*value.at("robot[2].start.x_m")->asFloat(), 1.0);
    EXPECT_EQ(value.at("robot[\"keeper\"].name"), value.at("robot[2].name"));
    EXPECT_EQ(*value.at("robot[1].type.shape.radius_m")->asFloat(), 0.2);
    for (const char* const none :
         {"", ".", "robot[0]", "robot[3]", "robot[x]", "robot[1", "robot[\"b\"]", "seed.x", "robot.name", "[1]",
          "robot[1]name", "robot[99999999999999999999]", "seed ", "start..x_m"})
        EXPECT_EQ(value.at(none), nullptr) << none;
}

TEST(Value, ChangeLeavesTheOriginalAndAllElse) {
    const Value value = game();
    const auto changed = value.with("robot[\"keeper\"].type.mass_kg", 12.5);
    ASSERT_TRUE(changed);
    EXPECT_EQ(*changed->at("robot[2].type.mass_kg")->asFloat(), 12.5);
    EXPECT_EQ(*changed->at("robot[1].type.mass_kg")->asFloat(), 10.0) << "of its own robot alone";
    EXPECT_EQ(*value.at("robot[2].type.mass_kg")->asFloat(), 10.0);
    EXPECT_EQ(*changed->at("robot[2].type.shape.radius_m")->asFloat(), 0.2);
    const auto added = value.with("variation.mass_share", 0.5);
    ASSERT_TRUE(added) << "tables on the way are made";
    EXPECT_EQ(*added->at("variation.mass_share")->asFloat(), 0.5);
    EXPECT_EQ(added->without("variation"), value);
    EXPECT_EQ(value.without("robot[1]").at("robot[1].name"), value.without("robot[1]").at("robot[\"keeper\"].name"));
    EXPECT_EQ(value.without("nothing"), value);
    EXPECT_EQ(value.with("robot[3].name", "x").error().message(),
              "robot[3].name: names nothing that there is; expected a path such as robot[2].network");
    EXPECT_EQ(value.with("seed.x", 1).error().message(),
              "seed.x: names nothing that there is; expected a path such as robot[2].network");
    EXPECT_EQ(value.with("robot[", 1).error().message(), "robot[: is no path; expected one such as robot[2].network");
}

TEST(Value, StarIsAllElements) {
    const Value value = game();
    EXPECT_EQ(value.at("robot[*].name"), value.at("robot[1].name"));
    const auto changed = value.with("robot[*].type.mass_kg", 12.5);
    ASSERT_TRUE(changed);
    EXPECT_EQ(*changed, *value.with("robot[1].type.mass_kg", 12.5)->with("robot[2].type.mass_kg", 12.5));
    EXPECT_TRUE(value.without("robot[*]").at("robot")->asArray()->empty());
    EXPECT_EQ(value.without("robot[*]").with("robot[*].type.mass_kg", 1).error().message(),
              "robot[*].type.mass_kg: names nothing that there is; expected a path such as robot[2].network");
    EXPECT_FALSE(value.with("seed[*]", 1));
}

TEST(Value, PlacesAreTheSameHoweverAPathIsWritten) {
    using Places = std::vector<std::string>;
    const Value value = game();
    EXPECT_EQ(value.places("robot[\"keeper\"].start.x_m"), Places{"robot[2].start.x_m"});
    EXPECT_EQ(value.places("robot[2].start.x_m"), Places{"robot[2].start.x_m"});
    EXPECT_EQ(value.places("robot[*].type.shape"), (Places{"robot[1].type.shape", "robot[2].type.shape"}));
    EXPECT_EQ(value.places("robot[2].controller.gain"), Places{"robot[2].controller.gain"}) << "a new key";
    for (const char* const none : {"robot[3].start", "robot[\"b\"]", "object[*].start", "robot[x]"})
        EXPECT_EQ(value.places(none), Places{}) << none;
}

TEST(Value, WhoNamesAnElementHasTheLastWord) {
    std::string order;
    for (const auto& [path, value] : generalFirst({{"a", 1},
                                                   {"robot[\"keeper\"].w[*].x", 2},
                                                   {"robot[*].w[*].x", 3},
                                                   {"robot[\"keeper\"].w[1].x", 4},
                                                   {"b", 5}}))
        order += std::to_string(*value.asInteger());
    EXPECT_EQ(order, "32154") << "else as they are in the table";
}

TEST(Value, EqualityIsOfContentToTheLastBit) {
    EXPECT_EQ(game(), game());
    EXPECT_NE(Value(0.0), Value(-0.0));
    EXPECT_NE(Value(1), Value(1.0));
    EXPECT_NE(*game().with("robot[1].type.shape.radius_m", 0.2000000000000001), game());
    EXPECT_EQ(Value(file("a", 1)), Value(file("b", 1))) << "whatever it is called";
}

TEST(ValueBytes, ComeBackToTheBit) {
    const Value value = game();
    const std::string bytes = valueBytes(value);
    const auto again = parseValue(bytes);
    ASSERT_TRUE(again);
    EXPECT_EQ(*again, value);
    EXPECT_EQ(valueBytes(*again), bytes);
    EXPECT_EQ(hashOf(*again), hashOf(value));
    EXPECT_EQ(again->at("robot[1].type")->asFile(), again->at("robot[2].type")->asFile()) << "each file once";
    EXPECT_EQ(again->at("robot[1].type")->asFile()->name, "robot.toml");
    for (const Value& single : {Value(), Value(true), Value(false), Value(std::int64_t{-5}), Value(-0.0), Value("\0x")})
        EXPECT_EQ(parseValue(valueBytes(single)), single);
}

TEST(ValueBytes, AreTheSameHoweverItWasMade) {
    // Two files of one content and name are one.
    const Value shape = file("s", 1);
    const Value shared = Value::Array{shape, shape}, apart = Value::Array{file("s", 1), file("s", 1)};
    EXPECT_EQ(valueBytes(shared), valueBytes(apart));
    const auto one = parseToml("b = 1.5 # b\na = { c = 2, d = \"x\" }\n", "f");
    const auto other = parseToml("a.d = \"x\"\na.c = 2\nb = 15e-1", "f");
    EXPECT_EQ(valueBytes(*one), valueBytes(*other));
    EXPECT_NE(hashOf(game()), hashOf(*game().with("seed", 8)));
    EXPECT_EQ(hashOf(file("a", 1)), hashOf(file("b", 1)));
    EXPECT_NE(hashOf(file("a", 1)), hashOf(file("a", 2)));
}

TEST(ValueBytes, KnownFilesAreToldByTheirHashes) {
    const Value big = file("big", std::string(10'000, 'x'));
    const Value value = *game().with("log", big);
    const std::vector<Value::File> known = filesOf(game()), all = filesOf(value);
    EXPECT_EQ(known.size(), 2u);
    const std::string bytes = valueBytes(value, all);
    EXPECT_LT(bytes.size(), 1000u);
    ASSERT_TRUE(parseValue(bytes, all));
    EXPECT_EQ(*parseValue(bytes, all), value);
    EXPECT_FALSE(parseValue(bytes, known)) << "one of them is not";
}

TEST(ValueBytes, UnsoundOnesAreNone) {
    const std::string bytes = valueBytes(game());
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(parseValue(bytes.substr(0, size))) << size;
    EXPECT_FALSE(parseValue(bytes + 'x'));
    // A number of elements is believed as far as there are bytes for them, and no deeper than anybody nests.
    std::string many(8, '\0'), deep(8, '\0');
    many += '\6';
    appendNumber(many, ~std::uint64_t{0});
    EXPECT_FALSE(parseValue(many));
    for (int i = 0; i < 100'000; ++i) {
        deep += '\6';
        appendNumber(deep, std::uint64_t{1});
    }
    EXPECT_FALSE(parseValue(deep));
    std::string unordered(8, '\0');
    unordered += '\7';
    appendNumber(unordered, std::uint64_t{2});
    for (const char* const key : {"b", "a"}) {
        appendLong(unordered, key);
        unordered += '\1';
    }
    EXPECT_FALSE(parseValue(unordered));
}

}  // namespace
}  // namespace mrose
