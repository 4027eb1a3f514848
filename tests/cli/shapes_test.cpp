// `mrose shapes`: checks and draws descriptions.
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "io/file.h"
#include "support/places.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using Shapes = Workshop;

std::string shipped(const std::string& name) { return (sourceFolder() / name).string(); }

constexpr const char* square = R"(format = "mrose shape"
version = 1
name = "square"
[[part]]
polygon_m = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
)";

TEST_F(Shapes, SaysWhatEachFileHolds) {
    const auto result = runMrose(
        {"shapes", shipped("shapes/pioneer1.toml"), "shapes/ball.toml", shipped("resources/scenarios/soccer.toml")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out, shipped("shapes/pioneer1.toml") + ": shape \"Pioneer 1\", 3 parts, 3 convex pieces\n" +
                              "shapes/ball.toml: shape \"ball\", 1 part, 1 convex piece\n" +
                              shipped("resources/scenarios/soccer.toml") +
                              ": scenario \"soccer\", 8 robots, 1 object\n");
    const auto json = runMrose({"shapes", "mrose:shapes/ball.toml", "--json"});
    EXPECT_EQ(nlohmann::json::parse(json.out).at(0).at("kind"), "shape");
    EXPECT_EQ(runMrose({"shapes", "mrose:shapes/ball.toml", "-q"}).out, "");
}

/// By the names by which scenarios find them, and `mrose run` its scenario.
TEST_F(Shapes, FindsWhatShips) {
    for (const auto& [name, holds] :
         {std::pair{"soccer.toml", "scenario \"soccer\", 8 robots, 1 object\n"},
          std::pair{"b21_corridor.toml", "1 robot, 3 persons, "}, std::pair{"ball.toml", "shape \"ball\""},
          std::pair{"midsize_2001.toml", "4 walls, 0 other obstacles, 2 goals\n"},
          std::pair{"resources/robots/b21.toml", "robot \"B21\""}}) {
        const auto result = runMrose({"shapes", name});
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_NE(result.out.find(holds), std::string::npos) << result.out;
    }
    EXPECT_EQ(runMrose({"run", "resources/scenarios/soccer.toml", "--duration", "0.1"}).status, 0);
    expectOneLine(runMrose({"shapes", "create.toml"}),
                  {"create.toml: several files of that name ship: resources/robots/create.toml and "
                   "shapes/create.toml; expected one of them"});
    const std::string places[] = {"", "resources/scenarios/", "resources/environments/", "resources/robots/",
                                  "shapes/"};
    std::vector<std::string> parts{"none.toml: does not exist, nor does "};
    for (const std::string& place : places) parts.push_back(shipped(place + "none.toml"));
    expectOneLine(runMrose({"shapes", "none.toml"}), parts);
    expectOneLine(runMrose({"run", "none.toml"}),
                  {"none.toml: does not exist, nor does ",
                   shipped("none.toml") + " or " + shipped("resources/scenarios/none.toml")});
}

TEST_F(Shapes, DrawsIntoAFileOrAFolder) {
    const std::string own = write("square.toml", square);
    EXPECT_EQ(runMrose({"shapes", own, "-o", path("one.svg")}).status, 0);
    EXPECT_TRUE(read("one.svg").starts_with("<svg "));
    EXPECT_NE(read("one.svg").find(">square</text>"), std::string::npos);
    EXPECT_EQ(runMrose({"shapes", own, "shapes/create.toml", "resources/robots/create.toml", "-o", path("all")}).status,
              0);
    EXPECT_EQ(read("all/square.shape.svg"), read("one.svg"));
    EXPECT_NE(read("all/create.shape.svg"), "");
    EXPECT_NE(read("all/create.robot.svg"), read("all/create.shape.svg"));
}

/// README shows them; `mrose shapes NAME.toml -o resources/pictures/NAME.svg --overwrite` draws them anew.
TEST_F(Shapes, PicturesThatShipAreOfWhatShips) {
    for (const std::string name : {"soccer", "b21_corridor"}) {
        EXPECT_EQ(runMrose({"shapes", name + ".toml", "-o", path(name + ".svg")}).status, 0);
        EXPECT_EQ(read(name + ".svg"), readFile(shipped("resources/pictures/" + name + ".svg")).value_or(""))
            << name << ".svg is to be drawn anew";
    }
}

TEST_F(Shapes, WhatIsWrongIsOneLineAndNothingIsWritten) {
    const std::string good = write("good.toml", square);
    const std::string bad = write("bad.toml", replaced(square, "[1, 1]", "[1, -1]"));
    expectOneLine(runMrose({"shapes", good, bad, "-o", path("out")}), {"bad.toml:5:24: part[1].polygon_m[2]: "});
    EXPECT_FALSE(std::filesystem::exists(path("out")));
    expectOneLine(runMrose({"shapes", path("none.toml")}), {"none.toml: does not exist"});
    expectOneLine(runMrose({"shapes", path("")}), {"Is a directory"});
    expectOneLine(runMrose({"shapes", shipped("nets/create.net")}), {"create.net:2:10: format: "});
    expectOneLine(runMrose({"shapes", good, good, "-o", path("two.svg")}), {"two.svg: ", "expected a folder"});
    std::filesystem::create_directory(path("again"));
    write("again/good.toml", square);
    expectOneLine(runMrose({"shapes", good, path("again/good.toml"), "-o", path("out")}), {"good.shape.svg: "});
    expectOneLine(runMrose({"shapes", good, "-o", path("no/such/folder/x.svg")}), {"x.svg: cannot be written"});
    expectOneLine(runMrose({"shapes"}), {"FILE"}, 2);
}

TEST_F(Shapes, ResourcesAreWhereTheEnvironmentSays) {
    write("elsewhere/shapes/own.toml", square);
    ::setenv("MROSE_RESOURCES", path("elsewhere").c_str(), 1);
    EXPECT_EQ(runMrose({"shapes", "mrose:shapes/own.toml"}).status, 0);
    expectOneLine(runMrose({"shapes", "mrose:shapes/ball.toml"}), {path("elsewhere"), "shapes/ball.toml"});
    ::unsetenv("MROSE_RESOURCES");
    EXPECT_EQ(runMrose({"shapes", "mrose:shapes/ball.toml"}).status, 0);
}

/// Checking a scenario must not run what it names.
TEST_F(Shapes, PluginsAreNotLoaded) {
    std::string soccer;
    {
        std::ifstream file(shipped("resources/scenarios/soccer.toml"));
        soccer.assign(std::istreambuf_iterator<char>(file), {});
    }
    const std::string own =
        write("s.toml", replaced(soccer, "{ kind = \"wander\" }", "{ kind = \"plugin\", library = \"/no/such.so\" }"));
    EXPECT_EQ(runMrose({"shapes", own}).status, 0);
}

TEST_F(Shapes, FullDiskLeavesEarlierPictures) {
    const std::string own = write("square.toml", square);
    write("one.svg", "earlier");
    RunningProgram::Options options;
    options.fullDisk = true;
    EXPECT_EQ(runMrose({"shapes", own, "-o", path("one.svg"), "--overwrite"}, options).status, 1);
    EXPECT_EQ(read("one.svg"), "earlier");
}

}  // namespace
}  // namespace mrose
