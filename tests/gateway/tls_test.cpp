// The page over TLS: what works as without it, and what strangers at its port meet.
#include <openssl/ssl.h>

#include <chrono>
#include <thread>

#include "net/certificates.h"
#include "tls_tunnel.h"
#include "viewed.h"

namespace roboss::test {
namespace {

KeyPair made_for(const std::vector<std::string>& names) {
    return new_server_certificate(names, 1).value();
}

class OverTls : public Viewed {
  protected:
    std::unique_ptr<LiveRun> begin_encrypted(LiveRunOptions options = {}) {
        certificate = made_for({"127.0.0.1", "localhost"});
        options.certificate = certificate;
        return begin(std::move(options));
    }
    KeyPair certificate;
};

TEST_F(OverTls, ThePageItsSceneAndItsSocketAreServed) {
    const auto run = begin_encrypted();
    EXPECT_TRUE(run->url().starts_with("https://127.0.0.1:")) << run->url();
    EXPECT_EQ(run->gateway().fingerprint().size(), 3u * 32 - 1);
    for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) {
        const TlsTunnel tunnel(ViewerUrl(run->url()), {certificate.certificate, version});
        EXPECT_EQ(http_get(tunnel.url(), "/").status, 200) << tunnel.failure();
        const HttpAnswer scene = http_get(tunnel.url(), "/scene");
        EXPECT_EQ(Json::parse(scene.body)["robots"].size(), model->robots.size());
        Browser page(tunnel.url());
        ASSERT_TRUE(page.connected()) << version;
        page.know(coordinates_of(*model));
        page.send(watch({0}));
        EXPECT_TRUE(page.until([&] { return page.states() > 20 && page.last("robot") != nullptr; }));
        EXPECT_FALSE(page.damaged());
        page.send({{"type", "control"}, {"id", 1}, {"words", {"pause"}}});
        page.send({{"type", "control"}, {"id", 2}, {"words", {"resume"}}});
        ASSERT_TRUE(page.until([&] { return page.answer(1) && page.answer(2); }));
        EXPECT_TRUE(page.answer(2)->starts_with("yes")) << *page.answer(2);
        EXPECT_EQ(tunnel.failure(), "");
    }
}

TEST_F(OverTls, ATokenIsKeptInACookieThatNeverTravelsPlain) {
    LiveRunOptions options;
    options.listen = "0.0.0.0:0";
    const auto run = begin_encrypted(options);
    ViewerUrl url(run->url());
    ASSERT_EQ(url.token.size(), 32u);
    url.host = "127.0.0.1";
    const TlsTunnel tunnel(url, {certificate.certificate});
    EXPECT_EQ(http_get(tunnel.url(), "/").status, 403);
    const HttpAnswer page = http_get(tunnel.url(), "/?token=" + url.token);
    EXPECT_EQ(page.status, 200);
    EXPECT_NE(page.headers.at("Set-Cookie").find("; Secure"), std::string::npos);
}

TEST_F(OverTls, EarlierVersionsAreRefused) {
    const auto run = begin_encrypted();
    const TlsTunnel tunnel(ViewerUrl(run->url()), {certificate.certificate, TLS1_1_VERSION});
    EXPECT_EQ(http_get(tunnel.url(), "/").status, 0);
    EXPECT_NE(tunnel.failure(), "");
    EXPECT_TRUE(run->says("[tls-handshake]"));
}

TEST_F(OverTls, ABrowserThatTrustsAnotherCertificateRefusesThisOne) {
    const auto run = begin_encrypted();
    const TlsTunnel tunnel(ViewerUrl(run->url()), {made_for({"127.0.0.1"}).certificate});
    EXPECT_EQ(http_get(tunnel.url(), "/").status, 0);
    EXPECT_NE(tunnel.failure().find("certificate verify failed"), std::string::npos) << tunnel.failure();
    EXPECT_TRUE(run->says("[tls-handshake]"));
}

TEST_F(OverTls, ACertificateOfAnotherNameIsRefused) {
    LiveRunOptions options;
    options.certificate = made_for({"192.0.2.7", "lab.example"});
    const auto run = begin(options);
    const TlsTunnel tunnel(ViewerUrl(run->url()), {options.certificate->certificate});
    EXPECT_EQ(http_get(tunnel.url(), "/").status, 0);
    EXPECT_NE(tunnel.failure(), "");
}

TEST_F(OverTls, APlainCallerLearnsNothingButTheAddress) {
    const auto run = begin_encrypted();
    const ViewerUrl url(run->url());
    const HttpAnswer led = http_get(url, "/scene?x=1");
    EXPECT_EQ(led.status, 307);
    EXPECT_EQ(led.headers.at("Location"), "https://" + url.authority() + "/scene?x=1");
    EXPECT_EQ(led.body.find("robots"), std::string::npos);
    EXPECT_FALSE(Browser(url).connected());
    EXPECT_TRUE(run->says("[no-tls]"));
    EXPECT_EQ(http_raw(url, "GET / HTTP/1.1\r\n\r\n"), 400) << "without a Host nobody can be led anywhere";
    EXPECT_EQ(http_raw(url, "nonsense\r\n\r\n"), 400);
}

TEST_F(OverTls, StalledHandshakesNeverLockThePageOut) {
    const auto run = begin_encrypted();
    const ViewerUrl url(run->url());
    const TlsTunnel tunnel(url, {certificate.certificate});
    Browser watching(tunnel.url());
    ASSERT_TRUE(watching.connected());
    const std::string beginning("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11);  // of a handshake
    std::vector<std::unique_ptr<SilentSocket>> stalled;
    const auto closed = [&] {
        return std::ranges::count_if(stalled, [](const auto& socket) { return socket->closed(); });
    };
    for (int i = 0; i < 200; ++i)
        stalled.push_back(std::make_unique<SilentSocket>(url, i % 2 == 0 ? "" : beginning));
    EXPECT_EQ(http_get(tunnel.url(), "/").status, 200);
    EXPECT_TRUE(Browser(tunnel.url()).connected());
    for (int i = 0; i < 200 && closed() < 100; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_GE(closed(), 100) << "at most 64 of them wait";
    const std::uint64_t states = watching.states();
    EXPECT_TRUE(watching.until([&] { return watching.states() > states; })) << "a page that is open stays";
}

Result<std::unique_ptr<Gateway>> opened_at(const std::string& listen,
                                           const std::optional<KeyPair>& certificate = {},
                                           bool insecure = false) {
    GatewayOptions options;
    options.listen = listen;
    options.certificate = certificate;
    options.insecure = insecure;
    options.new_address = [] { return Address{}; };
    return Gateway::open(options);
}

/// "http" or "https", by which this gateway's page starts.
std::string scheme_at(const std::string& listen, bool insecure = false) {
    const auto opened = opened_at(listen, {}, insecure);
    const std::string url = opened.value()->url();
    EXPECT_EQ(opened.value()->fingerprint().empty(), url.starts_with("http:")) << url;
    return url.substr(0, url.find(':'));
}

std::string refusal_of(const std::string& listen, const KeyPair& certificate) {
    const auto opened = opened_at(listen, certificate);
    return opened ? "" : opened.error().code;
}

TEST(TlsOptions, BeyondLoopbackThePageHasACertificateOfItsOwnUnlessInsecure) {
    EXPECT_EQ(scheme_at("0.0.0.0:0"), "https");
    EXPECT_EQ(scheme_at("[::]:0"), "https");
    EXPECT_EQ(scheme_at("0.0.0.0:0", true), "http");
    EXPECT_EQ(scheme_at("127.0.0.1:0"), "http");
}

TEST(TlsOptions, WhatIsNoCertificateAndItsKeyIsRefused) {
    const KeyPair good = made_for({"lab"}), other = made_for({"lab"});
    EXPECT_EQ(refusal_of("0", KeyPair{"nonsense", good.key}), "bad-certificate");
    EXPECT_EQ(refusal_of("0", KeyPair{good.certificate, "nonsense"}), "bad-certificate");
    EXPECT_EQ(refusal_of("0", KeyPair{good.certificate, other.key}), "bad-certificate");
    EXPECT_EQ(refusal_of("0", good), "");
}

}  // namespace
}  // namespace roboss::test
