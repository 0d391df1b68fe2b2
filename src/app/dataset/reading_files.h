// The readings of one sensor in a data set: images as PNG files, long lists as NumPy files, one of each for a
// frame, and all other numbers as lines of one CSV file.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "core/result.h"
#include "sensor_kinds/sensor_spec.h"

namespace roboss {

/// "000012": the number of a frame in the names of its files.
std::string frame_name(int frame);

class ReadingFiles {
  public:
    /// `folder` is made with the first reading.
    explicit ReadingFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Writes FOLDER/FIELD/FRAME.png or .npy and a line of FOLDER/readings.csv. PNG as write_reading() makes
    /// them, of 16 bits where an image counts things. Errors: a file cannot be written.
    Result<> write(int frame, double time_s, const Sample& sample);
    Result<> close();
    /// Files that were written, without readings.csv.
    std::size_t files() const { return files_; }

  private:
    std::filesystem::path folder_;
    std::ofstream table_;
    std::size_t files_ = 0;
};

}  // namespace roboss
