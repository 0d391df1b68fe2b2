// Document: an MJCF file with the files that it includes, as one tree. Each element knows the file that it
// stands in.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "xml/source_file.h"

namespace roboss::mjcf {

using xml::Element;
using xml::SourceFile;
using xml::words_of;

class Document {
  public:
    /// Reads all included files. What cannot be read is an error at the <include>.
    Document(std::unique_ptr<SourceFile> main, Diagnostics& diagnostics);

    Element root() const { return {main_.get(), main_->root()}; }
    /// Folder of the main file: paths of assets start there.
    std::string folder() const { return main_->folder(); }
    const std::string& path() const { return main_->path(); }

    /// The elements in `parent`; those of an included file stand in the place of its <include>.
    std::vector<Element> children(const Element& parent) const;
    /// Those of one name.
    std::vector<Element> children(const Element& parent, const char* name) const;
    /// The elements in all sections of this name, one section after the other.
    std::vector<Element> in_sections(const char* section) const;

  private:
    void read_includes(const Element& parent, Diagnostics& diagnostics);
    void read_include(const Element& include, Diagnostics& diagnostics);

    std::unique_ptr<SourceFile> main_;
    std::map<const void*, std::unique_ptr<SourceFile>> included_;  // by the node of the <include>
    std::set<std::string> paths_;                                  // of all files, as they are named
    std::vector<std::string> open_;                                // files being read, links resolved
};

}  // namespace roboss::mjcf
