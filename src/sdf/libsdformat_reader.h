// LibsdformatReader: hands skeletons to libsdformat and turns what it says into diagnostics with the lines of
// the source. Equal skeletons are read once; reading in a fresh document each time keeps it linear (one
// document of 2000 cars takes libsdformat 12 a minute).
#pragma once

#include <memory>
#include <sdf/sdf.hh>
#include <string>
#include <unordered_map>

#include "sdf/include_store.h"
#include "sdf/skeleton.h"

namespace roboss::sdf_import {

/// A model as libsdformat understood it, with the way back to the source.
class ReadModel {
  public:
    ReadModel(std::shared_ptr<const sdf::Root> root, Skeleton skeleton, const IncludeStore& includes);

    const sdf::Model& model() const { return *root_->Model(); }

    /// The source of something that libsdformat made; empty if it stands in no file.
    Element source_of(const sdf::ElementPtr& element) const;
    Element source_at(const std::string& file, int line) const;
    Element source() const { return skeleton_.lines.front(); }

  private:
    std::shared_ptr<const sdf::Root> root_;
    Skeleton skeleton_;
    const IncludeStore* includes_ = nullptr;
};

class LibsdformatReader {
  public:
    LibsdformatReader(const IncludeStore& includes, Diagnostics& diagnostics);

    /// nullptr (with an error) if libsdformat cannot make a model of it.
    std::unique_ptr<ReadModel> read(Skeleton skeleton);

  private:
    struct Known {
        std::shared_ptr<const sdf::Root> root;  // nullptr: unreadable
        Diagnostics found;                      // told again with each model of this skeleton
    };
    Known parse(const Skeleton& skeleton);
    struct Heard;  // what libsdformat said
    void report(const Heard& heard, const Skeleton& skeleton, bool readable, Diagnostics& out) const;

    const IncludeStore& includes_;
    Diagnostics& diagnostics_;
    sdf::SDFPtr document_;  // with the descriptions of all elements, which take 25 ms to make
    std::unordered_map<std::string, Known> read_;  // by body
};

}  // namespace roboss::sdf_import
