// SdfText: SDF that is made from another format or from several files, element by element. Each element keeps
// the place in the source that it came from, so that every finding about it leads there.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// The text as it stands in a value or an attribute, in one line: white space of any kind separates words in
/// SDF.
std::string escaped_line(std::string text);

class SdfText {
  public:
    explicit SdfText(const SourceFile& source) : source_(source) {}

    /// A new element in `parent` (null: the root), with the line of `from`, an element of the source; an
    /// element that a repair added has none, and gets its parent's.
    pugi::xml_node add(pugi::xml_node parent, const char* name, pugi::xml_node from,
                       const std::string& text = {});
    /// All of `from`, with what is in it.
    pugi::xml_node copy(pugi::xml_node parent, pugi::xml_node from) { return copy(parent, {&source_, from}); }
    /// The same of an element of another file.
    pugi::xml_node copy(pugi::xml_node parent, const Element& from);

    /// Findings about `node` lead to `from`.
    void place(pugi::xml_node node, const Element& from) { places_[node.hash_value()] = from.where(); }

    /// The finished text, as a file to be read.
    std::unique_ptr<SourceFile> read(Diagnostics& diagnostics) const;

  private:
    void keep_places(pugi::xml_node node, const Element& from);
    void print(pugi::xml_node node, SourceLocation place, std::string& text,
               std::vector<SourceLocation>& places) const;

    const SourceFile& source_;
    pugi::xml_document document_;
    std::unordered_map<std::size_t, SourceLocation> places_;  // by the node's hash value
};

}  // namespace roboss::sdf_import
