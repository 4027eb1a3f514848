// What is made without a log or a run: synthetic logs, checked and drawn descriptions.
#include "logs/log_reader.h"
#include "support/workshop.h"
#include "workflow/check_description.h"
#include "workflow/expect_error.h"
#include "workflow/generate_logs.h"

namespace mrose {
namespace {

using Making = Workshop;

TEST_F(Making, SyntheticLogsAreWrittenOnePatternEach) {
    GenerateRequest request{path("logs")};
    request.pattern = "ellipse";
    request.repeats = 2;
    const auto made = generateLogs(request);
    ASSERT_TRUE(made) << made.error().message();
    ASSERT_EQ(made->size(), 1u);
    EXPECT_EQ((*made)[0].file, path("logs/ellipse.csv"));
    EXPECT_EQ((*made)[0].trajectories, 2u);
    const auto log = readLog(path("logs/ellipse.csv"));
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_TRUE(log->synthetic);
    EXPECT_EQ(log->robots[0].trajectories.size(), 2u);
    expectError(generateLogs(request), path("logs/ellipse.csv"), {"is there already"});
}

TEST_F(Making, SyntheticLogsThatCannotBeMade) {
    GenerateRequest request{path("logs")};
    expectError(generateLogs(request), "", {"--set, --pattern: exactly one of them"});
    request.pattern = "spiral";
    expectError(generateLogs(request), "", {"--pattern: \"spiral\""});
    request.pattern = "random";
    request.trajectories = 1'000'000;
    expectError(generateLogs(request), "", {"--trajectories: more than 1,000,000 s"});
    request.trajectories = 1;
    double before = -1;
    const auto ended = generateLogs(request, [&](double share) {
        EXPECT_GT(share, before);
        before = share;
        return false;
    });
    expectError(ended, path("logs"), {"cancelled"});
    EXPECT_FALSE(std::filesystem::exists(path("logs"))) << "nothing stays";
}

TEST_F(Making, DescriptionsAreCheckedAndDrawn) {
    std::vector<CheckedDescription> checked;
    for (const char* file : {"shapes/ball.toml", "soccer.toml"}) {
        auto one = checkDescription({file});
        ASSERT_TRUE(one) << one.error().message();
        EXPECT_EQ(one->file, file);
        EXPECT_NE(one->picture.find("<svg"), std::string::npos);
        EXPECT_FALSE(one->holds.empty());
        checked.push_back(std::move(*one));
    }
    EXPECT_EQ(checked[0].kind, "shape");
    EXPECT_EQ(checked[1].kind, "scenario");
    ASSERT_TRUE(writePictures(checked, path("pictures"), false));
    EXPECT_EQ(read("pictures/ball.shape.svg"), checked[0].picture);
    EXPECT_EQ(read("pictures/soccer.scenario.svg"), checked[1].picture);
    expectError(writePictures(checked, path("pictures"), false), path("pictures/ball.shape.svg"), {"is there already"});
    expectError(writePictures(checked, path("one.svg"), false), path("one.svg"), {"expected a folder"});
    checked[1] = checked[0];
    expectError(writePictures(checked, path("twice"), false), path("twice/ball.shape.svg"), {"of two of the files"});
    EXPECT_FALSE(std::filesystem::exists(path("twice")));
}

TEST_F(Making, WhatIsWrongWithADescriptionHasItsPlace) {
    const std::string wrong = write("wrong.toml", "format = \"mrose shape\"\nversion = 1\nname = 3\n");
    const auto checked = checkDescription({wrong});
    expectError(checked, wrong, {"name: "});
    EXPECT_EQ(checked.error().line, 3);
}

}  // namespace
}  // namespace mrose
