// See local_view.h.
#include "local_view/local_view.h"

#include <random>

#include "core/float_env.h"
#include "gateway/gateway.h"
#include "local_view/stand_in.h"
#include "scene/scene_codec.h"
#include "scene/scene_file.h"

namespace roboss {

namespace {

constexpr std::int64_t kTurn_ms = 10;  // least time between two turns

Address any_address() {
    std::random_device device;
    return {Role::kClient, static_cast<std::uint64_t>(device()) << 32 | device()};
}

Scene scene_of(const Model& model, const Looks& looks) {
    std::vector<const World*> worlds;
    for (const auto& world : looks) worlds.push_back(world.get());
    return make_scene(model, worlds);
}

}  // namespace

struct LocalView::Parts {
    std::unique_ptr<Gateway> gateway;
    InProcessBus bus{};
    std::optional<StandIn> stand_in{};
    std::int64_t turned_ms = 0;  // when the last turn was
};

Result<std::unique_ptr<LocalView>> LocalView::open(const LocalViewOptions& options) {
    GatewayOptions wanted;
    wanted.insecure = options.insecure;
    wanted.listen = options.listen;
    wanted.page_folder = options.page_folder;
    wanted.role = options.role;
    wanted.program = options.program;
    wanted.framed = true;
    wanted.new_address = &any_address;
    Result<std::unique_ptr<Gateway>> gateway = Gateway::open(wanted);
    if (!gateway) return gateway.error();
    return std::unique_ptr<LocalView>(
        new LocalView(std::make_unique<Parts>(Parts{std::move(gateway).value()})));
}

LocalView::LocalView(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
LocalView::~LocalView() = default;

const std::string& LocalView::url() const {
    return parts_->gateway->url();
}

const std::string& LocalView::fingerprint() const {
    return parts_->gateway->fingerprint();
}

void LocalView::turn(LocalRun& run, const Looks& looks) {
    Parts& p = *parts_;
    const std::int64_t now = p.bus.now_ms();
    if (now - p.turned_ms < kTurn_ms) return;
    p.turned_ms = now;
    if (!p.stand_in || p.stand_in->model().hash != run.model().hash) {
        const std::vector<Address> viewers = p.stand_in ? p.stand_in->viewers() : std::vector<Address>{};
        p.stand_in.emplace(
            run.shared_model(),
            [looks, seed = run.seed()](const Model& model) {
                return encode(scene_file(scene_of(model, looks), model, seed));
            },
            [looks](const Model& model) {
                const ExactFloatScope exact;
                return encode_scene(scene_of(model, looks), model);
            });
        for (const Address& viewer : viewers)
            p.bus.send(kControllerAddress, viewer, ModelChanged{run.model().hash});
    }
    p.gateway->advance(p.bus);
    p.stand_in->advance(p.bus, run);
    p.gateway->advance(p.bus);
}

std::size_t LocalView::pages() const {
    return parts_->gateway->load().pages;
}

std::vector<std::string> LocalView::take_notices() {
    return parts_->gateway->take_notices();
}

void LocalView::say_farewell(const std::string& reason) {
    parts_->gateway->say_farewell({reason});
}

}  // namespace roboss
