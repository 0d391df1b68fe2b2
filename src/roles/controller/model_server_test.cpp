// The Model and the scene arrive whole, part by part, and the scene is made only when somebody asks for it.
#include "roles/controller/model_server.h"

#include <gtest/gtest.h>

#include <numeric>

#include "bus/in_process_bus.h"
#include "roles/controller/controller.h"
#include "wire/model_codec.h"

namespace roboss {
namespace {

std::shared_ptr<const Model> empty_model(std::uint64_t hash) {
    auto model = std::make_shared<Model>();
    model->hash = hash;
    return model;
}

std::vector<std::uint8_t> fetch(ModelServer& server, Whole what) {
    std::vector<std::uint8_t> bytes;
    for (;;) {
        const ModelPart part = server.part({what, bytes.size()});
        EXPECT_EQ(part.offset, bytes.size());
        bytes.insert(bytes.end(), part.bytes.begin(), part.bytes.end());
        if (part.bytes.empty() || bytes.size() >= part.total) {
            EXPECT_EQ(bytes.size(), part.total);
            EXPECT_EQ(hash_of_bytes(bytes), part.bytes_hash);
            return bytes;
        }
    }
}

TEST(ModelServer, ServesASceneOfSeveralPartsAndMakesItOnce) {
    std::vector<std::uint8_t> scene((1u << 21) + 12'345);
    std::iota(scene.begin(), scene.end(), std::uint8_t{0});
    int made = 0;
    ModelServer server(empty_model(1), [&](const Model&) { return ++made, scene; }, nullptr, {});
    EXPECT_EQ(fetch(server, Whole::kModel), encode_model(*empty_model(1)));
    EXPECT_EQ(made, 0) << "nobody asked for the scene";
    EXPECT_EQ(fetch(server, Whole::kScene), scene);
    EXPECT_EQ(fetch(server, Whole::kScene), scene);
    EXPECT_EQ(made, 1);
}

TEST(ModelServer, AnswersARequestBeyondTheEndWithAnEmptyPart) {
    ModelServer server(empty_model(1), nullptr, nullptr, {});
    EXPECT_EQ(server.part({Whole::kScene, 0}).total, 0u) << "no scene";
    const ModelPart part = server.part({Whole::kModel, ~std::uint64_t{0}});
    EXPECT_TRUE(part.bytes.empty());
    EXPECT_EQ(part.offset, part.total);
}

TEST(ModelServer, KnowsEarlierModelsAndNeverTakesTheCurrentOneForEarlier) {
    const ModelServer server(empty_model(7), nullptr, nullptr, {5, 7});
    EXPECT_TRUE(server.is_earlier(5));
    EXPECT_FALSE(server.is_earlier(7)) << "an earlier Model of the run is the current one again";
    EXPECT_FALSE(server.is_earlier(6));
    EXPECT_EQ(server.hashes(), (std::vector<std::uint64_t>{5, 7})) << "each once, however often it came back";
}

/// Messages to a Controller and its replies, without other roles.
TEST(ModelServer, SendsMembersOfAnEarlierModelToTheCurrentOneAndRefusesOthers) {
    InProcessBus bus;
    ControllerOptions options;
    options.before.models = {5};
    Controller controller(empty_model(7), options, {});
    const Address simulator{Role::kSimulator, 1};
    const auto reply_to = [&](Message message) {
        bus.send(simulator, kControllerAddress, std::move(message));
        controller.advance(bus);
        std::vector<Envelope> inbox;
        bus.drain(simulator, inbox);
        EXPECT_FALSE(inbox.empty());
        return inbox.empty() ? Message{} : inbox.front().message;
    };
    Hello hello;
    hello.model_hash = 5;
    const Message changed = reply_to(hello);
    ASSERT_TRUE(std::holds_alternative<ModelChanged>(changed));
    EXPECT_EQ(std::get<ModelChanged>(changed).model_hash, 7u);
    hello.model_hash = 6;
    EXPECT_TRUE(std::holds_alternative<Refused>(reply_to(hello)));
    const Message part = reply_to(ModelRequest{Whole::kModel, 0});
    ASSERT_TRUE(std::holds_alternative<ModelPart>(part));
    EXPECT_EQ(std::get<ModelPart>(part).bytes, encode_model(*empty_model(7)));
    hello.model_hash = 7;
    EXPECT_TRUE(std::holds_alternative<Welcome>(reply_to(hello)));
}

}  // namespace
}  // namespace roboss
