// See reading_file.h.
#include "app/output/reading_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "app/output/array_file.h"
#include "render/lens.h"
#include "sensors/channel_order.h"
#include "sensors/laser_beams.h"

namespace roboss {
namespace {

Error does_not_fit(const std::string& file, const SensorSpec& sensor, const std::string& remedy) {
    return {
        "a reading of sensor '" + sensor.name + "', " + sensor.kind().phrase + ", is not written as " + file,
        remedy, "reading-format"};
}

/// Writes the first image of a reading as PNG.
struct PngWriter {
    const std::string& file;
    Result<>& done;
    bool& found;

    void operator()(const ReadingField&, const Image<std::uint8_t>& image) const {
        if (!std::exchange(found, true)) done = write_image(file, image);
    }
    void operator()(const ReadingField& field, const Image<float>& image) const {
        if (!std::exchange(found, true)) done = write_image(file, image, field.unit);
    }
    template <class Value>
    void operator()(const ReadingField&, const Value&) const {}
};

/// Keeps the first image, or else the first list of numbers.
struct NpyWriter {
    std::string& bytes;

    template <class T>
    void operator()(const ReadingField&, const Image<T>& image) const {
        if (!bytes.empty()) return;
        std::vector<int> shape{image.rows, image.columns};
        if (image.channels > 1) shape.push_back(image.channels);
        bytes = npy(shape, image.samples);
    }
    void operator()(const ReadingField&, const std::vector<double>& values) const {
        if (bytes.empty()) bytes = npy({static_cast<int>(values.size())}, values);
    }
    template <class Value>
    void operator()(const ReadingField&, const Value&) const {}
};

/// A line of each number: name,index,value,unit.
struct CsvWriter {
    std::string& text;
    bool& is_image;

    void line(const ReadingField& field, std::size_t index, double value) const {
        text += fmt::format("{},{},{},{}\n", field.name, index, value, field.unit);
    }
    void operator()(const ReadingField& field, const Vec3& v) const {
        for (std::size_t i = 0; i < 3; ++i) line(field, i, v[i]);
    }
    void operator()(const ReadingField& field, const Quat& q) const {
        line(field, 0, q.w), line(field, 1, q.x), line(field, 2, q.y), line(field, 3, q.z);
    }
    void operator()(const ReadingField& field, const std::vector<double>& values) const {
        for (std::size_t i = 0; i < values.size(); ++i) line(field, i, values[i]);
    }
    void operator()(const ReadingField& field, const std::vector<std::string>& texts) const {
        for (std::size_t i = 0; i < texts.size(); ++i)
            text += fmt::format("{},{},\"{}\",\n", field.name, i, texts[i]);
    }
    template <class T>
    void operator()(const ReadingField&, const Image<T>& image) const {
        is_image |= !image.empty();
    }
    template <class Value>
    requires std::is_arithmetic_v<Value>
    void operator()(const ReadingField& field, Value value) const {
        line(field, 0, static_cast<double>(value));
    }
};

/// The points of a cloud, each with three coordinates and perhaps a fourth number.
class Cloud {
  public:
    /// `fourth`: the name of the fourth number, "" if there is none; `type`: F or U. `frame`: "camera's".
    Cloud(const char* frame, const char* fourth = "", const char* type = "")
        : frame_(frame), fourth_(fourth), type_(type) {}

    void add(const Vec3& p) {
        for (std::size_t k = 0; k < 3; ++k) append(static_cast<float>(p[k]));
        ++count_;
    }
    template <class Number>
    void append(Number number) {
        static_assert(sizeof number == 4);
        points_.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    /// As PCD, version 0.7.
    std::string file() const {
        const bool more = *fourth_ != '\0';
        return fmt::format(
                   "# .PCD v0.7 - points in the {} frame, m\nVERSION 0.7\nFIELDS x y z{}{}\nSIZE 4 4 4{}\n"
                   "TYPE F F F{}{}\nCOUNT 1 1 1{}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
                   "{}\nDATA binary\n",
                   frame_, more ? " " : "", fourth_, more ? " 4" : "", more ? " " : "", type_,
                   more ? " 1" : "", count_, count_) +
               points_;
    }

  private:
    const char *frame_, *fourth_, *type_;
    std::size_t count_ = 0;
    std::string points_;
};

/// What the beams met, with the intensities where there are any.
std::string pcd(const LaserReading& scan, const LaserSpec& laser) {
    const bool intensities = !scan.intensities.empty();
    Cloud cloud("laser's", intensities ? "intensity" : "", intensities ? "F" : "");
    const std::vector<Vec3> beams = laser_beams(laser);
    for (std::size_t i = 0; i < beams.size(); ++i) {
        if (!std::isfinite(scan.ranges[i])) continue;
        cloud.add(beams[i] * scan.ranges[i]);
        if (intensities) cloud.append(static_cast<float>(scan.intensities[i]));
    }
    return cloud.file();
}

std::string pcd(const Image<float>& depth, const Image<std::uint8_t>* color, const CameraOptics& optics) {
    const render::Lens lens(optics);
    const bool painted = color != nullptr;
    Cloud cloud("camera's", painted ? "rgb" : "", painted ? "U" : "");
    for (int v = 0; v < depth.rows; ++v)
        for (int u = 0; u < depth.columns; ++u) {
            const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.columns) +
                               static_cast<std::size_t>(u);
            const auto direction = lens.direction(u + 0.5, v + 0.5);
            if (!direction || !std::isfinite(depth.samples[pixel])) continue;
            cloud.add(*direction * (static_cast<double>(depth.samples[pixel]) / direction->x));
            if (color == nullptr) continue;
            const std::uint8_t* rgb = &color->samples[3 * pixel];
            const std::uint32_t packed =
                static_cast<std::uint32_t>(rgb[0]) << 16 | static_cast<std::uint32_t>(rgb[1]) << 8 | rgb[2];
            cloud.append(packed);
        }
    return cloud.file();
}
}  // namespace

Result<> write_reading(const std::string& file, Sample sample, const SensorSpec& sensor) {
    if (!file.ends_with(".npy")) put_red_first(sensor, sample);  // arrays keep the format of the camera
    if (file.ends_with(".png")) {
        Result<> done = Ok{};
        bool found = false;
        visit_fields(sample, PngWriter{file, done, found});
        return found ? done : does_not_fit(file, sensor, "give a file with the ending .csv or .npy");
    }
    if (file.ends_with(".npy")) {
        std::string bytes;
        visit_fields(sample, NpyWriter{bytes});
        return !bytes.empty() ? write_bytes(file, bytes)
                              : does_not_fit(file, sensor, "give a file with the ending .csv");
    }
    if (file.ends_with(".pcd")) {
        if (const auto* depth = std::get_if<DepthCameraReading>(&sample))
            return write_bytes(file, pcd(depth->depth, nullptr, sensor.as<DepthCameraSpec>()->optics));
        if (const auto* scan = std::get_if<LaserReading>(&sample))
            return write_bytes(file, pcd(*scan, *sensor.as<LaserSpec>()));
        const auto* both = std::get_if<RgbdCameraReading>(&sample);
        if (both == nullptr)
            return does_not_fit(file, sensor, "only depth images and scans of lasers are written as points");
        const bool rgb = both->color.channels == 3;
        return write_bytes(
            file, pcd(both->depth, rgb ? &both->color : nullptr, sensor.as<RgbdCameraSpec>()->optics));
    }
    if (!file.ends_with(".csv"))
        return does_not_fit(file, sensor, "give a file with the ending .png, .npy, .pcd or .csv");
    std::string text = "name,index,value,unit\n";
    bool is_image = false;
    visit_fields(sample, CsvWriter{text, is_image});
    return is_image ? does_not_fit(file, sensor, "give a file with the ending .png or .npy")
                    : write_bytes(file, text);
}

}  // namespace roboss
