// --contacts: who touches whom where and how hard, as CSV with all digits.
#pragma once

#include <span>
#include <string>

#include "app/output/output_file.h"
#include "core/result.h"
#include "physics/step.h"

namespace roboss {

class ContactsFile {
  public:
    /// "-" is standard output.
    static Result<ContactsFile> create(const std::string& path);

    /// One line a contact point:
    /// time_s,robot_a,link_a,robot_b,link_b,x,y,z,nx,ny,nz,gap,impulse,fx,fy,fz: the point (m, world), the
    /// normal from B to A, the gap (m), the impulse along the normal and that of friction, on A (N s), of the
    /// tick that begins at time_s. Against scenery robot_b is empty and link_b names it.
    Result<> write(const Model& model, Tick tick, std::span<const ContactReport> contacts);
    Result<> close();

  private:
    OutputFile file_;
    std::string path_;
};

}  // namespace roboss
