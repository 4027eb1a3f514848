#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "support/workshop.h"

namespace mrose {
namespace {

using AdviseProgram = Workshop;

TEST_F(AdviseProgram, PrintsReasonsAndWritesTheScript) {
    const std::vector<std::string> words{"advise",     network(), "--log", log(),
                                         "--duration", "12",      "-o",    path("next.csv")};
    const ProgramResult said = runMrose(words);
    ASSERT_EQ(said.status, 0) << said.err;
    for (const char* part : {"manoeuvres of 12 s", "limits: forward up to ", "needs ", " s: "})
        EXPECT_THAT(said.out, testing::HasSubstr(part));
    EXPECT_THAT(read("next.csv"), testing::HasSubstr("\nt,v_cmd,w_cmd\n0.0,0.0,0.0\n"));
    expectOneLine(runMrose(words), {"next.csv", "is there already"});
    std::vector<std::string> again = words;
    again.insert(again.end(), {"--overwrite", "--json"});
    const ProgramResult told = runMrose(again);
    ASSERT_EQ(told.status, 0) << told.err;
    const auto json = nlohmann::json::parse(told.out);
    EXPECT_EQ(json["duration_s"], 12);
    EXPECT_EQ(json["script"], path("next.csv"));
    EXPECT_TRUE(json["reasons"][0]["disagreement"].is_null()) << "one network";
    EXPECT_TRUE(json["reasons"][0]["unfamiliar"].is_number());
}

TEST_F(AdviseProgram, WrongInputIsOneLine) {
    expectOneLine(runMrose({"advise", path("none.net"), "--log", log()}), {"none.net"});
    expectOneLine(runMrose({"advise", path("none.net"), "--log", log(), "-o", path("next.txt")}),
                  {"next.txt", ".csv or .toml"});
    expectOneLine(runMrose({"advise", path("none.net")}), {"--log"}, 2);
}

}  // namespace
}  // namespace mrose
