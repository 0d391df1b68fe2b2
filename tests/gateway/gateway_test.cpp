// Browsers of all kinds at the gateway of a living run: what they see is what is, what they order is done,
// and what they do wrong harms nobody but themselves.
#include <gtest/gtest.h>
#include <support/bodies.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "model/edit.h"
#include "viewed.h"
#include "wire/view_state.h"

namespace roboss::test {
namespace {

TEST_F(Viewed, BrowsersSeeEveryRobotWhereItIsAndTheHashStaysTheSame) {
    LiveRunOptions options;
    options.end = 2000;
    options.simulators = 3;
    options.speed = 2;
    const auto run = begin(options);
    Browser first{ViewerUrl(run->url())}, second{ViewerUrl(run->url())};
    for (Browser* browser : {&first, &second}) {
        ASSERT_TRUE(browser->connected());
        browser->know(coordinates_of(*model));
        browser->send(watch({0, 3}, {"contacts", "groups"}));
    }
    EXPECT_TRUE(first.until([&] { return first.tick() == 2000; }));
    EXPECT_TRUE(second.until([&] { return second.tick() == 2000; }));
    const std::uint64_t hash = run->hash_at_end();
    EXPECT_EQ(to_hex(hash), to_hex(undisturbed(model, 2000)));
    first.live(1500);  // what may have been lost is said again
    EXPECT_FALSE(first.damaged());
    EXPECT_GT(first.states(), 20u);
    ASSERT_EQ(first.robots().size(), model->robots.size());
    ASSERT_NE(first.last("robot"), nullptr);
    const Json& robot = *first.last("robot");
    const Browser::Shown& shown = first.robots().at(robot["robot"]);
    EXPECT_EQ(robot["tick"], 2000);
    EXPECT_EQ(robot["joints"].size(),
              model->type_of(RobotId(robot["robot"].get<std::size_t>())).joints.size());
    const Vec3 origin = model->types[model->robots[robot["robot"].get<std::size_t>()].type.index()].X_RB.p;
    const Vec3 way{robot["pose"][0].get<double>() - static_cast<double>(shown.position[0]),
                   robot["pose"][1].get<double>() - static_cast<double>(shown.position[1]),
                   robot["pose"][2].get<double>() - static_cast<double>(shown.position[2])};
    EXPECT_NEAR(norm(way), norm(origin), 1e-3) << "the exact state and the picture agree";
    ASSERT_NE(first.last("overlay"), nullptr);
    EXPECT_GT((*first.last("overlay"))["contacts"].size(), 20u);
    EXPECT_NE(first.last("groups"), nullptr);
    ASSERT_NE(first.last("status"), nullptr);
    EXPECT_EQ((*first.last("status"))["viewers"], 2);
    EXPECT_FALSE(first.last("status")->contains("robots")) << "names are in the scene";
}

TEST_F(Viewed, PicturesOfTheSceneAreServedByTheirHashAndNothingElseIs) {
    LiveRunOptions options;
    options.textures = {{0xABCDEF, PictureKind::kPng, {1, 2, 3}}, {7, PictureKind::kJpeg, {9}}};
    const auto run = begin(options);
    const ViewerUrl url(run->url());
    ASSERT_EQ(http_get(url, "/scene").status, 200);
    const HttpAnswer png = http_get(url, "/texture/0000000000abcdef");
    EXPECT_EQ(png.status, 200);
    EXPECT_EQ(png.headers.at("Content-Type"), "image/png");
    EXPECT_EQ(png.headers.at("X-Content-Type-Options"), "nosniff");
    EXPECT_NE(png.headers.at("Cache-Control").find("immutable"), std::string::npos);
    EXPECT_EQ(png.body, "\1\2\3");
    EXPECT_EQ(http_get(url, "/texture/0000000000000007").headers.at("Content-Type"), "image/jpeg");
    for (const char* path :
         {"/texture/", "/texture/0000000000000008", "/texture/0000000000ABCDEF", "/texture/abcdef",
          "/texture/../scene", "/texture//etc/passwd", "/texture/0000000000abcdef/.."})
        EXPECT_EQ(http_get(url, path).status, 404) << path;
    EXPECT_EQ(http_get(url, "/texture/0000000000abcdef", "evil.example:80").status, 403);
}

TEST_F(Viewed, OrdersOfAPageAreObeyedAlsoInAPausedWorldAndAnswered) {
    const auto run = begin();
    Browser page{ViewerUrl(run->url())};
    page.know(coordinates_of(*model));
    page.send(watch({2}));
    ASSERT_TRUE(page.until([&] { return page.robots().size() == model->robots.size(); }));
    page.send({{"type", "control"}, {"id", 1}, {"words", {"pause"}}});
    ASSERT_TRUE(page.until([&] { return page.answer(1).has_value(); }));
    page.send(
        {{"type", "order"}, {"id", 2}, {"robot", 2}, {"action", "pose"}, {"pose", {50, 60, 2, 1, 0, 0, 0}}});
    ASSERT_TRUE(page.until([&] { return page.answer(2).has_value(); }));
    EXPECT_TRUE(page.answer(2)->starts_with("yes")) << *page.answer(2);
    page.send({{"type", "control"}, {"id", 3}, {"words", {"resume"}}});
    EXPECT_TRUE(page.until([&] { return std::abs(page.robots().at(2).position[0] - 50) < 1; }));
    EXPECT_NEAR(page.robots().at(2).position[1], 60, 1);
    page.send({{"type", "order"},
               {"id", 4},
               {"robot", 2},
               {"action", "joint"},
               {"joint", 99},
               {"mode", "effort"},
               {"target", 1}});
    page.send({{"type", "order"},
               {"id", 5},
               {"robot", 2},
               {"action", "velocity"},
               {"linear", {0, 0, 9}},
               {"angular", {0, 0, 0}}});
    page.send({{"type", "control"}, {"id", 6}, {"words", {"fly"}}});
    ASSERT_TRUE(page.until([&] { return page.answer(4) && page.answer(5) && page.answer(6); }));
    EXPECT_TRUE(page.answer(4)->starts_with("no")) << *page.answer(4);
    EXPECT_TRUE(page.answer(5)->starts_with("yes")) << *page.answer(5);
    EXPECT_TRUE(page.answer(6)->starts_with("no")) << *page.answer(6);
    EXPECT_NE(page.answer(6)->find("[unknown-request]"), std::string::npos) << *page.answer(6);
}

TEST_F(Viewed, OwnNumbersAreOrderedAndToldToThePageThatAsksForThem) {
    const auto run = begin();
    std::size_t cart = 0, wheel = 0;
    while (model->robots[cart].name != "cart_2") ASSERT_LT(++cart, model->robots.size());
    const RobotType& type = model->type_of(RobotId(cart));
    while (type.joints[wheel].nv == 0) ASSERT_LT(++wheel, type.joints.size());
    Browser page{ViewerUrl(run->url())}, other{ViewerUrl(run->url())};
    Json wanted = watch({static_cast<int>(cart)});
    wanted["numbers"] = {{"robot", cart}, {"joint", wheel}};
    page.send(wanted);
    other.send(watch({static_cast<int>(cart)}));
    const auto damping = [&] {
        for (const Json& row : (*page.last("numbers"))["numbers"])
            if (row["name"] == "damping") return row;
        return Json();
    };
    ASSERT_TRUE(page.until([&] { return page.last("numbers") != nullptr; }));
    const double of_file = damping()["value"];
    EXPECT_FALSE(damping().contains("file"));
    const auto order = [&](int id, const Json& values) {
        page.send({{"type", "order"},
                   {"id", id},
                   {"robot", cart},
                   {"action", "joint_parameters"},
                   {"joint", wheel},
                   {"values", values}});
        EXPECT_TRUE(page.until([&] { return page.answer(id).has_value(); }));
        return page.answer(id).value_or("");
    };
    const std::string refused = order(1, {{"damping", -1}}), taken = order(2, {{"damping", of_file + 0.25}});
    EXPECT_NE(refused.find("[bad-parameter]"), std::string::npos) << refused;
    EXPECT_TRUE(taken.starts_with("yes")) << taken;
    EXPECT_TRUE(page.until([&] { return damping()["value"] == of_file + 0.25; }));
    EXPECT_EQ(damping()["file"], of_file);
    const auto own = [&] { return other.last("robot") != nullptr && other.last("robot")->contains("own"); };
    EXPECT_TRUE(other.until(own));
    EXPECT_EQ((*other.last("robot"))["own"]["joints"][0]["values"], Json({{"damping", of_file + 0.25}}));
    EXPECT_EQ(other.last("numbers"), nullptr) << "it did not ask";
}

TEST_F(Viewed, OnlyWhatMovesIsSentAgain) {
    LiveRunOptions options;
    options.paused = true;
    const auto run = begin(options);
    Browser page{ViewerUrl(run->url())};
    page.know(coordinates_of(*model));
    ASSERT_TRUE(page.until([&] { return page.robots().size() == model->robots.size(); }));
    const std::uint64_t whole = page.state_bytes(), states = page.states();
    EXPECT_TRUE(page.until([&] { return page.states() > states + 1; }))
        << "a resting world sends empty States now and then";
    EXPECT_EQ(page.state_bytes() - whole, viewer_protocol::kStateBytes * (page.states() - states));
    page.send({{"type", "whole"}});
    EXPECT_TRUE(page.until([&] { return page.last_was_whole(); }));
}

TEST_F(Viewed, AnotherModelIsAnotherSceneAndTheFirstStateOfItIsWhole) {
    const auto run = begin();
    Browser page{ViewerUrl(run->url())};
    page.know(coordinates_of(*model));
    ASSERT_TRUE(page.until([&] { return page.scene() == 1 && page.states() > 3; }));
    const Json order{{"type", "order"},     {"id", 1},
                     {"robot", 0},          {"action", "velocity"},
                     {"linear", {0, 0, 1}}, {"angular", {0, 0, 0}}};
    page.send(order);  // so that it has a seat, for which the next Simulation must not wait
    ASSERT_TRUE(page.until([&] { return page.answer(1).has_value(); }));
    const Result<ModelEdit> edit = without_robots(*model, {model->robots[1].name});
    ASSERT_TRUE(edit.ok());
    page.know(coordinates_of(*edit.value().model), 2);
    run->change_model(edit.value().model);
    ASSERT_TRUE(
        page.until([&] { return page.last("scene") != nullptr && (*page.last("scene"))["scene"] == 2; }));
    ASSERT_TRUE(page.until(
        [&] { return page.scene() == 2 && page.robots().size() == edit.value().model->robots.size(); }));
    const Json scene = Json::parse(http_get(ViewerUrl(run->url()), "/scene").body);
    EXPECT_EQ(scene["scene"], 2);
    EXPECT_EQ(scene["robots"].size(), edit.value().model->robots.size());
    Json again = order;
    again["id"] = 2;
    page.send(again);
    ASSERT_TRUE(page.until([&] { return page.answer(2).has_value(); }));
    EXPECT_TRUE(page.answer(2)->starts_with("yes")) << *page.answer(2);
}

/// Boxes in free fall, far from each other: much to tell, and little to compute.
std::shared_ptr<const Model> falling_boxes(int boxes) {
    World world;
    world.dt_s = 0.002;
    world.prototypes.push_back(solid_box(1, {0.1, 0.1, 0.1}, surface(1)));
    for (int i = 0; i < boxes; ++i)
        world.instances.push_back(
            {"box_" + std::to_string(i), 0, {{2.0 * (i % 50), 2.0 * (i / 50), 0}, {}}, {}});
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

TEST_F(Viewed, ASlowReaderHoldsNobodyUpAndSeesTheLatestWhenItReadsAgain) {
    const auto boxes = falling_boxes(1000);
    LiveRun run(boxes, {});
    SocketHeaders narrow;
    narrow.receive_bytes = 4096;
    Browser slow(ViewerUrl(run.url()), narrow), quick{ViewerUrl(run.url())};
    for (Browser* browser : {&slow, &quick}) browser->send(watch({}));
    ASSERT_TRUE(slow.until([&] { return slow.states() > 0; }));
    slow.stop_reading();
    const auto states = [&] { return run.gateway().load().sent_bytes; };
    ASSERT_TRUE(quick.until([&] { return quick.states() > 60; }, 60'000));
    const std::uint64_t before = states(), quick_before = quick.state_bytes();
    ASSERT_TRUE(quick.until([&] { return quick.states() > 120; }, 60'000));
    const double share =
        static_cast<double>(states() - before) / static_cast<double>(quick.state_bytes() - quick_before);
    EXPECT_LT(share, 1.2) << "nothing more goes to who does not read";
    const Tick tick = run.tick();
    slow.read_again();
    EXPECT_TRUE(slow.until([&] { return slow.tick() >= static_cast<double>(tick); })) << slow.tick();
    EXPECT_LT(slow.states(), quick.states() / 2);
    EXPECT_FALSE(slow.closed());
}

struct Misdeed {
    const char* name;
    std::function<void(Browser&)> act;
    const char* line;
};

TEST_F(Viewed, WhoMisbehavesIsCutOffWithALineAndTheRunGoesOnWithTheSameHash) {
    const Misdeed misdeeds[] = {
        {"no JSON", [](Browser& b) { b.send_text("{\"type\": \"wat"); }, "[bad-message]"},
        {"an unknown type",
         [](Browser& b) {
             b.send({{"type", "format_disk"}});
         },
         "\"type\""},
        {"a list of lists", [](Browser& b) { b.send_text(std::string(5000, '[')); }, "[bad-message]"},
        {"numbers that are none",
         [](Browser& b) {
             b.send_text(R"({"type":"order","id":1,"robot":0,"action":"pose","pose":[null,0,0,1,0,0,0]})");
         },
         "\"pose\""},
        {"a robot below zero",
         [](Browser& b) {
             b.send({{"type", "watch"}, {"robots", {-1}}});
         },
         "\"robots\""},
        {"a binary message", [](Browser& b) { b.send_text("\1\2\3", true); }, "[binary-message]"},
        {"too large a message", [](Browser& b) { b.send_text(std::string(70'000, ' ')); }, "[too-large]"},
        {"a frame that is none", [](Browser& b) { b.send_raw(std::string(64, '\xFF')); }, "[broken]"},
        {"half a frame, then nothing",
         [](Browser& b) {
             b.send_raw("\x81\xFE\x10");
             b.vanish();
         },
         "[broken]"},
        {"a flood",
         [](Browser& b) {
             for (int i = 0; i < 1000 && !b.closed(); ++i) b.send({{"type", "whole"}});
         },
         "[flood]"},
    };
    LiveRunOptions options;
    options.end = 3000;
    options.speed = 1;
    const auto run = begin(options);
    Browser good{ViewerUrl(run->url())};
    for (const Misdeed& misdeed : misdeeds) {
        Browser bad{ViewerUrl(run->url())};
        ASSERT_TRUE(bad.connected());
        misdeed.act(bad);
        EXPECT_TRUE(bad.until([&] { return bad.closed(); }, 5000)) << misdeed.name;
        EXPECT_TRUE(run->says(misdeed.line)) << misdeed.name << "\n" << run->log();
        const bool told = misdeed.line != std::string("[broken]");
        EXPECT_EQ(bad.reason().find(": ") != std::string::npos, told) << misdeed.name << ": " << bad.reason();
    }
    const std::uint64_t states = good.states();
    EXPECT_TRUE(good.until([&] { return good.states() > states; })) << "others are served as before";
    EXPECT_FALSE(good.closed());
    EXPECT_EQ(to_hex(run->hash_at_end()), to_hex(undisturbed(model, 3000)));
}

TEST_F(Viewed, ThoseWhoAreRefusedCannotFillTheLog) {
    const auto run = begin();
    for (int i = 0; i < 300; ++i) EXPECT_EQ(http_get(ViewerUrl(run->url()), "/", "evil.example").status, 403);
    EXPECT_TRUE(run->says("[rate-limited]"));
    const std::string log = run->log();
    EXPECT_LT(std::count(log.begin(), log.end(), '\n'), 200);
}

TEST_F(Viewed, CrowdsAreTurnedAway) {
    const auto run = begin();
    std::vector<std::unique_ptr<Browser>> pages;
    for (int i = 0; i < 16; ++i) {
        pages.push_back(std::make_unique<Browser>(ViewerUrl(run->url())));
        ASSERT_TRUE(pages.back()->connected());
    }
    EXPECT_FALSE(Browser{ViewerUrl(run->url())}.connected());
    EXPECT_TRUE(run->says("[too-many-pages]"));
    pages.clear();
    for (int i = 0; i < 100; ++i) {
        if (Browser{ViewerUrl(run->url())}.connected()) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << "places are free again when pages have gone";
}

TEST_F(Viewed, ThePagesFilesAreServedWithTheirTypesAndNothingBesidesThem) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "roboss_web",
                   outside = fs::path(testing::TempDir()) / "roboss_secret";
    fs::create_directories(folder / "assets");
    std::ofstream(folder / "index.html") << "<!doctype html>page";
    std::ofstream(folder / "assets" / "main.js") << "let a = 1;";
    std::ofstream(folder / ".hidden") << "hidden";
    std::ofstream(outside) << "secret";
    std::error_code error;
    fs::create_symlink(outside, folder / "link.txt", error);
    LiveRunOptions options;
    options.page_folder = folder.string();
    const auto run = begin(options);
    const ViewerUrl url(run->url());
    EXPECT_EQ(http_get(url, "/?robot=3").body, "<!doctype html>page");
    const HttpAnswer script = http_get(url, "/assets/main.js?v=2");
    EXPECT_EQ(script.body, "let a = 1;");
    EXPECT_EQ(script.headers.at("Content-Type"), "text/javascript; charset=utf-8");
    for (const char* path :
         {"/.hidden", "/link.txt", "/assets", "/assets/../.hidden", "/%2e%2e/roboss_secret"})
        EXPECT_EQ(http_get(url, path).status, 404) << path;
    fs::remove_all(folder);
    fs::remove(outside);
}

TEST_F(Viewed, ATakenPortIsFollowedByTheNextOne) {
    const auto first = begin();
    LiveRunOptions options;
    options.listen = ViewerUrl(first->url()).port;
    const auto second = begin(options);
    EXPECT_NE(ViewerUrl(second->url()).port, ViewerUrl(first->url()).port);
    EXPECT_EQ(http_get(ViewerUrl(second->url()), "/").status, 200);
}

}  // namespace
}  // namespace roboss::test
