// SourceFile: one XML file as read by pugixml, with line numbers. Every element that a diagnostic may name is
// an Element: a node and the file it stands in.
#pragma once

#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"

namespace roboss::xml {

/// The words of a text between white space.
std::vector<std::string_view> words_of(std::string_view text);
inline std::vector<std::string_view> words_of(const char* text) {
    return words_of(std::string_view(text));
}
std::vector<std::string_view> words_of(std::string&& text) = delete;  // the words would outlive it
/// Without white space at its ends.
std::string trimmed(std::string_view text);

class SourceFile {
  public:
    /// Keeps recursive readers from the end of the stack; no world comes near it.
    static constexpr int kDeepestWorld = 100;

    /// Reads and parses a file; a malformed or missing one gives an error and nullptr.
    static std::unique_ptr<SourceFile> read(const std::string& path, Diagnostics& diagnostics);

    /// Parses text that was made from `path` (an SDF from a URDF); `places[i]` is where line i + 1 of the
    /// text comes from. Without `places` the text is that of `path`. Elements that are nested deeper than
    /// `deepest` are an error.
    static std::unique_ptr<SourceFile> from_text(const std::string& path, std::string text,
                                                 std::vector<SourceLocation> places, Diagnostics& diagnostics,
                                                 int deepest = kDeepestWorld);

    const std::string& path() const { return path_; }
    std::string folder() const;
    pugi::xml_node root() const { return document_.document_element(); }

    int line(pugi::xml_node node) const { return where(node).line; }
    SourceLocation where(pugi::xml_node node) const;

  private:
    bool parse(std::string text, Diagnostics& diagnostics, int deepest);
    void find_lines(const std::string& text);
    int line_of_offset(std::ptrdiff_t offset) const;

    std::string path_;
    pugi::xml_document document_;
    std::vector<std::size_t> line_starts_;
    std::vector<SourceLocation> places_;  // by line; empty: those of the file itself
};

struct Element {
    const SourceFile* source = nullptr;
    pugi::xml_node node;

    explicit operator bool() const { return source != nullptr && static_cast<bool>(node); }
    Element child(const char* name) const { return {source, node.child(name)}; }
    SourceLocation where() const { return source ? source->where(node) : SourceLocation{}; }
    std::string name() const { return node.attribute("name").value(); }
    std::string text(const char* child_name) const { return node.child(child_name).text().get(); }
};

}  // namespace roboss::xml
