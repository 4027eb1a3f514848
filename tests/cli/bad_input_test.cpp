// Whatever is wrong is one line that says where and why, and nothing that was there before is touched.
#include "support/workshop.h"

namespace mrose {
namespace {

using BadInput = Workshop;

TEST_F(BadInput, LogsThatCannotBeReadAreNamedByEverySubcommand) {
    const std::string net = network(), windowsFile = windows(), missing = path("missing.csv");
    std::filesystem::create_directory(path("empty"));
    const auto before = listing();
    for (const auto& [source, cause] :
         {std::pair{missing, "does not exist"}, std::pair{path("empty"), "is a folder"}, std::pair{net, "is no log"}}) {
        expectOneLine(runMrose({"inspect", source}), {source + ": ", cause});
        expectOneLine(runMrose(trainWords(source, path("b.net"))), {source + ": ", cause});
        expectOneLine(runMrose({"evaluate", net, "--log", source, "--report", path("report")}), {source + ": ", cause});
        expectOneLine(runMrose({"predict", net, "--log", source, "--windows", windowsFile, "-o", path("p.csv")}),
                      {source + ": ", cause});
    }
    EXPECT_EQ(listing(), before);
}

TEST_F(BadInput, WhatWasThereStays) {
    network();
    const std::string other = write("b.net", replaced(read("a.net"), "period_s = 0.1\n", "period_s = 0.07\n"));
    write("p.csv", "earlier");
    expectOneLine(
        runMrose({"predict", other, "--log", log(), "--windows", windows(), "-o", path("p.csv"), "--overwrite"}),
        {"b.net: period_s: ", "0.07"});
    EXPECT_EQ(read("p.csv"), "earlier");
    EXPECT_FALSE(std::filesystem::exists(path("p.csv.part")));
}

}  // namespace
}  // namespace mrose
