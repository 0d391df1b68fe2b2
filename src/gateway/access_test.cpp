// Addresses, hosts, origins and tokens.
#include "gateway/access.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

TEST(Access, ReadsAddresses) {
    EXPECT_EQ(parse_listen_address("8091").value().port, 8091);
    EXPECT_EQ(parse_listen_address("8091").value().address, "127.0.0.1");
    EXPECT_EQ(parse_listen_address("0.0.0.0:80").value().address, "0.0.0.0");
    EXPECT_EQ(parse_listen_address("[::1]:80").value().address, "::1");
    EXPECT_EQ(parse_listen_address("localhost:1").value().address, "127.0.0.1");
    for (const char* wrong : {"", "http", "70000", ":80", "1.2.3.4:", "80x", "-1"})
        EXPECT_FALSE(parse_listen_address(wrong).ok()) << wrong;
}

const std::vector<PageUser> kSecret{{"", PageRole::kWatch, token_digest("watchword")},
                                    {"", PageRole::kAdminister, token_digest("secret")}};

/// Why a page whose address bar shows `host` is refused; empty: it is not.
std::string refusal_of_page(const Access& access, std::string_view host) {
    const std::string origin = "http://" + std::string(host);
    const std::string page = access.refusal({host, "", "/", "", false, 1, 0});
    const std::string socket = access.refusal({host, origin, "/ws", "", true});
    EXPECT_EQ(page, socket);
    return socket;
}

TEST(Access, OnLoopbackTheHostIsLocalhostOrAnAddressOfLoopback) {
    const Access access(PageRole::kAdminister);
    for (const char* host : {"127.0.0.1:8090", "127.0.0.1", "127.255.0.7:1", "localhost:8090", "localhost",
                             "LocalHost:8090", "[::1]:8090", "[::1]", "[0:0:0:0:0:0:0:1]:8090"})
        EXPECT_EQ(refusal_of_page(access, host), "") << host;
}

/// A foreign site may make any name of its own resolve to this computer.
TEST(Access, ANameThatOnlyLooksLikeLoopbackIsRefused) {
    const Access access(PageRole::kAdminister);
    for (const char* host : {"127.evil.com",
                             "127.evil.com:8090",
                             "127.0.0.1.evil.com:8090",
                             "localhost.evil.com:8090",
                             "rebound.example:8090",
                             "127.0.0.1.:8090",
                             "localhost.:8090",
                             "evil.localhost:8090",
                             "127.:8090",
                             "127",
                             "127.1:8090",
                             "2130706433:8090",
                             "0x7f000001:8090",
                             "0x7f.0.0.1:8090",
                             "0177.0.0.1:8090",
                             "017700000001",
                             "127.0.0.01:8090",
                             "127.0.0.256:8090",
                             "127.0.0.1@evil.com:8090",
                             "evil.com@127.0.0.1:8090",
                             "user:word@localhost:8090",
                             "127.0.0.1:8090@evil.com",
                             "127.0.0.1,evil.com",
                             "127.0.0.1 evil.com",
                             "127.0.0.1/evil.com",
                             "127.0.0.1#evil.com",
                             "127.0.0.1\\evil.com",
                             "0.0.0.0:8090",
                             "[::]:8090",
                             "[::2]:8090",
                             "[::1].evil.com:8090",
                             "[::1]evil.com",
                             "[::1%25lo]:8090",
                             "[::1%lo]:8090",
                             "[::1",
                             "::1",
                             "::1:8090",
                             "[127.0.0.1]:8090",
                             "[localhost]:8090",
                             "[::ffff:127.0.0.1.evil.com]",
                             "[]:8090",
                             "localhost:",
                             "localhost:0",
                             "localhost:http",
                             "localhost:80:80",
                             "localhost:+80",
                             "localhost:65536",
                             ":8090",
                             ":",
                             "[",
                             "]",
                             ""})
        EXPECT_NE(refusal_of_page(access, host), "") << host;
    EXPECT_NE(refusal_of_page(access, std::string_view("127.0.0.1\0.evil.com", 19)), "");
}

TEST(Access, ARequestHasOneHost) {
    for (const Access& access : {Access(PageRole::kAdminister), Access(kSecret)}) {
        const char* target = "/?token=secret";
        EXPECT_EQ(access.refusal({"127.0.0.1:8090", "", target, "", false, 1, 0}), "");
        EXPECT_NE(access.refusal({"", "", target, "", false, 0, 0}), "") << "no Host";
        EXPECT_NE(access.refusal({"127.0.0.1:8090", "", target, "", false, 2, 0}), "") << "two Hosts";
    }
}

TEST(Access, AWebSocketIsForThePageOfThisServerOnly) {
    const Access access(PageRole::kAdminister);
    const char* host = "127.0.0.1:8090";
    EXPECT_EQ(access.refusal({host, "http://127.0.0.1:8090", "/ws", "", true}), "");
    EXPECT_EQ(access.refusal({host, "https://127.0.0.1:8090", "/ws", "", true}), "") << "a proxy's TLS";
    for (const char* origin :
         {"http://127.0.0.1:9000", "http://localhost:8090", "http://127.0.0.1", "http://evil.example", "null",
          "127.0.0.1:8090", "http://", "file://127.0.0.1:8090", "http://127.0.0.1:8090.evil.com",
          "http://127.0.0.1:8090@evil.com", "http://evil.com@127.0.0.1:8090", "http://127.0.0.1:8090/", ""})
        EXPECT_NE(access.refusal({host, origin, "/ws", "", true}), "") << origin;
    EXPECT_NE(access.refusal({host, "", "/ws", "", true, 1, 0}), "") << "no Origin";
    EXPECT_EQ(access.refusal({host, "http://127.0.0.1:8090", "/ws", "", true}), "");
    EXPECT_NE(access.refusal({host, "http://127.0.0.1:8090", "/ws", "", true, 1, 1, true}), "") << "over TLS";
    EXPECT_EQ(access.refusal({host, "https://127.0.0.1:8090", "/ws", "", true, 1, 1, true}), "");
    EXPECT_NE(access.refusal({host, "http://127.0.0.1:8090", "/ws", "", true, 1, 2}), "") << "two Origins";
    EXPECT_EQ(access.refusal({host, "http://evil.example", "/", "", false}), "")
        << "files: the browser itself keeps them from other sites";
}

TEST(Access, ElsewhereTheTokenDecides) {
    const Access access(kSecret);
    EXPECT_NE(access.refusal({"lab:8090", "", "/", "", false}), "");
    EXPECT_NE(access.refusal({"lab:8090", "", "/?token=secre", "", false}), "");
    EXPECT_NE(access.refusal({"lab:8090", "", "/?nottoken=secret", "", false}), "");
    EXPECT_EQ(access.refusal({"lab:8090", "", "/?a=1&token=secret&b=2", "", false}), "");
    EXPECT_EQ(access.refusal({"lab:8090", "", "/main.js", "other=1; roboss_token=secret", false}), "");
    EXPECT_NE(access.refusal({"lab:8090", "http://evil", "/ws?token=secret", "", true}), "");
    EXPECT_EQ(access.refusal({"lab:8090", "http://lab:8090", "/ws?token=secret", "", true}), "");
}

/// The role that a visitor has; none: it may not come in.
std::optional<PageRole> role_of(const Access& access, const char* target, const char* cookie = "") {
    const std::optional<PageUser> user = access.user_of({"lab:8090", "", target, cookie, false});
    return user ? std::optional(user->role) : std::nullopt;
}

TEST(Access, ATokenGivesItsRole) {
    const Access access(kSecret);
    EXPECT_EQ(role_of(access, "/?token=watchword"), PageRole::kWatch);
    EXPECT_EQ(role_of(access, "/?token=secret"), PageRole::kAdminister);
    EXPECT_EQ(role_of(access, "/", "roboss_token=secret"), PageRole::kAdminister);
    EXPECT_EQ(role_of(access, "/?token=watchword", "roboss_token=secret"), PageRole::kWatch)
        << "the address counts more than what the browser kept";
    EXPECT_EQ(role_of(access, "/?token="), std::nullopt);
    EXPECT_EQ(role_of(access, "/"), std::nullopt);
    EXPECT_EQ(role_of(Access(PageRole::kSteer), "/"), PageRole::kSteer);
    EXPECT_EQ(role_of(Access(std::vector<PageUser>{{"ann", PageRole::kSteer, ""}}), "/?token="), std::nullopt)
        << "an empty digest is of no token";
}

TEST(Access, ADigestIsNoToken) {
    const Access access(kSecret);
    EXPECT_EQ(token_digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(role_of(access, ("/?token=" + token_digest("secret")).c_str()), std::nullopt);
}

TEST(Access, AFormerUserIsRefusedByName) {
    const PageUser ann{"ann", PageRole::kSteer, token_digest("a")},
        ben{"ben", PageRole::kWatch, token_digest("b")};
    Access access(std::vector{ann, ben});
    EXPECT_FALSE(access.set_users({ann, ben})) << "nothing has changed";
    EXPECT_EQ(access.user_of({"lab", "", "/?token=a", "", false}), ann);
    EXPECT_TRUE(access.set_users({ben}));
    EXPECT_EQ(role_of(access, "/?token=a"), std::nullopt);
    for (const Visitor& visitor : {Visitor{"lab", "", "/?token=a", "", false, 1, 0},
                                   Visitor{"lab", "", "/", "roboss_token=a", false, 1, 0}})
        EXPECT_EQ(access.refusal(visitor), "the token of ann was revoked [revoked-token]");
    EXPECT_EQ(access.withdrawal(ann), "the token of ann was revoked");
    EXPECT_EQ(access.withdrawal(ben), "");
    PageUser less = ben;
    less.role = PageRole::kAdminister;
    EXPECT_TRUE(access.set_users({less, ann}));
    EXPECT_EQ(access.withdrawal(ben), "the rights of ben were changed");
    EXPECT_EQ(role_of(access, "/?token=a"), PageRole::kSteer) << "ann is back";
}

TEST(Access, TokensAreLongAndDiffer) {
    EXPECT_EQ(random_token().size(), 32u);
    EXPECT_NE(random_token(), random_token());
}

}  // namespace
}  // namespace roboss
