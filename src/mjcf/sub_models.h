// Sub-models: the files that the <model>s of an MJCF file name, for <attach>. Each is read once, with its own
// <compiler>, classes and assets; its <option> has no effect, as in MuJoCo.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mjcf/assets.h"
#include "mjcf/tree.h"

namespace roboss::mjcf {

class SubModel {
  public:
    /// `main`: the settings whose <option> counts.
    SubModel(std::unique_ptr<SourceFile> file, const Settings& main, std::vector<std::string> search_paths,
             Diagnostics& diagnostics);

    const Document& document() const { return document_; }
    /// To read its bodies instead of those of the file that attaches it.
    Reading reading(const Reading& user) const;

  private:
    Document document_;
    Settings settings_;
    Defaults defaults_;
    mutable Assets assets_;  // reads a mesh when it is first asked for
};

class SubModels {
  public:
    SubModels(const Settings& main, std::vector<std::string> search_paths, Diagnostics& diagnostics)
        : main_(main), search_paths_(std::move(search_paths)), diagnostics_(diagnostics) {}

    /// The one that an <attach> in `user` names; nullptr: it is not there or cannot be read, which is an
    /// error.
    const SubModel* find(const Attributes& attach, const Document& user);

  private:
    /// The file of a <model>; nullptr: an error.
    const SubModel* read(const Element& model, const Document& user);

    const Settings& main_;
    std::vector<std::string> search_paths_;
    Diagnostics& diagnostics_;
    std::map<std::string, std::unique_ptr<SubModel>> models_;  // by path; null: it cannot be read
};

}  // namespace roboss::mjcf
