// What ./bench.sh accuracy makes of its figures: the judgement, the page and the rows.
#include "accuracy/results.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace roboss::bench {
namespace {

/// One case of three figures on two engines: an error, a value with a target, a stated one.
Results two_engines(double ours, double theirs) {
    Results all;
    all.cases.push_back({"turn",
                         "A turn",
                         "closed form",
                         {{"error", "m", 1e-3}, {"rate", "rad/s", 0.01, 0.5}, {"speed", "m/s", {}}},
                         nullptr});
    all.cases[0].remark = "Because of the method.";
    all.engines = {{"RoBOSS", "RoBOSS", "double"}, {"Other", "Other 1.0", "single"}};
    all.results.push_back({0, "RoBOSS", 1e-3, false, {{ours, 0.505, 3.0}}, 0.1});
    all.results.push_back({0, "Other", 1e-3, false, {{theirs, 0.7, std::nan("")}}, 0.1});
    return all;
}

TEST(AccuracyResults, AFigureIsJudgedByItsDistanceFromTheTarget) {
    EXPECT_TRUE(passes({"x", "", 0.01, 0.5}, 0.495));
    EXPECT_FALSE(passes({"x", "", 0.01, 0.5}, 0.52));
    EXPECT_FALSE(passes({"x", "", 0.01}, std::nan("")));
    EXPECT_TRUE(passes({"x", "", {}}, 1e9)) << "only stated";
}

TEST(AccuracyResults, OnlyOurFiguresDecide) {
    EXPECT_TRUE(all_ours_pass(two_engines(5e-4, 1.0)));
    EXPECT_FALSE(all_ours_pass(two_engines(2e-3, 0.0)));
    EXPECT_FALSE(all_ours_pass(two_engines(std::nan(""), 0.0)));
    Results coarse = two_engines(2e-3, 0.0);
    coarse.results[0].coarse = true;
    EXPECT_TRUE(all_ours_pass(coarse)) << "the second table is for comparison";
    Results unable = two_engines(5e-4, 1.0);
    unable.results[0].outcome.possible = false;
    EXPECT_FALSE(all_ours_pass(unable));
}

TEST(AccuracyResults, ThePageSaysWhatIsMissedByHowMuchAndWhy) {
    const std::string page = to_markdown(two_engines(2e-3, 5e-4), "picture.svg");
    EXPECT_NE(page.find("**missed**, 2 times the bound"), std::string::npos) << page;
    EXPECT_NE(page.find("- A turn, error: 0.002, must be <= 0.001. Because of the method."),
              std::string::npos)
        << page;
    EXPECT_NE(page.find("| 0.505 | 0.7 ✗ |"), std::string::npos) << page;
    EXPECT_NE(page.find("blew up"), std::string::npos) << page;
    EXPECT_NE(page.find("](picture.svg)"), std::string::npos) << page;
    EXPECT_NE(to_markdown(two_engines(5e-4, 1), "").find("Nowhere"), std::string::npos);
}

TEST(AccuracyResults, RowsCarryFigureBoundAndVerdict) {
    const auto json = nlohmann::json::parse(to_json(two_engines(2e-3, 5e-4)));
    ASSERT_EQ(json["rows"].size(), 6u);
    EXPECT_EQ(json["rows"][0]["engine"], "RoBOSS");
    EXPECT_EQ(json["rows"][0]["pass"], false);
    EXPECT_EQ(json["rows"][1]["target"], 0.5);
    EXPECT_TRUE(json["rows"][2]["pass"].is_null());
    EXPECT_TRUE(json["rows"][5]["figure"].is_null()) << "no number";
}

}  // namespace
}  // namespace roboss::bench
