// What `roboss dataset` records, as given on the command line.
#pragma once

#include <string>
#include <vector>

namespace roboss {

struct DatasetOptions {
    std::string folder;                              // that the data set is written to
    std::string format = "coco";                     // files, coco or kitti
    std::string labels = "auto";                     // auto, world or models
    std::vector<std::string> sensors;                // ROBOT/SENSOR, with * and ?; none: see the help
    double every_s = 0.1;                            // simulated time between two frames
    int frames = 0;                                  // 0: as long as the run
    bool wanted() const { return !folder.empty(); }  // at all
};

}  // namespace roboss
