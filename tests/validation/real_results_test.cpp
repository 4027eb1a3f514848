#include "validation/real_results.h"

#include <cmath>

#include <gtest/gtest.h>

namespace mrose {
namespace {

const std::vector<std::string> measures{"time_s", "won"};

TEST(RealResults, AreReadByTheNamesOfTheirColumns) {
    const auto read = readRealResults(
        "when,trial,who,won,time_s\nbefore,7,ann,1,4.5\nafter,7,bob,0,3\nafter,7,ann,1,4\n\nbefore,9,ann,,6\r\n"
        "after,9,\"ann, bob\",1,5\n",
        "r.csv", measures);
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_EQ(read->size(), 2u);
    EXPECT_EQ(read->at(7)[0], (std::vector<double>{4.5, 1}));
    EXPECT_EQ(read->at(7)[1], (std::vector<double>{3.5, 0.5})) << "the mean of both";
    EXPECT_TRUE(std::isnan(read->at(9)[0][1])) << "not known";
    EXPECT_EQ(read->at(9)[1][0], 5);
}

/// As spreadsheets and people write them.
TEST(RealResults, BlanksAndAByteOrderMarkArePassedOver) {
    const auto read = readRealResults(
        "\xEF\xBB\xBFtrial, when ,\"time_s \",won\t\r\n 7 , before, 4.5 ,1\r\n  \r\n7,\"after \", ,\t0\r\n,, ,\r\n",
        "r.csv", measures);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->at(7)[0], (std::vector<double>{4.5, 1}));
    EXPECT_TRUE(std::isnan(read->at(7)[1][0])) << "not known";
    EXPECT_EQ(read->at(7)[1][1], 0);
}

TEST(RealResults, WhatIsWrongNamesItsLine) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "r.csv: holds no results; expected rows of trial, when and the measures"},
        {"trial,when,time_s\n", "r.csv:1: has no column \"won\"; expected trial, when and the measures"},
        {"trial,when,time_s,won\n1,before,1\n", "r.csv:2: has 3 cells; expected 4"},
        {"trial,when,time_s,won\n0,before,1,1\n",
         "r.csv:2: trial: \"0\" is no trial; expected a whole number from 1 on"},
        {"trial,when,time_s,won\n1,then,1,1\n", "r.csv:2: when: is \"then\"; expected before or after"},
        {"trial,when,time_s,won\n1,before,fast,1\n", "r.csv:2: time_s: \"fast\" is no number"},
        {"trial,when,time_s,won\n1,before,1,1\n", "r.csv: trial 1 was not measured after"},
    };
    for (const auto& [text, message] : cases) {
        const auto read = readRealResults(text, "r.csv", measures);
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().message(), message);
    }
}

}  // namespace
}  // namespace mrose
