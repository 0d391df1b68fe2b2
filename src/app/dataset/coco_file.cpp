// See coco_file.h.
#include "app/dataset/coco_file.h"

#include <nlohmann/json.hpp>

namespace roboss {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string text_of(const OrderedJson& json) {
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace

Result<CocoFile> CocoFile::create(const std::filesystem::path& file, LabelNames labels) {
    CocoFile made;
    made.path_ = file;
    made.labels_ = std::move(labels);
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    made.out_.open(file);
    if (!(made.out_ << "{\"annotations\": ["))
        return Error{file.string() + " cannot be written", "check the folder and its permissions",
                     "not-writable"};
    return made;
}

void CocoFile::add(const ImageInfo& image, const std::vector<SeenThing>& things) {
    images_.push_back(image);
    for (const SeenThing& thing : things) {
        OrderedJson one;
        one["id"] = ++annotations_;
        one["image_id"] = images_.size();
        one["category_id"] = thing.label;
        one["bbox"] = thing.box;
        one["area"] = thing.area;
        one["iscrowd"] = 0;
        one["segmentation"] = {{"size", {image.height, image.width}}, {"counts", thing.counts}};
        one["name"] = thing.name;
        one["visible"] = thing.visible;
        out_ << (annotations_ > 1 ? ",\n" : "\n") << text_of(one);
    }
}

Result<> CocoFile::close() {
    OrderedJson rest;
    rest["images"] = OrderedJson::array();
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const ImageInfo& image = images_[i];
        rest["images"].push_back({{"id", i + 1},
                                  {"file_name", image.file},
                                  {"width", image.width},
                                  {"height", image.height},
                                  {"frame", image.frame},
                                  {"time_s", image.time_s},
                                  {"camera", image.camera}});
    }
    rest["categories"] = OrderedJson::array();
    for (const auto& [label, name] : labels_)
        rest["categories"].push_back({{"id", label}, {"name", name}, {"supercategory", "model"}});
    rest["info"] = {{"description", "made by roboss dataset"}};
    out_ << "\n], " << text_of(rest).substr(1) << "\n";
    out_.close();
    if (out_) return Ok{};
    return Error{path_.string() + " cannot be written",
                 "check the folder, its permissions and the free space", "not-writable"};
}

}  // namespace roboss
