// Works on the text: a second XML parser would be too much for so little.
#include "mesh/repair_collada.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace roboss {
namespace {

bool is_space(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}

bool begins_number(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '+' || c == '.';
}

/// assimp 5.2 skips white space after a number, not before the first.
std::string without_leading_space(const std::string& text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        result += text[i];
        if (text[i] != '>') continue;
        std::size_t next = i + 1;
        while (next < text.size() && is_space(text[next])) ++next;
        if (next < text.size() && begins_number(text[next])) i = next - 1;
    }
    return result;
}

/// Takes every element of this name out of the text, from its opening tag to its closing one.
std::string without(std::string text, const std::string& element) {
    const std::string open = "<" + element, close = "</" + element + ">";
    std::size_t from = 0;
    while ((from = text.find(open, from)) != std::string::npos) {
        const std::size_t after = from + open.size();
        if (after >= text.size() || (!is_space(text[after]) && text[after] != '>' && text[after] != '/')) {
            from = after;  // a longer name
            continue;
        }
        const std::size_t tag_end = text.find('>', after);
        if (tag_end == std::string::npos) break;
        std::size_t end = tag_end + 1;
        if (text[tag_end - 1] != '/') {
            const std::size_t closing = text.find(close, tag_end);
            if (closing == std::string::npos) break;
            end = closing + close.size();
        }
        text.erase(from, end - from);
    }
    return text;
}

/// assimp 5.2 takes a comment among the inputs of <vertices> for an element.
std::string without_comments(std::string text) {
    for (std::size_t from = 0; (from = text.find("<!--", from)) != std::string::npos;) {
        const std::size_t end = text.find("-->", from + 4);
        if (end == std::string::npos) break;
        text.erase(from, end + 3 - from);
    }
    return text;
}

/// The value of an attribute of the tag that begins at `tag`; empty: it has none.
std::string attribute_of(const std::string& text, std::size_t tag, const std::string& name) {
    const std::size_t end = text.find('>', tag);
    for (std::size_t at = tag; (at = text.find(name + "=", at)) < end; at += name.size()) {
        const std::size_t quote = at + name.size() + 1;
        if (!is_space(text[at - 1]) || quote >= end) continue;
        const std::size_t close = text.find(text[quote], quote + 1);
        return close < end ? text.substr(quote + 1, close - quote - 1) : std::string();
    }
    return {};
}

/// The geometry behind each skin or morph, by the controller's id; both with "#" before them.
std::map<std::string, std::string> geometry_by_controller(const std::string& text) {
    std::map<std::string, std::string> sources;
    const std::string open = "<controller";
    for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos; at += open.size()) {
        const std::size_t end = text.find("</controller>", at);
        const std::size_t body = std::min(text.find("<skin", at), text.find("<morph", at));
        const std::string id = attribute_of(text, at, "id");
        if (!id.empty() && body < end) sources["#" + id] = attribute_of(text, body, "source");
    }
    for (auto& [id, source] : sources)  // a skin of a morph
        for (std::size_t step = 0; step < sources.size() && sources.contains(source); ++step)
            source = sources.at(source);
    return sources;
}

}  // namespace

std::string collada_at_rest(const std::string& text) {
    const auto sources = geometry_by_controller(text);
    if (sources.empty() && text.find("<library_animations") == std::string::npos) return {};
    std::string result = without(without(text, "library_animations"), "library_controllers");
    const std::string open = "<instance_controller", close = "</instance_controller>";
    for (std::size_t at = 0; (at = result.find(open, at)) != std::string::npos;) {
        const auto found = sources.find(attribute_of(result, at, "url"));
        const std::size_t end = result.find('>', at);
        if (end == std::string::npos) break;
        const std::string geometry =
            "<instance_geometry url=\"" + (found == sources.end() ? "#" : found->second) + "\"";
        result.replace(at, end - at - (result[end - 1] == '/' ? 1 : 0), geometry);
        at += geometry.size();
    }
    for (std::size_t at = 0; (at = result.find(close, at)) != std::string::npos;)
        result.replace(at, close.size(), "</instance_geometry>");
    return result;
}

std::string repaired_collada(const std::string& text) {
    std::string result = without_leading_space(without_comments(text));
    for (const char* element : {"texture", "library_images", "library_animations", "library_controllers"})
        result = without(std::move(result), element);
    return result;
}

}  // namespace roboss
