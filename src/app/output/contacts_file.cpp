// Writes the CSV of --contacts.
#include "app/output/contacts_file.h"

#include "app/output/cannot_write.h"
#include "core/printable.h"

namespace roboss {
namespace {

std::string robot_name(const Model& model, RobotId robot) {
    return printable_line(model.robots[robot.index()].name);
}

std::string link_name(const Model& model, RobotId robot, LinkId link) {
    return printable_line(model.type_of(robot).links[link.index()].name);
}

}  // namespace

Result<ContactsFile> ContactsFile::create(const std::string& path) {
    ContactsFile contacts;
    contacts.path_ = path;
    contacts.file_ = open_output(path);
    if (!contacts.file_) return cannot_write(path);
    std::fputs("time_s,robot_a,link_a,robot_b,link_b,x,y,z,nx,ny,nz,gap,impulse,fx,fy,fz\n",
               contacts.file_.get());
    return contacts;
}

Result<> ContactsFile::write(const Model& model, Tick tick, std::span<const ContactReport> contacts) {
    const double time_s = static_cast<double>(tick) * model.dt_s;
    for (const ContactReport& c : contacts) {
        const bool robot = c.robot_b.valid();
        const std::string other = robot ? robot_name(model, c.robot_b) : "",
                          part = robot ? link_name(model, c.robot_b, c.link_b)
                                       : printable_line(model.statics[c.scenery].name);
        std::fprintf(file_.get(), "%.17g,%s,%s,%s,%s", time_s, robot_name(model, c.robot_a).c_str(),
                     link_name(model, c.robot_a, c.link_a).c_str(), other.c_str(), part.c_str());
        for (const double x : {c.p_W.x, c.p_W.y, c.p_W.z, c.normal.x, c.normal.y, c.normal.z, c.gap,
                               c.impulse, c.friction.x, c.friction.y, c.friction.z})
            std::fprintf(file_.get(), ",%.17g", x);
        std::fputc('\n', file_.get());
    }
    if (std::ferror(file_.get())) return cannot_write(path_);
    return Ok{};
}

Result<> ContactsFile::close() {
    if (file_ && std::fclose(file_.release()) != 0) return cannot_write(path_);
    return Ok{};
}

}  // namespace roboss
