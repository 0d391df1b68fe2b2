// See camera_picture.h.
#include "gateway/camera_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mesh/image_file.h"
#include "mesh/jpeg_image.h"
#include "render/image_box.h"
#include "sensors/channel_order.h"
#include "sensors/placed_camera.h"
#include "sensors/readings.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kQuality = 82;  // of JPEG

/// The same camera at a lower resolution: at most `columns` columns; 0: the most that pages get.
CameraOptics scaled(const CameraOptics& optics, std::uint32_t columns) {
    const auto most = static_cast<int>(viewer_protocol::kPictureColumnsMax);
    const int wanted = columns == 0 ? most : std::clamp(static_cast<int>(columns), 16, most);
    if (wanted >= optics.width) return optics;
    CameraOptics small = optics;
    const double scale = static_cast<double>(wanted) / optics.width;
    small.width = wanted;
    small.height = std::max(1, static_cast<int>(std::floor(optics.height * scale + 0.5)));
    small.fx *= scale, small.fy *= scale, small.cx *= scale, small.cy *= scale, small.skew *= scale;
    return small;
}

/// JSON about the picture, and its file.
struct Packed {
    Json about;
    std::vector<std::uint8_t> bytes;
};
Result<Packed> packed(Json about, Result<std::vector<std::uint8_t>> bytes) {
    if (!bytes) return bytes.error();
    return Packed{std::move(about), std::move(bytes).value()};
}

template <class T, class Reading>
Json about(const char* shows, const Image<T>& image, const Reading& reading) {
    return {{"shows", shows},
            {"columns", image.columns},
            {"rows", image.rows},
            {"intrinsics", reading.intrinsics},
            {"distortion", reading.distortion}};
}

/// Where the camera is: x y z, then the quaternion w x y z.
Json pose_json(const Pose& X_WC) {
    return {X_WC.p.x, X_WC.p.y, X_WC.p.z, X_WC.q.w, X_WC.q.x, X_WC.q.y, X_WC.q.z};
}

template <class Reading>
Result<Packed> colours(const char* shows, const Image<std::uint8_t>& image, const Reading& reading,
                       Json more = Json::object()) {
    Json text = about(shows, image, reading);
    text.update(more);
    return packed(std::move(text),
                  encode_jpeg(image.columns, image.rows, image.channels, image.samples, kQuality));
}

/// Numbers as 256 red + green: 0 is below all, 65535 above all, and between them they go from `low` to
/// `high`.
template <class Reading>
Result<Packed> numbers(const char* shows, const char* unit, const Image<float>& image,
                       const Reading& reading) {
    constexpr double kSteps = 65533;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const float value : image.samples)
        if (std::isfinite(value))
            low = std::min(low, static_cast<double>(value)),
            high = std::max(high, static_cast<double>(value));
    if (low > high) low = high = 0;
    const double scale = high > low ? kSteps / (high - low) : 0;
    std::vector<std::uint8_t> samples;
    samples.reserve(3 * image.samples.size());
    for (const float value : image.samples) {
        unsigned count = value < 0 ? 0 : 65535;  // infinite
        if (std::isfinite(value))
            count = 1 + static_cast<unsigned>((static_cast<double>(value) - low) * scale + 0.5);
        samples.push_back(static_cast<std::uint8_t>(count >> 8));
        samples.push_back(static_cast<std::uint8_t>(count & 0xFF));
        samples.push_back(0);
    }
    Json text = about(shows, image, reading);
    text["low"] = low, text["high"] = high, text["unit"] = unit;
    return packed(std::move(text), encode_png(image.columns, image.rows, 3, samples));
}

/// Red is the label, 256 green + blue the number among those of the label.
Result<Packed> labels(const SegmentationCameraReading& reading) {
    std::vector<std::uint8_t> samples;
    samples.reserve(3 * reading.labels.samples.size());
    for (std::size_t i = 0; i < reading.labels.samples.size(); ++i) {
        const unsigned instance = reading.instances.empty() ? 0u : reading.instances.samples[i];
        samples.push_back(reading.labels.samples[i]);
        samples.push_back(static_cast<std::uint8_t>(instance >> 8));
        samples.push_back(static_cast<std::uint8_t>(instance & 0xFF));
    }
    return packed(about("labels", reading.labels, reading),
                  encode_png(reading.labels.columns, reading.labels.rows, 3, samples));
}

/// Where the eight corners of a box in space are seen; null: behind the camera.
Json corners(const render::Lens& lens, const BoxCameraReading& reading, std::size_t box) {
    const auto at = [&](const std::vector<double>& values, std::size_t per, std::size_t k) {
        return values[per * box + k];
    };
    const Vec3 centre{at(reading.positions, 3, 0), at(reading.positions, 3, 1), at(reading.positions, 3, 2)};
    const Quat q{at(reading.orientations, 4, 0), at(reading.orientations, 4, 1),
                 at(reading.orientations, 4, 2), at(reading.orientations, 4, 3)};
    const Vec3 size{at(reading.sizes, 3, 0), at(reading.sizes, 3, 1), at(reading.sizes, 3, 2)};
    Json list = Json::array();
    for (const Vec3& corner : render::corners_of({size * -0.5, size * 0.5})) {
        const auto seen = lens.project(centre + rotate(q, corner));
        list.push_back(seen ? Json{seen->first, seen->second} : Json());
    }
    return list;
}

/// Each kind of camera as its picture.
struct Photographer {
    const PictureWish& wish;
    const SensorQuery& query;

    template <class Spec>
    Result<CameraPicture> operator()(const Spec& spec) const {
        if constexpr (requires { spec.optics; }) {
            Spec camera = spec;
            camera.optics = scaled(spec.optics, wish.columns);
            const Result<PlacedCamera> placed = place_camera(camera.optics, query);
            if (!placed) return placed.error();
            const auto reading = read(camera, query);
            if (!reading) return reading.error();
            Result<Packed> picture = shown(camera, reading.value());
            if (!picture) return picture.error();
            picture.value().about["pose"] = pose_json(to_pose(placed.value().view.X_WC));
            return CameraPicture{picture.value().about.dump(), std::move(picture.value().bytes)};
        } else {
            return Error{"sensor '" + query.info().spec.name + "' is no camera", "choose a camera",
                         "no-camera"};
        }
    }

    Result<Packed> shown(const ColorCameraSpec&, const CameraReading& reading) const {
        return colours("color", red_first(reading.color), reading);
    }
    Result<Packed> shown(const DepthCameraSpec&, const DepthCameraReading& reading) const {
        return numbers("depth", "m", reading.depth, reading);
    }
    Result<Packed> shown(const RgbdCameraSpec&, const RgbdCameraReading& reading) const {
        if (wish.depth) return numbers("depth", "m", reading.depth, reading);
        return colours("color", red_first(reading.color), reading);
    }
    Result<Packed> shown(const ThermalCameraSpec&, const ThermalCameraReading& reading) const {
        return numbers("temperature", "K", reading.temperature, reading);
    }
    Result<Packed> shown(const SegmentationCameraSpec&, const SegmentationCameraReading& reading) const {
        return labels(reading);
    }
    /// The boxes, over what a colour camera sees there.
    Result<Packed> shown(const BoxCameraSpec& camera, const BoxCameraReading& reading) const {
        ColorCameraSpec eye;
        eye.optics = camera.optics;
        const Result<CameraReading> seen = read(eye, query);
        if (!seen) return seen.error();
        Json list = Json::array(), in_space = Json::array();
        for (std::size_t b = 0; 4 * b + 3 < reading.boxes.size(); ++b)
            list.push_back({reading.boxes[4 * b], reading.boxes[4 * b + 1], reading.boxes[4 * b + 2],
                            reading.boxes[4 * b + 3]});
        const render::Lens lens(camera.optics);
        for (std::size_t b = 0; 3 * b + 2 < reading.sizes.size(); ++b)
            in_space.push_back(corners(lens, reading, b));
        return colours("boxes", seen.value().color, reading,
                       {{"boxes", list}, {"corners", in_space}, {"labels", reading.labels}});
    }

    /// A page shows red as red, whatever the order in memory is.
    Image<std::uint8_t> red_first(Image<std::uint8_t> image) const {
        put_red_first(query.info().spec, image);
        return image;
    }
};

}  // namespace

bool has_camera(const Model& model, const PictureWish& wish) {
    if (wish.robot.index() >= model.robots.size()) return false;
    const std::vector<SensorInfo>& sensors = model.type_of(wish.robot).sensors;
    return wish.sensor < sensors.size() && sensors[wish.sensor].spec.kind().is_image;
}

Result<CameraPicture> take_picture(const PictureWish& wish, const SensorQuery& query) {
    return std::visit(Photographer{wish, query}, query.info().spec.parameters);
}

}  // namespace roboss
