// See visual_source.h.
#include "visuals/visual_source.h"

#include "core/float_env.h"
#include "mesh/image_file.h"
#include "render/visual_world.h"

namespace roboss {
namespace {

Result<render::Picture> decoded(const PictureSpec& spec) {
    Result<ColourImage> image = decode_picture(spec);
    if (!image) return image.error();
    return render::Picture(image.value().columns, image.value().rows, image.value().samples);
}

}  // namespace

std::shared_ptr<const render::VisualWorld> visual_world(const Scene& scene, const Model& model) {
    const ExactFloatScope exact;
    return std::make_shared<const render::VisualWorld>(scene, model, decoded);
}

std::shared_ptr<const render::VisualWorld> VisualSource::of(const Model& model) {
    const std::lock_guard lock(mutex_);
    if (last_ && last_->model_hash == model.hash) return last_;
    const ExactFloatScope exact;
    std::vector<const World*> worlds;
    for (const auto& world : worlds_) worlds.push_back(world.get());
    return last_ = visual_world(make_scene(model, worlds), model);
}

render::VisualsOf visuals_of(std::vector<std::shared_ptr<const World>> worlds) {
    auto source = std::make_shared<VisualSource>(std::move(worlds));
    return [source](const Model& model) { return source->of(model); };
}

}  // namespace roboss
