// Dataset: readings of sensors and the truth behind them at regular times of a run, for the training and test
// of perception.
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/dataset/coco_file.h"
#include "app/dataset/dataset_options.h"
#include "app/dataset/kitti_files.h"
#include "app/dataset/reading_files.h"

namespace roboss {

/// The run that is recorded.
struct DatasetRun {
    std::shared_ptr<const Model> model;
    std::string world_file;
    std::uint64_t seed = 0;
    unsigned threads = 1;  // of images
    render::VisualsOf visuals;
    LabelNames labels;
};

class Dataset {
  public:
    /// Makes the folder. Errors: it is not empty; no sensor has such a name; nothing to write in this format.
    static Result<std::unique_ptr<Dataset>> create(const DatasetOptions& options, DatasetRun run);

    /// Writes the frame of this tick; states[i] belongs to RobotId i. Errors: a sensor cannot measure, or a
    /// file cannot be written.
    Result<> write(std::span<const RobotState> states, Tick tick);
    /// Writes what is known at the end: dataset.json and annotations.
    Result<> close();
    /// "12 frames of 2 sensors, ..." for the end of the run.
    std::string summary() const;
    int frames() const { return frames_; }
    bool is_of(const Model& model) const { return run_.model->hash == model.hash; }

  private:
    struct Sensor {
        RobotId robot;
        std::size_t index = 0;  // in RobotType::sensors
        std::string name;       // ROBOT/SENSOR
        ReadingFiles files;
        bool in_kitti = false;  // its readings are in the folders of KITTI
    };
    Dataset(DatasetOptions options, DatasetRun run);

    Result<> open();
    Result<> find_sensors();
    const SensorSpec& spec_of(const Sensor& sensor) const;
    double time_of(Tick tick) const;
    Result<> write_sensor(Sensor& sensor, Tick tick);
    Result<> write_kitti(const Sensor& camera, const Image<std::uint8_t>& color);
    void write_poses();
    std::string description() const;

    DatasetOptions options_;
    DatasetRun run_;
    SensedStates states_;
    std::vector<Sensor> sensors_;
    std::ofstream frames_csv_, robots_csv_, sensors_csv_;
    std::optional<CocoFile> coco_;
    std::optional<KittiFiles> kitti_;
    int frames_ = 0;
};

}  // namespace roboss
