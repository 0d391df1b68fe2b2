// See sdf_text.h. The text has one element a line: the n-th line is that of the n-th element.
#include "sdf/sdf_text.h"

namespace roboss::sdf_import {

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\n':
            case '\r':
                result += ' ';
                break;
            default:
                result += c;
        }
    return result;
}

pugi::xml_node SdfText::add(pugi::xml_node parent, const char* name, pugi::xml_node from,
                            const std::string& text) {
    auto node = parent ? parent.append_child(name) : document_.append_child(name);
    if (!text.empty()) node.text() = text.c_str();
    if (const int line = source_.line(from); line > 0) lines_[node.hash_value()] = line;
    return node;
}

pugi::xml_node SdfText::copy(pugi::xml_node parent, pugi::xml_node from) {
    const auto node = parent.append_copy(from);
    keep_lines(node, from);
    return node;
}

void SdfText::keep_lines(pugi::xml_node node, pugi::xml_node from) {
    lines_[node.hash_value()] = source_.line(from);
    auto original = from.first_child();
    for (const auto child : node.children()) {
        if (child.type() == pugi::node_element) keep_lines(child, original);
        original = original.next_sibling();
    }
}

void SdfText::print(pugi::xml_node node, int line, std::string& text, std::vector<int>& lines) const {
    if (const auto known = lines_.find(node.hash_value()); known != lines_.end()) line = known->second;
    lines.push_back(line);
    text += "\n<" + std::string(node.name());
    for (const auto attribute : node.attributes())
        text += " " + std::string(attribute.name()) + "=\"" + escaped(attribute.value()) + "\"";
    text += '>';
    for (const auto child : node.children()) {
        if (child.type() == pugi::node_element)
            print(child, line, text, lines);
        else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
            text += escaped(child.value());
    }
    text += "</" + std::string(node.name()) + ">";
}

std::unique_ptr<SourceFile> SdfText::read(Diagnostics& diagnostics) const {
    std::string text = "<?xml version=\"1.0\"?>";
    std::vector<int> lines{1};
    print(document_.document_element(), 1, text, lines);
    return SourceFile::from_text(source_.path(), std::move(text), std::move(lines), diagnostics);
}

}  // namespace roboss::sdf_import
