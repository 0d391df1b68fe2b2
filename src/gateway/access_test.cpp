// Addresses, hosts, origins, tokens and rates.
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

TEST(Access, OnLoopbackHostAndOriginMustBeThisComputers) {
    const Access access("");
    EXPECT_EQ(access.refusal({"127.0.0.1:8090", "", "/", "", false}), "");
    EXPECT_EQ(access.refusal({"localhost:8090", "http://localhost:8090", "/ws", "", true}), "");
    EXPECT_EQ(access.refusal({"[::1]:8090", "http://[::1]:8090", "/ws", "", true}), "");
    EXPECT_NE(access.refusal({"rebound.example:8090", "", "/", "", false}), "");
    EXPECT_NE(access.refusal({"", "", "/", "", false}), "");
    EXPECT_NE(access.refusal({"127.0.0.1:8090", "http://127.0.0.1:9000", "/ws", "", true}), "")
        << "another port";
    EXPECT_NE(access.refusal({"127.0.0.1:8090", "null", "/ws", "", true}), "");
    EXPECT_EQ(access.refusal({"127.0.0.1:8090", "http://evil.example", "/", "", false}), "")
        << "files: the browser itself keeps them from other sites";
}

TEST(Access, ElsewhereTheTokenDecides) {
    const Access access("secret");
    EXPECT_NE(access.refusal({"lab:8090", "", "/", "", false}), "");
    EXPECT_NE(access.refusal({"lab:8090", "", "/?token=secre", "", false}), "");
    EXPECT_NE(access.refusal({"lab:8090", "", "/?nottoken=secret", "", false}), "");
    EXPECT_EQ(access.refusal({"lab:8090", "", "/?a=1&token=secret&b=2", "", false}), "");
    EXPECT_EQ(access.refusal({"lab:8090", "", "/main.js", "other=1; roboss_token=secret", false}), "");
    EXPECT_NE(access.refusal({"lab:8090", "http://evil", "/ws?token=secret", "", true}), "");
    EXPECT_EQ(access.refusal({"lab:8090", "http://lab:8090", "/ws?token=secret", "", true}), "");
}

TEST(Access, TokensAreLongAndDiffer) {
    EXPECT_EQ(random_token().size(), 32u);
    EXPECT_NE(random_token(), random_token());
}

TEST(RateLimit, LetsTheRateThroughAndNoMore) {
    RateLimit limit(200);
    int taken = 0;
    for (std::int64_t ms = 1000; ms < 11'000; ++ms)
        for (int i = 0; i < 3; ++i) taken += limit.take(ms) ? 1 : 0;
    EXPECT_NEAR(taken, 200 * 11, 10);
}

}  // namespace
}  // namespace roboss
