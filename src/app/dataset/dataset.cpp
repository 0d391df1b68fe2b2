// See dataset.h.
#include "app/dataset/dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/output/array_file.h"
#include "core/hash.h"
#include "core/similar.h"
#include "model/robot_names.h"
#include "render/lens.h"
#include "sensors/channel_order.h"
#include "sensors/placed_camera.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

/// The colours of a reading; nullptr: it has none.
const Image<std::uint8_t>* color_of(const Sample& sample) {
    if (const auto* camera = std::get_if<CameraReading>(&sample)) return &camera->color;
    if (const auto* camera = std::get_if<RgbdCameraReading>(&sample)) return &camera->color;
    return nullptr;
}

bool is_color_camera(const SensorSpec& sensor) {
    return sensor.as<ColorCameraSpec>() != nullptr || sensor.as<RgbdCameraSpec>() != nullptr;
}

/// Recorded by default: cameras and lidars.
bool sees(const SensorSpec& sensor) {
    return optics_of(sensor) != nullptr || sensor.as<LaserSpec>() != nullptr;
}

std::string pose_cells(const Pose& X) {
    return fmt::format("{},{},{},{},{},{},{}", X.p.x, X.p.y, X.p.z, X.q.w, X.q.x, X.q.y, X.q.z);
}

const char* const kPoseColumns = "x,y,z,qw,qx,qy,qz\n";

}  // namespace

Dataset::Dataset(DatasetOptions options, DatasetRun run)
    : options_(std::move(options)), run_(std::move(run)), states_(run_.model, run_.visuals, run_.threads) {}

Result<std::unique_ptr<Dataset>> Dataset::create(const DatasetOptions& options, DatasetRun run) {
    std::unique_ptr<Dataset> made(new Dataset(options, std::move(run)));
    if (Result<> found = made->find_sensors(); !found) return found.error();
    if (Result<> opened = made->open(); !opened) return opened.error();
    return made;
}

Result<> Dataset::find_sensors() {
    std::vector<std::string> names;
    std::vector<bool> used(options_.sensors.size(), false);
    const Model& model = *run_.model;
    for (std::size_t r = 0; r < model.robots.size(); ++r) {
        const std::vector<SensorInfo>& infos = model.type_of(RobotId(r)).sensors;
        for (std::size_t s = 0; s < infos.size(); ++s) {
            if (!infos[s].spec.measures()) continue;
            const std::string name = model.robots[r].name + "/" + infos[s].spec.name;
            names.push_back(name);
            bool wanted = options_.sensors.empty() && sees(infos[s].spec);
            for (std::size_t p = 0; p < options_.sensors.size(); ++p)
                if (fits_pattern(name, options_.sensors[p])) wanted = used[p] = true;
            if (!wanted) continue;
            const bool in_kitti = options_.format == "kitti" && (is_color_camera(infos[s].spec) ||
                                                                 infos[s].spec.as<LaserSpec>() != nullptr);
            sensors_.push_back(
                {RobotId(r), s, name, ReadingFiles(fs::path(options_.folder) / name), in_kitti});
        }
    }
    for (std::size_t p = 0; p < used.size(); ++p)
        if (!used[p])
            return Error{"no sensor of the world is '" + options_.sensors[p] + "'",
                         did_you_mean(options_.sensors[p], names,
                                      "give ROBOT/SENSOR, with * and ?; `roboss check` lists both"),
                         "no-sensor"};
    const bool has_color = std::any_of(sensors_.begin(), sensors_.end(), [&](const Sensor& sensor) {
        return is_color_camera(spec_of(sensor));
    });
    if (sensors_.empty())
        return Error{"the world has no cameras and no lidars",
                     "add a <sensor>, or name other sensors with --sensors ROBOT/SENSOR", "no-sensor"};
    if (options_.format == "kitti" && !has_color)
        return Error{"the format kitti needs a colour camera, and none is recorded",
                     "add a <sensor type=\"camera\">, or use --format files", "no-sensor"};
    return Ok{};
}

Result<> Dataset::open() {
    const fs::path folder = options_.folder;
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_empty(folder, error))
        return Error{"the folder " + options_.folder + " is not empty",
                     "give a new folder, or empty this one", "folder-not-empty"};
    fs::create_directories(folder, error);
    frames_csv_.open(folder / "frames.csv");
    robots_csv_.open(folder / "robot_poses.csv");
    sensors_csv_.open(folder / "sensor_poses.csv");
    frames_csv_ << "frame,tick,time_s\n";
    robots_csv_ << "frame,robot," << kPoseColumns;
    sensors_csv_ << "frame,sensor," << kPoseColumns;
    if (!frames_csv_ || !robots_csv_ || !sensors_csv_)
        return Error{"files in " + options_.folder + " cannot be written",
                     "check the folder, its permissions and the free space", "not-writable"};
    if (options_.format == "kitti") kitti_.emplace(folder, run_.labels);
    if (options_.format != "coco") return Ok{};
    Result<CocoFile> coco = CocoFile::create(folder / "annotations" / "instances.json", run_.labels);
    if (!coco) return coco.error();
    coco_.emplace(std::move(coco).value());
    return Ok{};
}

const SensorSpec& Dataset::spec_of(const Sensor& sensor) const {
    return run_.model->type_of(sensor.robot).sensors[sensor.index].spec;
}

double Dataset::time_of(Tick tick) const {
    return static_cast<double>(tick) * run_.model->dt_s;
}

Result<> Dataset::write(std::span<const RobotState> states, Tick tick) {
    states_.update(states, tick);
    frames_csv_ << fmt::format("{},{},{}\n", frames_, tick, time_of(tick));
    write_poses();
    for (Sensor& sensor : sensors_)
        if (Result<> written = write_sensor(sensor, tick); !written) return written.error();
    ++frames_;
    return Ok{};
}

Result<> Dataset::write_sensor(Sensor& sensor, Tick tick) {
    const SensorSpec& spec = spec_of(sensor);
    if (sensor.in_kitti && spec.as<LaserSpec>() != nullptr) return Ok{};  // with the camera
    Result<Sample> sample = states_.read(sensor.robot, sensor.index, run_.seed);
    if (!sample) return sample.error();
    put_red_first(spec, sample.value());
    const Image<std::uint8_t>* const color = color_of(sample.value());
    if (sensor.in_kitti) return write_kitti(sensor, *color);
    if (Result<> written = sensor.files.write(frames_, time_of(tick), sample.value()); !written)
        return written.error();
    if (!coco_ || color == nullptr) return Ok{};
    const CameraOptics& optics = *optics_of(spec);
    const Result<std::vector<SeenThing>> things = seen_things(states_, optics, sensor.robot, sensor.index);
    if (!things) return things.error();
    coco_->add({sensor.name + "/color/" + frame_name(frames_) + ".png", optics.width, optics.height, frames_,
                time_of(tick), sensor.name},
               things.value());
    return Ok{};
}

Result<> Dataset::write_kitti(const Sensor& camera, const Image<std::uint8_t>& color) {
    KittiSample kitti;
    kitti.color = &color;
    kitti.optics = optics_of(spec_of(camera));
    kitti.X_WC = camera_pose(*kitti.optics, states_.query(camera.robot, camera.index, 0));
    kitti.X_WB = to_transform(base_pose(states_.state_of(camera.robot)));
    Result<std::vector<SeenThing>> things = seen_things(states_, *kitti.optics, camera.robot, camera.index);
    if (!things) return things.error();
    kitti.things = std::move(things).value();
    Sample scan;
    for (const Sensor& lidar : sensors_) {
        const LaserSpec* const spec = spec_of(lidar).as<LaserSpec>();
        if (lidar.robot != camera.robot || spec == nullptr || kitti.scan) continue;
        Result<Sample> read = states_.read(lidar.robot, lidar.index, run_.seed);
        if (!read) return read.error();
        scan = std::move(read).value();
        kitti.scan = KittiScan{spec, std::get_if<LaserReading>(&scan),
                               sensor_pose(states_.query(lidar.robot, lidar.index, 0))};
    }
    return kitti_->write(kitti);
}

void Dataset::write_poses() {
    for (std::size_t r = 0; r < run_.model->robots.size(); ++r)
        robots_csv_ << fmt::format("{},{},{}\n", frames_, run_.model->robots[r].name,
                                   pose_cells(base_pose(states_.state_of(RobotId(r)))));
    for (const Sensor& sensor : sensors_) {
        const CameraOptics* const optics = optics_of(spec_of(sensor));
        const SensorQuery query = states_.query(sensor.robot, sensor.index, 0);
        const Transform X = optics != nullptr ? camera_pose(*optics, query) : sensor_pose(query);
        sensors_csv_ << fmt::format("{},{},{}\n", frames_, sensor.name, pose_cells({X.p, to_quat(X.R)}));
    }
}

std::string Dataset::description() const {
    nlohmann::ordered_json all;
    all["world"] = run_.world_file;
    all["model_hash"] = to_hex(run_.model->hash);
    all["seed"] = run_.seed;
    all["dt_s"] = run_.model->dt_s;
    all["every_s"] = options_.every_s;
    all["frames"] = frames_;
    all["format"] = options_.format;
    all["sensors"] = nlohmann::ordered_json::array();
    for (const Sensor& sensor : sensors_) {
        nlohmann::ordered_json one;
        one["name"] = sensor.name;
        one["kind"] = spec_of(sensor).kind().name;
        if (const CameraOptics* optics = optics_of(spec_of(sensor))) {
            const render::Lens lens(*optics);
            one["width"] = optics->width, one["height"] = optics->height;
            one["fx"] = lens.fx(), one["fy"] = lens.fy(), one["cx"] = lens.cx(), one["cy"] = lens.cy();
            one["distortion"] = {optics->k1, optics->k2, optics->p1, optics->p2, optics->k3};
        }
        all["sensors"].push_back(std::move(one));
    }
    all["categories"] = nlohmann::ordered_json::array();
    for (const auto& [label, name] : run_.labels)
        all["categories"].push_back({{"id", label}, {"name", name}});
    return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Result<> Dataset::close() {
    frames_csv_.close(), robots_csv_.close(), sensors_csv_.close();
    Result<> done = write_bytes((fs::path(options_.folder) / "dataset.json").string(), description());
    if (frames_csv_.fail() || robots_csv_.fail() || sensors_csv_.fail())
        done = Error{"files in " + options_.folder + " cannot be written",
                     "check the folder, its permissions and the free space", "not-writable"};
    for (Sensor& sensor : sensors_)
        if (Result<> closed = sensor.files.close(); !closed) done = closed;
    if (coco_)
        if (Result<> closed = coco_->close(); !closed) done = closed;
    return done;
}

std::string Dataset::summary() const {
    std::string text = fmt::format("{} frames of {} sensors", frames_, sensors_.size());
    if (coco_) text += fmt::format(", {} annotated things", coco_->annotations());
    if (kitti_) text += fmt::format(", {} samples", kitti_->samples());
    return text + " in " + options_.folder;
}

}  // namespace roboss
