// See kitti_files.h.
#include "app/dataset/kitti_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/dataset/reading_files.h"
#include "app/output/array_file.h"
#include "render/lens.h"
#include "sensors/laser_beams.h"

namespace roboss {
namespace {

/// From x ahead, y left, z up to KITTI's camera: x right, y down, z ahead.
Vec3 to_kitti(const Vec3& p) {
    return {-p.y, -p.z, p.x};
}

/// Rows of [R p] as text, row by row.
std::string rows_of(const std::array<Vec3, 3>& columns, const Vec3& p) {
    std::string text;
    for (std::size_t r = 0; r < 3; ++r)
        text += fmt::format(" {:.12e} {:.12e} {:.12e} {:.12e}", columns[0][r], columns[1][r], columns[2][r],
                            p[r]);
    return text;
}

Vec3 column(const Mat3& R, std::size_t c) {
    return {R(0, c), R(1, c), R(2, c)};
}

/// How much of the thing other things hide, in KITTI's steps: 0 nearly nothing, 1 a part, 2 most of it.
int occlusion(const SeenThing& thing) {
    constexpr double kWhole = 0.9, kHalf = 0.5;
    return thing.visible >= kWhole ? 0 : thing.visible >= kHalf ? 1 : 2;
}

/// x, y, z and intensity of each beam that met something, 32 bits each.
std::string velodyne(const KittiScan& scan) {
    const std::vector<Vec3> beams = laser_beams(*scan.spec);
    const LaserReading& reading = *scan.reading;
    std::string bytes;
    for (std::size_t i = 0; i < beams.size(); ++i) {
        if (!std::isfinite(reading.ranges[i])) continue;
        const Vec3 p = beams[i] * reading.ranges[i];
        const std::array<float, 4> point{
            static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
            reading.intensities.empty() ? 0.0F : static_cast<float>(reading.intensities[i])};
        bytes.append(reinterpret_cast<const char*>(point.data()), sizeof point);
    }
    return bytes;
}

}  // namespace

std::string kitti_label(const SeenThing& thing, const std::string& type, const CameraOptics& optics) {
    const Transform X_CB = to_transform(thing.X_CB);
    const Vec3 ahead = to_kitti(column(X_CB.R, 0));
    const Vec3 bottom = to_kitti(X_CB * Vec3{0, 0, -0.5 * thing.size.z});
    const double rotation_y = std::atan2(-ahead.z, ahead.x);
    const double alpha = std::remainder(rotation_y - std::atan2(bottom.x, bottom.z), 2 * M_PI);
    return fmt::format(
        "{} {:.2f} {} {:.4f} {:.2f} {:.2f} {:.2f} {:.2f} {:.3f} {:.3f} {:.3f} {:.4f} {:.4f} {:.4f} {:.4f}",
        type, truncation(thing, optics), occlusion(thing), alpha, static_cast<double>(thing.box[0]),
        static_cast<double>(thing.box[1]), static_cast<double>(thing.box[0] + thing.box[2]),
        static_cast<double>(thing.box[1] + thing.box[3]), thing.size.z, thing.size.y, thing.size.x, bottom.x,
        bottom.y, bottom.z, rotation_y);
}

std::string kitti_calibration(const KittiSample& sample) {
    const render::Lens lens(*sample.optics);
    const std::string camera =
        rows_of({Vec3{lens.fx(), 0, 0}, Vec3{0, lens.fy(), 0}, Vec3{lens.cx(), lens.cy(), 1}}, Vec3{});
    const Transform X_WL = sample.scan ? sample.scan->X_WL : sample.X_WB;
    const Transform X_CL = inverse(sample.X_WC) * X_WL, X_LB = inverse(X_WL) * sample.X_WB;
    std::string text;
    for (int k = 0; k < 4; ++k) text += fmt::format("P{}:{}\n", k, camera);
    text += "R0_rect: 1 0 0 0 1 0 0 0 1\n";
    text += "Tr_velo_to_cam:" +
            rows_of({to_kitti(column(X_CL.R, 0)), to_kitti(column(X_CL.R, 1)), to_kitti(column(X_CL.R, 2))},
                    to_kitti(X_CL.p)) +
            "\n";
    text +=
        "Tr_imu_to_velo:" + rows_of({column(X_LB.R, 0), column(X_LB.R, 1), column(X_LB.R, 2)}, X_LB.p) + "\n";
    return text;
}

std::filesystem::path KittiFiles::file(const char* kind, const char* ending) const {
    const std::filesystem::path folder = folder_ / "training" / kind;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    return folder / (frame_name(samples_) + ending);
}

Result<> KittiFiles::write(const KittiSample& sample) {
    std::string labels;
    for (const SeenThing& thing : sample.things) {
        const auto name = labels_.find(thing.label);
        std::string type = name != labels_.end() ? name->second : fmt::format("label_{}", thing.label);
        std::replace(type.begin(), type.end(), ' ', '_');
        labels += kitti_label(thing, type, *sample.optics) + "\n";
    }
    Result<> done = write_image(file("image_2", ".png").string(), *sample.color);
    const auto add = [&](const char* kind, const char* ending, const std::string& bytes) {
        if (done) done = write_bytes(file(kind, ending).string(), bytes);
    };
    add("label_2", ".txt", labels);
    add("calib", ".txt", kitti_calibration(sample));
    if (sample.scan) add("velodyne", ".bin", velodyne(*sample.scan));
    ++samples_;
    return done;
}

}  // namespace roboss
