// Users of the page: three rights by their own tokens, over TLS, and what happens when they change.
#include <mutex>

#include "gateway/access.h"
#include "net/certificates.h"
#include "tls_tunnel.h"
#include "viewed.h"

namespace roboss::test {
namespace {

/// A list of users that changes while the run lasts.
class UserList {
  public:
    std::function<Result<std::vector<PageUser>>()> reader() {
        return [this]() -> Result<std::vector<PageUser>> {
            const std::scoped_lock lock(mutex_);
            if (broken_) return Error{"the file is broken", "", "bad-users"};
            return users_;
        };
    }
    void add(const std::string& name, PageRole role) {
        const std::scoped_lock lock(mutex_);
        users_.push_back({name, role, token_digest("token-of-" + name)});
    }
    void remove(const std::string& name) {
        const std::scoped_lock lock(mutex_);
        std::erase_if(users_, [&](const PageUser& user) { return user.name == name; });
    }
    void change(const std::string& name, PageRole role) {
        const std::scoped_lock lock(mutex_);
        std::ranges::find(users_, name, &PageUser::name)->role = role;
    }
    void set_broken(bool broken) {
        const std::scoped_lock lock(mutex_);
        broken_ = broken;
    }

  private:
    std::mutex mutex_;
    std::vector<PageUser> users_;
    bool broken_ = false;
};

class Users : public Viewed {
  protected:
    void SetUp() override {
        list.add("ann", PageRole::kWatch);
        list.add("ben", PageRole::kSteer);
        list.add("cy", PageRole::kAdminister);
    }
    LiveRunOptions options() {
        LiveRunOptions options;
        options.users = list.reader();
        return options;
    }
    /// The page of a user at a gateway.
    static std::unique_ptr<Browser> page_of(const std::string& name, const ViewerUrl& url) {
        return std::make_unique<Browser>(url, SocketHeaders{"/ws?token=token-of-" + name, "", ""});
    }
    UserList list;
};

/// The reply to these words of `roboss control`.
std::string reply(Browser& page, int id, const std::vector<std::string>& words) {
    page.send({{"type", "control"}, {"id", id}, {"words", words}});
    page.until([&] { return page.answer(id).has_value(); });
    return page.answer(id).value_or("nothing");
}

TEST_F(Users, HaveThreeRightsOverTls) {
    LiveRunOptions with_tls = options();
    const KeyPair made = new_server_certificate({"127.0.0.1"}, 1).value();
    with_tls.certificate = made;
    const auto run = begin(with_tls);
    EXPECT_EQ(run->url().find("token"), std::string::npos) << "the run has no tokens of its own";
    EXPECT_TRUE(run->gateway().other_urls().empty());
    const TlsTunnel tunnel(ViewerUrl(run->url()), {made.certificate});
    EXPECT_EQ(http_get(tunnel.url(), "/").status, 403) << "also on loopback";
    EXPECT_FALSE(page_of("mallory", tunnel.url())->connected());

    const auto ann = page_of("ann", tunnel.url());
    ASSERT_TRUE(ann->connected());
    EXPECT_TRUE(run->says("of ann at 127.0.0.1 is open; it may watch"));
    EXPECT_TRUE(reply(*ann, 1, {"status"}).starts_with("yes"));
    EXPECT_NE(reply(*ann, 2, {"pause"}).find("[not-permitted]"), std::string::npos);
    EXPECT_TRUE(run->says("of ann at 127.0.0.1 is refused"));

    const auto ben = page_of("ben", tunnel.url());
    EXPECT_TRUE(reply(*ben, 1, {"pause"}).starts_with("yes"));
    EXPECT_NE(reply(*ben, 2, {"quit"}).find("[not-permitted]"), std::string::npos);
    ASSERT_TRUE(ann->until([&] { return !(*ann->last("roles"))["holder"].is_null(); }));
    EXPECT_EQ((*ann->last("roles"))["holder"]["user"], "ben");

    const auto cy = page_of("cy", tunnel.url());
    EXPECT_NE(reply(*cy, 1, {"quit"}).find("page 2 of ben at 127.0.0.1 has control"), std::string::npos);
    cy->send({{"type", "ask"}, {"id", 2}});
    ASSERT_TRUE(cy->until([&] { return cy->answer(2).has_value(); }));
    const std::string quit = reply(*cy, 3, {"quit"});
    EXPECT_NE(quit.find("[refused]"), std::string::npos)
        << "by this test's run, not by the gateway: " << quit;
}

TEST_F(Users, OneWhoIsRevokedIsCutOffByNameAndTheOthersStay) {
    const auto run = begin(options());
    const ViewerUrl url(run->url());
    const auto ann = page_of("ann", url), ben = page_of("ben", url);
    ASSERT_TRUE(ann->connected() && ben->connected());
    list.remove("ben");
    ASSERT_TRUE(ben->until([&] { return ben->closed(); }));
    EXPECT_EQ(ben->reason(), "revoked: the token of ben was revoked");
    EXPECT_TRUE(run->says("of ben at 127.0.0.1: the token of ben was revoked [revoked]"));
    const HttpAnswer refused = http_get(url, "/?token=token-of-ben");
    EXPECT_EQ(refused.status, 403);
    EXPECT_NE(refused.body.find("the token of ben was revoked [revoked-token]"), std::string::npos)
        << refused.body;
    EXPECT_FALSE(page_of("ben", url)->connected());
    EXPECT_TRUE(run->says("is refused: the token of ben was revoked [revoked-token]"));
    const std::uint64_t states = ann->states();
    EXPECT_TRUE(ann->until([&] { return ann->states() > states; }));
}

TEST_F(Users, OneWhoIsAddedMayComeAndOneWhoseRightChangesComesAgain) {
    const auto run = begin(options());
    const ViewerUrl url(run->url());
    EXPECT_FALSE(page_of("dan", url)->connected());
    list.add("dan", PageRole::kSteer);
    std::unique_ptr<Browser> dan;
    for (int i = 0; i < 100 && (!dan || !dan->connected()); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        dan = page_of("dan", url);
    }
    ASSERT_TRUE(dan->connected());
    list.change("dan", PageRole::kWatch);
    ASSERT_TRUE(dan->until([&] { return dan->closed(); }));
    EXPECT_TRUE(run->says("the rights of dan were changed"));
    dan = page_of("dan", url);
    ASSERT_TRUE(dan->until([&] { return dan->last("roles") != nullptr; }));
    EXPECT_EQ((*dan->last("roles"))["role"], "watch");
}

TEST_F(Users, StayAsTheyWereWhileTheirFileIsBroken) {
    const auto run = begin(options());
    const ViewerUrl url(run->url());
    const auto ann = page_of("ann", url);
    list.set_broken(true);
    list.remove("ann");
    EXPECT_TRUE(run->says("the users of the page stay as they were: the file is broken"));
    EXPECT_TRUE(page_of("ben", url)->connected());
    EXPECT_FALSE(ann->closed());
    list.set_broken(false);
    EXPECT_TRUE(ann->until([&] { return ann->closed(); }));
}

TEST_F(Users, NobodyGetsMoreThanTheRunAllows) {
    LiveRunOptions limited = options();
    limited.role = PageRole::kSteer;
    const auto run = begin(limited);
    const auto cy = page_of("cy", ViewerUrl(run->url()));
    EXPECT_NE(reply(*cy, 1, {"quit"}).find("[not-permitted]"), std::string::npos);
    EXPECT_TRUE(reply(*cy, 2, {"pause"}).starts_with("yes"));
}

}  // namespace
}  // namespace roboss::test
