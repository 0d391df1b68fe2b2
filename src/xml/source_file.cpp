// Reads XML files and finds the line of a node from its offset in the text.
#include "xml/source_file.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/similar.h"

namespace roboss::xml {

namespace {

constexpr std::uintmax_t kBytesMost = std::uintmax_t{256} << 20;  // of a file

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The first node that lies too deep for recursive reading, if any.
pugi::xml_node too_deep(pugi::xml_node root, int deepest) {
    int depth = 0;
    pugi::xml_node node = root;
    while (node) {
        if (node.first_child()) {
            node = node.first_child();
            if (++depth > deepest) return node;
            continue;
        }
        while (node != root && !node.next_sibling()) {
            node = node.parent();
            --depth;
        }
        if (node == root) break;
        node = node.next_sibling();
    }
    return {};
}

/// Whether the text begins as no XML does, of whatever encoding.
bool is_other_text(const std::string& text) {
    const auto first = std::ranges::find_if_not(text, is_space);
    return first == text.end() ||
           (*first != '<' && *first != '\0' && static_cast<unsigned char>(*first) < 0x80);
}

/// What to do about a file that is no XML, by the ending of its name.
std::string remedy_for_other(const std::string& path) {
    struct Kind {
        std::string_view ending;
        const char* remedy;
    };
    constexpr const char* kMesh =
        "A mesh is no world: name it in <mesh><uri> of an SDFormat or URDF file, or in <asset> of an MJCF "
        "file.";
    constexpr const char* kUsd = "Export it as URDF or MJCF; USD is not read.";
    constexpr const char* kWebots =
        "Export its robots as URDF in Webots (Export URDF); its worlds are not read.";
    constexpr Kind kKinds[] = {{".stl", kMesh},    {".obj", kMesh},  {".ply", kMesh}, {".fbx", kMesh},
                               {".glb", kMesh},    {".gltf", kMesh}, {".wrl", kMesh}, {".usd", kUsd},
                               {".usda", kUsd},    {".usdc", kUsd},  {".usdz", kUsd}, {".wbt", kWebots},
                               {".proto", kWebots}};
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto known = std::ranges::find(kKinds, ending, &Kind::ending);
    return known != std::end(kKinds) ? known->remedy : "Give an SDFormat, URDF or MJCF file.";
}

/// What to do about a file that cannot be read: the file of the folder that was probably meant.
std::string remedy_for(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (path.empty()) return "Write a path.";
    const fs::path wanted(path), folder = wanted.has_parent_path() ? wanted.parent_path() : fs::path(".");
    if (fs::is_directory(wanted, error)) return "Name a file in it.";
    if (!fs::exists(folder, error)) return "There is no folder '" + folder.string() + "'; check the path.";
    std::vector<std::string> names;
    if (!fs::exists(wanted, error))
        for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
            names.push_back(at->path().filename().string());
    std::ranges::sort(names);
    const std::string similar = similar_to(wanted.filename().string(), names);
    if (similar.empty()) return "Check the path and the permissions.";
    return "Did you mean '" + (wanted.parent_path() / similar).string() + "'?";
}

}  // namespace

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    std::size_t at = 0;
    while (at < text.size()) {
        while (at < text.size() && is_space(text[at])) ++at;
        const std::size_t start = at;
        while (at < text.size() && !is_space(text[at])) ++at;
        if (at > start) words.push_back(text.substr(start, at - start));
    }
    return words;
}

std::string trimmed(std::string_view text) {
    const char* const blank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blank);
    return first == text.npos ? std::string()
                              : std::string(text.substr(first, text.find_last_not_of(blank) - first + 1));
}

namespace {

pugi::xml_parse_result parsed(pugi::xml_document& document, const std::string& text) {
    return document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_trim_pcdata);
}

/// Where the text ends if the end tag that broke the parsing off, and what follows, are end tags only; else
/// all of it. TinyXML-2, which MuJoCo and Gazebo read with, stops there without a word.
std::size_t end_before_stray_tags(const std::string& text, const pugi::xml_parse_result& result) {
    if (result.status != pugi::status_end_element_mismatch) return text.size();
    const std::size_t tag = text.rfind("</", static_cast<std::size_t>(result.offset));
    if (tag == text.npos) return text.size();
    std::size_t at = tag;
    while (at < text.size()) {
        if (text.compare(at, 2, "</") == 0)
            at = text.find('>', at);
        else if (!is_space(text[at]))
            return text.size();
        if (at == text.npos) return text.size();
        ++at;
    }
    return tag;
}

/// The text with a space after each quoted value of a tag that another attribute follows at once: a="1"b="2".
/// XML forbids it; TinyXML-2 reads it.
std::string with_attributes_apart(const std::string& text) {
    constexpr std::pair<const char*, const char*> kPassedOver[] = {
        {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}};
    std::string out;
    std::size_t at = 0;
    bool in_tag = false;
    const auto copy_until = [&](std::size_t end) {
        end = std::min(end, text.size());
        out.append(text, at, end - at);
        at = end;
    };
    const auto copy_past = [&](const char* end, std::size_t from) {
        const std::size_t found = text.find(end, from);
        copy_until(found == text.npos ? found : found + std::strlen(end));
    };
    while (at < text.size()) {
        const char c = text[at];
        const auto passed_over = std::ranges::find_if(kPassedOver, [&](const auto& kind) {
            return text.compare(at, std::strlen(kind.first), kind.first) == 0;
        });
        if (!in_tag && passed_over != std::end(kPassedOver)) {
            copy_past(passed_over->second, at + std::strlen(passed_over->first));
        } else if (in_tag && (c == '"' || c == '\'')) {
            copy_past(c == '"' ? "\"" : "'", at + 1);
            const char next = at < text.size() ? text[at] : ' ';
            if (!is_space(next) && next != '/' && next != '>') out += ' ';
        } else {
            in_tag = c == '<' || (in_tag && c != '>');
            copy_until(at + 1);
        }
    }
    return out;
}

}  // namespace

std::unique_ptr<SourceFile> SourceFile::read(const std::string& path, Diagnostics& diagnostics) {
    std::error_code ignored;
    std::ifstream stream(path, std::ios::binary);
    const bool is_folder = std::filesystem::is_directory(path, ignored);
    if (!stream || is_folder) {
        const bool exists = std::filesystem::exists(path, ignored);
        diagnostics.error({path, 0}, "cannot-read",
                          is_folder ? "'" + path + "' is a folder"
                          : exists  ? "the file '" + path + "' cannot be read"
                                    : "there is no file '" + path + "'",
                          remedy_for(path));
        return nullptr;
    }
    if (std::filesystem::is_regular_file(path, ignored) &&  // else a pipe of the user's
        std::filesystem::file_size(path, ignored) > kBytesMost) {
        diagnostics.error({path, 0}, "too-large", "'" + path + "' is larger than 256 MiB",
                          "Divide it, or name the right file.");
        return nullptr;
    }
    std::ostringstream text;
    text << stream.rdbuf();
    return from_text(path, std::move(text).str(), {}, diagnostics);
}

std::unique_ptr<SourceFile> SourceFile::from_text(const std::string& path, std::string text,
                                                  std::vector<SourceLocation> places,
                                                  Diagnostics& diagnostics, int deepest) {
    auto file = std::make_unique<SourceFile>();
    file->path_ = path;
    file->places_ = std::move(places);
    if (!file->parse(std::move(text), diagnostics, deepest)) return nullptr;
    return file;
}

void SourceFile::find_lines(const std::string& text) {
    line_starts_.assign(1, 0);
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
        line_starts_.push_back(at + 1);
}

bool SourceFile::parse(std::string text, Diagnostics& diagnostics, int deepest) {
    find_lines(text);
    auto result = parsed(document_, text);
    const std::size_t whole = end_before_stray_tags(text, result);
    if (whole != text.size() && parsed(document_, text.substr(0, whole))) {
        diagnostics.warning({path_, line_of_offset(result.offset)}, "stray-end-tag",
                            "an end tag after the end of the file's element is passed over", "Remove it.");
        result.status = pugi::status_ok;
    }
    if (result.status == pugi::status_bad_attribute) {
        const int line = line_of_offset(result.offset);
        const std::string apart = with_attributes_apart(text);
        if (apart.size() != text.size() && parsed(document_, apart)) {
            diagnostics.warning({path_, line}, "attributes-together",
                                "no space parts an attribute from the one before it; it is read all the same",
                                "Write a space between them.");
            result.status = pugi::status_ok;
            find_lines(apart);
        }
    }
    if (!result && is_other_text(text)) {
        diagnostics.error(
            {path_, 1}, "not-xml",
            text.empty() ? "the file is empty" : "the file is no XML: it does not begin with '<'",
            remedy_for_other(path_));
        return false;
    }
    if (!result) {
        const int line = line_of_offset(result.offset);
        const auto column =
            result.offset - static_cast<std::ptrdiff_t>(line_starts_[static_cast<std::size_t>(line - 1)]) + 1;
        diagnostics.error({path_, line}, "malformed-xml",
                          "the XML is malformed at line " + std::to_string(line) + ", column " +
                              std::to_string(column) + ": " + result.description(),
                          "Check that every tag that is opened is closed, and that the file is complete.");
        return false;
    }
    if (const auto node = too_deep(root(), deepest)) {
        diagnostics.error({path_, line(node.parent())}, "too-deep",
                          "elements are nested more than " + std::to_string(deepest) + " deep",
                          "Flatten the file; nested models rarely need more than a few levels.");
        return false;
    }
    return true;
}

std::string SourceFile::folder() const {
    return std::filesystem::path(path_).parent_path().string();
}

SourceLocation SourceFile::where(pugi::xml_node node) const {
    const int line = line_of_offset(node.offset_debug());
    if (places_.empty() || line == 0) return {path_, line};
    const auto index = static_cast<std::size_t>(line - 1);
    return index < places_.size() ? places_[index] : SourceLocation{path_, 0};
}

int SourceFile::line_of_offset(std::ptrdiff_t offset) const {
    if (offset < 0) return 0;
    const auto after =
        std::upper_bound(line_starts_.begin(), line_starts_.end(), static_cast<std::size_t>(offset));
    return static_cast<int>(after - line_starts_.begin());
}

}  // namespace roboss::xml
