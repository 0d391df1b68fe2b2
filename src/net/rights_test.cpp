// Rights are part of a Client's certificate, come with each of its messages, and cannot be changed by who
// holds the key; a Client sends what Clients send.
#include <gtest/gtest.h>

#include <support/test_keys.h>
#include <algorithm>

#include "net/key_folder.h"
#include "net/openssl.h"

namespace roboss {
namespace {

using test::becomes, test::controller_of, test::expect_refused, test::Keys, test::loopback, test::member_of,
    test::receive, test::with_keys;

const Address kPilot{Role::kClient, 1}, kOther{Role::kClient, 2}, kSimulator{Role::kSimulator, 3};

Rights of_car_1() {
    return make_rights({"car_1"}, {"force"}, false).value();
}

TEST(ClientRights, SurviveTheCertificate) {
    const Keys keys;
    Rights rights = make_rights({"car_*", "spider"}, {"force", "actuators"}, true).value();
    keys.of("pilot", Seat::kClient, "ring", 1, rights);
    keys.of("free", Seat::kClient);
    const std::vector<Holder> holders = keys.ring().holders().value();
    ASSERT_EQ(holders.size(), 2u);
    EXPECT_TRUE(holders[0].rights.everything());
    rights.key = "pilot";
    EXPECT_EQ(holders[1].rights, rights);
}

TEST(ClientRights, OfSimulatorsAndControllersCannotBeLimited) {
    const Keys keys;
    for (const Seat seat : {Seat::kController, Seat::kSimulator, Seat::kMember}) {
        const Result<> added = keys.ring().add("x", seat, 1, of_car_1());
        ASSERT_FALSE(added.ok());
        EXPECT_EQ(added.error().code, "bad-rights");
    }
}

TEST(ClientRights, ComeWithEachMessageToTheController) {
    const Keys keys;
    const NetOptions options = loopback("rights");
    const auto controller = controller_of(with_keys(options, keys.of("boss", Seat::kController)));
    const auto pilot =
        member_of(with_keys(options, keys.of("pilot", Seat::kClient, "ring", 1, of_car_1())), kPilot);
    const auto other = member_of(with_keys(options, keys.of("other", Seat::kClient)), kOther);
    for (const auto& [bus, address] : {std::pair{&*pilot, kPilot}, std::pair{&*other, kOther}}) {
        ASSERT_TRUE(becomes([&, b = bus] { return b->present(kControllerAddress); }));
        bus->send(address, kControllerAddress, ControlRequest{1, PauseRun{}});
        const std::vector<Envelope> got = receive(*controller, kControllerAddress, 1);
        ASSERT_EQ(got.size(), 1u);
        if (address == kOther) {
            EXPECT_EQ(got[0].rights, nullptr) << "nothing is limited";
            continue;
        }
        ASSERT_NE(got[0].rights, nullptr);
        EXPECT_EQ(got[0].rights->key, "pilot");
        EXPECT_EQ(rights_text(*got[0].rights), rights_text(of_car_1()));
    }
}

/// The certificate with these bytes changed; its signature stays.
std::string changed(const std::string& pem, const std::string& from, const std::string& to) {
    const openssl::Certificate certificate = openssl::certificate_of(pem);
    unsigned char* bytes = nullptr;
    const int count = i2d_X509(certificate.get(), &bytes);
    const auto at = std::search(bytes, bytes + count, from.begin(), from.end());
    EXPECT_NE(at, bytes + count);
    std::copy(to.begin(), to.end(), at);
    const unsigned char* read = bytes;
    const openssl::Certificate other(d2i_X509(nullptr, &read, count));
    OPENSSL_free(bytes);
    const openssl::Bio out(BIO_new(BIO_s_mem()));
    EXPECT_EQ(PEM_write_bio_X509(out.get(), other.get()), 1);
    char* text = nullptr;
    const long length = BIO_get_mem_data(out.get(), &text);
    return std::string(text, static_cast<std::size_t>(length));
}

TEST(ClientRights, ThatTheHolderHasChangedAreRefused) {
    const Keys keys;
    const NetOptions options = loopback("forged");
    const auto controller = controller_of(with_keys(options, keys.of("boss", Seat::kController)));
    const std::string folder = keys.of("pilot", Seat::kClient, "ring", 1, of_car_1());
    const std::string file = folder + "/member.crt";
    ASSERT_TRUE(write_private(file, changed(read_text(file).value(), "robots=car_1", "robots=car_*")).ok());
    EXPECT_EQ(keys.ring().holders().value()[1].rights.robots, std::vector<std::string>{"car_*"});
    const auto pilot = member_of(with_keys(options, folder), kPilot);
    expect_refused(*controller, *pilot, "bad-certificate",
                   "the certificate of 'pilot' was not made by the authority of this run");
}

TEST(ClientRights, ThatCannotBeReadAreRefused) {
    const Keys keys;
    const std::string file = keys.of("pilot", Seat::kClient, "ring", 1, of_car_1()) + "/member.crt";
    const Result<Holder> holder = holder_of(changed(read_text(file).value(), "robots=", "rabots="));
    ASSERT_FALSE(holder.ok());
    EXPECT_EQ(holder.error().code, "bad-rights");
}

TEST(ClientRights, DoNotLetItActForTheControllerOrASimulator) {
    const Keys keys;
    for (const Message& message : {Message(Assignment{}), Message(StateReply{}), Message(OrdersAhead{})}) {
        const NetOptions options = loopback("acts-" + std::to_string(message.index()));
        const auto controller = controller_of(with_keys(options, keys.of("boss", Seat::kController)));
        const auto simulator = member_of(with_keys(options, keys.of("sim", Seat::kSimulator)), kSimulator);
        const auto pilot = member_of(with_keys(options, keys.of("pilot", Seat::kClient)), kPilot);
        ASSERT_TRUE(becomes([&] { return controller->present(kSimulator) && controller->present(kPilot); }));
        pilot->send(kPilot, kSimulator, message);
        expect_refused(*controller, *pilot, "misbehaves", "a message that no Client sends");
        controller->send(kControllerAddress, kSimulator, Heartbeat{});
        const std::vector<Envelope> got = receive(*simulator, kSimulator, 1);
        ASSERT_EQ(got.size(), 1u);
        EXPECT_EQ(got[0].from, kControllerAddress);
    }
}

}  // namespace
}  // namespace roboss
