// Samples in the layout of KITTI's object detection benchmark (Geiger et al. 2012, "Are we ready for
// autonomous driving?"; devkit_object/readme.txt): training/image_2, label_2, calib, velodyne.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/dataset/labels.h"
#include "app/dataset/seen_things.h"

namespace roboss {

/// A scan of a lidar, and its place.
struct KittiScan {
    const LaserSpec* spec = nullptr;
    const LaserReading* reading = nullptr;
    Transform X_WL;  // lidar in the world
};

/// One image of a camera and what belongs to it.
struct KittiSample {
    const Image<std::uint8_t>* color = nullptr;
    const CameraOptics* optics = nullptr;
    Transform X_WC;  // camera in the world, x ahead, z up
    Transform X_WB;  // base of the robot in the world: KITTI's IMU
    std::vector<SeenThing> things;
    std::optional<KittiScan> scan;
};

class KittiFiles {
  public:
    KittiFiles(std::filesystem::path folder, LabelNames labels)
        : folder_(std::move(folder)), labels_(std::move(labels)) {}

    /// Writes the files of the next sample. Errors: one cannot be written.
    Result<> write(const KittiSample& sample);
    int samples() const { return samples_; }

  private:
    std::filesystem::path file(const char* kind, const char* ending) const;

    std::filesystem::path folder_;
    LabelNames labels_;
    int samples_ = 0;
};

/// A line of label_2, without its end: type, truncation, occlusion, alpha, box in the image, height, width,
/// length, location and rotation_y in KITTI's camera frame (x right, y down, z ahead).
std::string kitti_label(const SeenThing& thing, const std::string& type, const CameraOptics& optics);

/// The text of a file of calib.
std::string kitti_calibration(const KittiSample& sample);

}  // namespace roboss
