// See model_text.h.
#include "ros2/model_text.h"

#include <array>
#include <charconv>
#include <numbers>
#include <vector>

#include "core/markup.h"
#include "xml/source_file.h"

namespace roboss::ros2 {

namespace {

constexpr std::array<std::pair<const char*, const char*>, 3> kFormats{
    {{"sdf", "sdf"}, {"robot", "urdf"}, {"mujoco", "mjcf"}}};

/// The pose of an SDF model in its file; what cannot be read is left to the run.
Pose pose_of(const xml::Element& model) {
    const xml::Element element = model.child("pose");
    std::vector<double> numbers;
    for (const std::string_view word : xml::words_of(element.node.text().get())) {
        double number = 0;
        if (std::from_chars(word.data(), word.data() + word.size(), number).ec != std::errc()) return {};
        numbers.push_back(number);
    }
    const bool by_quaternion =
        std::string_view(element.node.attribute("rotation_format").value()) == "quat_xyzw";
    if (numbers.size() != (by_quaternion ? 7u : 6u) || element.node.attribute("relative_to")) return {};
    Pose pose{{numbers[0], numbers[1], numbers[2]}, {}};
    if (by_quaternion) {
        pose.q = normalized(Quat{numbers[6], numbers[3], numbers[4], numbers[5]});
    } else {
        const double unit = element.node.attribute("degrees").as_bool() ? std::numbers::pi / 180 : 1;
        pose.q = from_rpy(numbers[3] * unit, numbers[4] * unit, numbers[5] * unit);
    }
    return is_finite(pose) ? pose : Pose{};
}

}  // namespace

Result<ModelText> read_model_text(const std::string& text) {
    Diagnostics diagnostics;
    const auto file = xml::SourceFile::from_text("model", text, {}, diagnostics);
    if (!file)
        return Error{diagnostics.items().empty() ? "it cannot be read" : to_text(diagnostics.items().front()),
                     "give SDF, URDF or MJCF", "bad-model"};
    const xml::Element root{file.get(), file->root()};
    ModelText result;
    for (const auto& [element, format] : kFormats)
        if (std::string_view(root.node.name()) == element) result.format = format;
    if (result.format != "sdf") {
        result.name = root.node.attribute(result.format == "mjcf" ? "model" : "name").value();
        return result;
    }
    const xml::Element holder = root.child("world") ? root.child("world") : root;
    const xml::Element model = holder.child("model");
    if (!model || model.node.next_sibling("model") || holder.child("include")) return result;
    result.name = model.name(), result.X_FM = pose_of(model);
    return result;
}

std::string include_of(const std::string& uri) {
    return R"(<sdf version="1.10"><world name="w"><include><uri>)" + escaped(uri) +
           "</uri></include></world></sdf>";
}

}  // namespace roboss::ros2
