// Browsers at a LocalRun: they see it, order its robots, and follow it into another Model.
#include "local_view/local_view.h"

#include "model/edit.h"
#include "viewed.h"

namespace roboss::test {
namespace {

class LocallyViewed : public testing::Test {
  protected:
    void SetUp() override {
        LocalViewOptions options;
        options.listen = "0";
        run = LocalRun::create(model).value();
        view = LocalView::open(options).value();
    }
    /// Works for the page, and shows the run meanwhile.
    bool until(Browser& page, const std::function<bool()>& done) {
        return page.until([&] {
            view->turn(*run, {});
            return done();
        });
    }
    /// Whether the page has every robot where the run has it.
    bool sees(const Browser& page) const {
        if (page.tick() != static_cast<double>(run->tick())) return false;
        if (page.robots().size() != run->states().size()) return false;
        for (const auto& [robot, shown] : page.robots()) {
            const Vec3 at = base_pose(run->state(RobotId(robot))).p;
            const double off =
                std::max({std::abs(shown.position[0] - at.x), std::abs(shown.position[1] - at.y),
                          std::abs(shown.position[2] - at.z)});
            if (off > 2e-5) return false;
        }
        return true;
    }

    std::shared_ptr<const Model> model = carts_world(6);
    std::unique_ptr<LocalRun> run;
    std::unique_ptr<LocalView> view;
};

TEST_F(LocallyViewed, APageSeesEveryRobotWhereItIsAndTheHashStaysTheSame) {
    Browser page{ViewerUrl(view->url())};
    page.know(coordinates_of(*model));
    ASSERT_TRUE(until(page, [&] { return sees(page); }));
    EXPECT_EQ(view->pages(), 1u);
    for (int part = 0; part < 5; ++part) {
        ASSERT_TRUE(run->order(RobotId(0U), SetVelocity{{0.5, 0, 1}, {}}).ok());
        ASSERT_TRUE(run->step(20).ok());
        EXPECT_TRUE(until(page, [&] { return sees(page); })) << part;
    }
    auto alone = LocalRun::create(model).value();
    for (int part = 0; part < 5; ++part) {
        ASSERT_TRUE(alone->order(RobotId(0U), SetVelocity{{0.5, 0, 1}, {}}).ok());
        ASSERT_TRUE(alone->step(20).ok());
    }
    EXPECT_EQ(alone->hash(), run->hash());
    run->reset();
    EXPECT_TRUE(until(page, [&] { return sees(page); })) << "back at tick 0";
}

TEST_F(LocallyViewed, OrdersOfAPageTakeEffectInTheNextTickAndRefusalsSayWhy) {
    Browser page{ViewerUrl(view->url())};
    page.know(coordinates_of(*model));
    ASSERT_TRUE(until(page, [&] { return sees(page); }));
    page.send(
        {{"type", "order"}, {"id", 1}, {"robot", 2}, {"action", "pose"}, {"pose", {50, 60, 2, 1, 0, 0, 0}}});
    page.send({{"type", "order"},
               {"id", 2},
               {"robot", 2},
               {"action", "joint"},
               {"joint", 99},
               {"mode", "effort"},
               {"target", 1}});
    page.send({{"type", "control"}, {"id", 3}, {"words", {"pause"}}});
    page.send({{"type", "control"}, {"id", 4}, {"words", {"status"}}});
    ASSERT_TRUE(
        until(page, [&] { return page.answer(1) && page.answer(2) && page.answer(3) && page.answer(4); }));
    EXPECT_TRUE(page.answer(1)->starts_with("yes")) << *page.answer(1);
    EXPECT_TRUE(page.answer(2)->starts_with("no")) << *page.answer(2);
    EXPECT_NE(page.answer(3)->find("[program-steps]"), std::string::npos) << *page.answer(3);
    EXPECT_NE(page.answer(4)->find(to_hex(run->hash())), std::string::npos) << *page.answer(4);
    ASSERT_TRUE(run->step(1).ok());
    EXPECT_NEAR(base_pose(run->state(RobotId(2U))).p.x, 50, 0.1);
}

TEST_F(LocallyViewed, ARunOfAnotherModelIsShownAsAnotherScene) {
    Browser page{ViewerUrl(view->url())};
    page.know(coordinates_of(*model));
    ASSERT_TRUE(until(page, [&] { return sees(page); }));
    ASSERT_TRUE(run->step(100).ok());
    const ModelEdit edit = without_robots(*model, {model->robots[1].name}).value();
    page.know(coordinates_of(*edit.model), 2);
    run = run->edited(edit).value();
    EXPECT_TRUE(until(page, [&] { return page.scene() == 2 && sees(page); }));
    EXPECT_EQ(Json::parse(http_get(ViewerUrl(view->url()), "/scene").body)["robots"].size(),
              edit.model->robots.size());
}

TEST_F(LocallyViewed, OnlyPagesOfThisComputerMayFrameIt) {
    const std::string policy = http_get(ViewerUrl(view->url()), "/").headers.at("Content-Security-Policy");
    EXPECT_NE(policy.find("frame-ancestors http://localhost:*"), std::string::npos) << policy;
    const LiveRun run_with_roles(model, {});
    const std::string usual =
        http_get(ViewerUrl(run_with_roles.url()), "/").headers.at("Content-Security-Policy");
    EXPECT_NE(usual.find("frame-ancestors 'none'"), std::string::npos) << usual;
}

TEST_F(LocallyViewed, ThePageIsToldThatItEnds) {
    Browser page{ViewerUrl(view->url())};
    page.know(coordinates_of(*model));
    ASSERT_TRUE(until(page, [&] { return sees(page); }));
    view->say_farewell("the program has closed the view");
    view.reset();
    EXPECT_TRUE(page.until([&] { return page.closed(); }));
    ASSERT_NE(page.last("over"), nullptr);
    EXPECT_EQ((*page.last("over"))["reason"], "the program has closed the view");
}

}  // namespace
}  // namespace roboss::test
