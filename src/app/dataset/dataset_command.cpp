// See dataset_command.h.
#include "app/dataset/dataset_command.h"

#include <memory>

#include "app/commands/numbers.h"
#include "app/run/run.h"

namespace roboss {
namespace {

const char* const kDatasetFooter =
    R"(Runs the world and writes readings of its sensors and the truth behind them at regular times: images, depth, labels,
scans and poses. The run is that of `roboss run` with the same options; without a program or orders, robots do what the
world file says.

Files of every format:
  dataset.json        world, seed, sensors with their lenses, categories
  frames.csv          frame,tick,time_s
  robot_poses.csv     pose of each robot's base in the world, m and unit quaternion (w first)
  sensor_poses.csv    pose of each sensor: x ahead, y left, z up
  ROBOT/SENSOR/FIELD/000000.png     images: colours; depth in mm (16 bits); labels; temperatures in 0.01 K (16 bits)
  ROBOT/SENSOR/FIELD/000000.npy     lists, as the ranges of a lidar
  ROBOT/SENSOR/readings.csv         other numbers, one line a frame
--format coco adds annotations/instances.json: of each colour image the labelled things, with masks and boxes.
--format kitti writes colour cameras and lidars as KITTI's object detection benchmark instead: training/image_2,
label_2, calib and velodyne, one sample for each camera and frame. Its boxes are meant for level cameras.

Examples:
  roboss dataset world.sdf -o data --frames 200
  roboss dataset city.sdf --client driver.so --sensors 'car_*/eye' --every 0.5 --frames 1000 -o data
  roboss dataset city.sdf --sensors car_1/eye --sensors car_1/lidar --format kitti -o kitti --duration 60

Exit codes: those of `roboss run`; 3 also if a sensor cannot measure or a file cannot be written.)";

}  // namespace

void add_dataset_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("dataset", "record images, depth, labels and poses of a run for training");
    auto options = std::make_shared<RunOptions>();
    add_run_options(*command, *options);
    DatasetOptions& o = options->dataset;
    const std::string group = "Data set";
    command->add_option("-o,--output", o.folder, "folder to write; it must be new or empty")
        ->required()
        ->group(group);
    command
        ->add_option("--sensors", o.sensors,
                     "ROBOT/SENSOR, with * and ? for any characters (may be repeated; default: all cameras "
                     "and lidars)")
        ->allow_extra_args(false)
        ->group(group);
    command->add_option("--format", o.format, "files, coco or kitti (below)")
        ->check(CLI::IsMember({"files", "coco", "kitti"}))
        ->capture_default_str()
        ->group(group);
    command->add_option("--every", o.every_s, "simulated time between two frames, s")
        ->check(positive_number())
        ->capture_default_str()
        ->group(group);
    command->add_option("--frames", o.frames, "frames to write (default: 100, or those of --duration)")
        ->check(whole_number(1, 1000000))
        ->group(group);
    command
        ->add_option("--labels", o.labels,
                     "what has a label: world: what Gazebo's Label plugin labels; models: each kind of model "
                     "that can move; auto: world, or models if it labels nothing")
        ->check(CLI::IsMember({"auto", "world", "models"}))
        ->capture_default_str()
        ->group(group);
    command->footer(kDatasetFooter);
    command->callback([options, &exit_code] {
        constexpr int kFrames = 100;
        DatasetOptions& dataset = options->dataset;
        if (dataset.frames == 0 && !options->until_s && !options->duration_s) dataset.frames = kFrames;
        options->viewer.headless = true;
        exit_code = run(*options);
    });
}

}  // namespace roboss
