// --trace: the poses and velocities of all links as CSV, with all digits, so that another program can compare
// them.
#pragma once

#include <span>
#include <string>

#include "app/output/output_file.h"
#include "core/result.h"
#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

class TraceFile {
  public:
    /// "-" is standard output.
    static Result<TraceFile> create(const std::string& path);

    /// One line a link: time_s,robot,link,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz (world frame, link origin).
    Result<> write(const Model& model, Tick tick, std::span<const RobotState> states);
    Result<> close();

  private:
    OutputFile file_;
    std::string path_;
};

}  // namespace roboss
