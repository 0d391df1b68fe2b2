// Visuals that come over a Bus show what visuals of this process show; who gets none is told so.
#include "visuals/visual_fetch.h"

#include <gtest/gtest.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "bus/in_process_bus.h"
#include "render/camera_scene.h"
#include "render/view.h"
#include "scene/scene_codec.h"
#include "visuals/visual_source.h"
#include "wire/model_codec.h"

namespace roboss {
namespace {

std::shared_ptr<const World> garden() {
    World world;
    world.prototypes = {test::scenery(test::box_shape({2, 3, 4}, test::surface(1))), test::car()};
    GeometrySpec ball;
    ball.kind = GeometryKind::kSphere, ball.radius = 1.0 / 3;
    world.prototypes[1].links[0].visuals.push_back({"ball", ball, {}, {0.9, 0.1, 1.0 / 3}, 1});
    world.instances = {{"wall", 0, {{5, 0, 1}, {}}, {}}, {"a", 1, {{3, 0.3, 0.4}, {}}, {}}};
    return std::make_shared<const World>(std::move(world));
}

/// A Controller that only answers requests for visuals, in small parts.
struct Source {
    InProcessBus bus{};
    std::vector<std::uint8_t> bytes;
    bool silent = false;

    void answer() {
        std::vector<Envelope> inbox;
        bus.drain(kControllerAddress, inbox);
        for (const Envelope& envelope : inbox) {
            const auto* wanted = std::get_if<ModelRequest>(&envelope.message);
            if (wanted == nullptr || wanted->what != Whole::kVisuals || silent) continue;
            const std::size_t from = wanted->offset, n = std::min<std::size_t>(100, bytes.size() - from);
            const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(from);
            bus.send(kControllerAddress, envelope.from,
                     ModelPart{Whole::kVisuals,
                               hash_of_bytes(bytes),
                               bytes.size(),
                               from,
                               {first, first + static_cast<std::ptrdiff_t>(n)}});
        }
    }
    Result<std::shared_ptr<const render::VisualWorld>> fetch(const Model& model) {
        return fetched_visuals({bus,
                                [] {
                                    return Address{Role::kClient, 7};
                                },
                                [this]() -> Result<> {
                                    if (silent) return Error{"enough", "", "interrupted"};
                                    return answer(), Ok{};
                                }})(model);
    }
};

Image<std::uint8_t> image(const std::shared_ptr<const Model>& model,
                          const std::shared_ptr<const render::VisualWorld>& visuals) {
    CameraScene scene(model, visuals, 1);
    std::vector<RobotState> states;
    for (std::size_t r = 0; r < model->robots.size(); ++r)
        states.push_back(initial_state(*model, RobotId(r)));
    std::vector<const RobotState*> pointers;
    for (const RobotState& state : states) pointers.push_back(&state);
    scene.update(pointers);
    CameraOptics optics;
    optics.width = 64, optics.height = 48;
    return render::picture(scene, {{}, optics, {}});
}

TEST(VisualFetch, FetchedVisualsGiveTheImagesOfThoseOfThisProcess) {
    const auto world = garden();
    const auto model = test::compiled(*world);
    Source source;
    source.bytes = encode_scene(make_scene(*model, world.get()), *model);
    const auto fetched = source.fetch(*model);
    ASSERT_TRUE(fetched.ok()) << fetched.error().text();
    const Image<std::uint8_t> here = image(model, visuals_of({world})(*model).value());
    EXPECT_EQ(image(model, fetched.value()), here);
    EXPECT_NE(here, image(model, visuals_of({})(*model).value())) << "the image shows visuals";
}

TEST(VisualFetch, NoBytesAreAnErrorWithARemedy) {
    Source source;
    const auto fetched = source.fetch(*test::compiled(*garden()));
    ASSERT_FALSE(fetched.ok());
    EXPECT_EQ(fetched.error().code, "no-look");
    EXPECT_FALSE(fetched.error().remedy.empty());
}

TEST(VisualFetch, AFetchEndsWhenWaitingIsGivenUp) {
    Source source;
    source.silent = true;
    const auto fetched = source.fetch(*test::compiled(*garden()));
    ASSERT_FALSE(fetched.ok());
    EXPECT_EQ(fetched.error().code, "interrupted");
}

}  // namespace
}  // namespace roboss
