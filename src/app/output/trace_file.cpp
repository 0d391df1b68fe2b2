// Writes the CSV of --trace.
#include "app/output/trace_file.h"

#include "app/output/cannot_write.h"
#include "core/printable.h"
#include "physics/dynamics/kinematics.h"

namespace roboss {

Result<TraceFile> TraceFile::create(const std::string& path) {
    TraceFile trace;
    trace.path_ = path;
    trace.file_ = open_output(path);
    if (!trace.file_) return cannot_write(path);
    std::fputs("time_s,robot,link,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n", trace.file_.get());
    return trace;
}

Result<> TraceFile::write(const Model& model, Tick tick, std::span<const RobotState> states) {
    const double time_s = static_cast<double>(tick) * model.dt_s;
    for (std::size_t r = 0; r < states.size(); ++r) {
        const RobotType& type = model.type_of(RobotId(r));
        const std::string robot = printable_line(model.robots[r].name);
        for (std::size_t l = 0; l < type.links.size(); ++l) {
            const Pose X = to_pose(link_pose(type, states[r], LinkId(l)));
            const Twist v = link_twist(type, states[r], LinkId(l));
            std::fprintf(
                file_.get(),
                "%.17g,%s,%s,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
                time_s, robot.c_str(), printable_line(type.links[l].name).c_str(), X.p.x, X.p.y, X.p.z, X.q.w,
                X.q.x, X.q.y, X.q.z, v.linear.x, v.linear.y, v.linear.z, v.angular.x, v.angular.y,
                v.angular.z);
        }
    }
    if (std::ferror(file_.get())) return cannot_write(path_);
    return Ok{};
}

Result<> TraceFile::close() {
    if (file_ && std::fclose(file_.release()) != 0) return cannot_write(path_);
    return Ok{};
}

}  // namespace roboss
