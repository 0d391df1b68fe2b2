// See sdf_text.h. The text has one element a line: the n-th line is that of the n-th element.
#include "sdf/sdf_text.h"

#include "core/markup.h"

namespace roboss::sdf_import {

std::string escaped_line(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    return escaped(text);
}

pugi::xml_node SdfText::add(pugi::xml_node parent, const char* name, pugi::xml_node from,
                            const std::string& text) {
    auto node = parent ? parent.append_child(name) : document_.append_child(name);
    if (!text.empty()) node.text() = text.c_str();
    if (SourceLocation place = source_.where(from); place.line > 0)
        places_[node.hash_value()] = std::move(place);
    return node;
}

pugi::xml_node SdfText::copy(pugi::xml_node parent, const Element& from) {
    const auto node = parent.append_copy(from.node);
    keep_places(node, from);
    return node;
}

void SdfText::keep_places(pugi::xml_node node, const Element& from) {
    places_[node.hash_value()] = from.where();
    auto original = from.node.first_child();
    for (const auto child : node.children()) {
        if (child.type() == pugi::node_element) keep_places(child, {from.source, original});
        original = original.next_sibling();
    }
}

void SdfText::print(pugi::xml_node node, SourceLocation place, std::string& text,
                    std::vector<SourceLocation>& places) const {
    if (const auto known = places_.find(node.hash_value()); known != places_.end()) place = known->second;
    places.push_back(place);
    text += "\n<" + std::string(node.name());
    for (const auto attribute : node.attributes())
        text += " " + std::string(attribute.name()) + "=\"" + escaped_line(attribute.value()) + "\"";
    text += '>';
    for (const auto child : node.children()) {
        if (child.type() == pugi::node_element)
            print(child, place, text, places);
        else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
            text += escaped_line(child.value());
    }
    text += "</" + std::string(node.name()) + ">";
}

std::unique_ptr<SourceFile> SdfText::read(Diagnostics& diagnostics) const {
    std::string text = "<?xml version=\"1.0\"?>";
    std::vector<SourceLocation> places{{source_.path(), 1}};
    print(document_.document_element(), places.front(), text, places);
    return SourceFile::from_text(source_.path(), std::move(text), std::move(places), diagnostics);
}

}  // namespace roboss::sdf_import
