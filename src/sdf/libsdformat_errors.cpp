// Translates the errors of reading and of the frame graphs.
#include "sdf/libsdformat_errors.h"

#include <algorithm>

namespace roboss::sdf_import {
namespace {

/// The text between the first "before[" and the next "]".
std::string bracketed(const std::string& message, const std::string& before) {
    const std::size_t start = message.find(before + "[");
    if (start == std::string::npos) return {};
    const std::size_t from = start + before.size() + 1;
    return message.substr(from, message.find(']', from) - from);
}

/// Errors of the graphs name no line, but often "joint with name[x]": finds that element under the model.
Element element_named_in(const std::string& message, const Element& model) {
    for (const char* tag : {"joint", "frame", "link", "collision", "visual", "model"}) {
        const std::string name = bracketed(message, std::string(tag) + " with name");
        if (name.empty()) continue;
        const auto node = model.node.find_node([&](pugi::xml_node n) {
            return std::string(n.name()) == tag && name == n.attribute("name").value();
        });
        if (node) return {model.source, node};
    }
    return model;
}

bool is_joint_to_nowhere(const sdf::Error& error) {
    return error.Code() == sdf::ErrorCode::JOINT_CHILD_LINK_INVALID ||
           error.Code() == sdf::ErrorCode::JOINT_PARENT_LINK_INVALID;
}

/// Follows from an error that is told already: by validate() (joints to nowhere), or one line earlier.
bool is_consequence(const sdf::Error& error, bool joint_to_nowhere, std::size_t reported) {
    switch (error.Code()) {
        case sdf::ErrorCode::JOINT_CHILD_LINK_INVALID:
        case sdf::ErrorCode::JOINT_PARENT_LINK_INVALID:
            return true;
        case sdf::ErrorCode::FRAME_ATTACHED_TO_GRAPH_ERROR:
        case sdf::ErrorCode::POSE_RELATIVE_TO_GRAPH_ERROR:
            return joint_to_nowhere || reported > 0;
        case sdf::ErrorCode::FRAME_ATTACHED_TO_INVALID:
        case sdf::ErrorCode::POSE_RELATIVE_TO_INVALID:
            return joint_to_nowhere && (error.Message().find("specified by joint") != std::string::npos ||
                                        error.Message().find("frame with name [") != std::string::npos);
        default:
            return false;
    }
}

void report_unknown(const std::string& message, const Element& at, const Element& model,
                    Diagnostics& diagnostics) {
    const std::string attribute = bracketed(message, "Attribute");
    const std::string element = at ? at.node.name() : bracketed(message, "Element");
    const std::string parent = at ? at.node.parent().name() : bracketed(message, "element");
    const std::string what = attribute.empty() ? "<" + element + "> in <" + parent + ">"
                                               : "the attribute " + attribute + " of <" + element + ">";
    diagnostics.warning(at ? at.where() : model.where(), "unknown-element",
                        what + " is not known to SDFormat and is ignored",
                        "Check the spelling and the place.");
}

}  // namespace

std::size_t report_libsdformat_errors(const sdf::Errors& errors, const Element& model,
                                      const std::function<Element(const sdf::Error&)>& locate,
                                      Diagnostics& diagnostics) {
    const bool joint_to_nowhere = std::any_of(errors.begin(), errors.end(), is_joint_to_nowhere);
    constexpr const char* kRemedy = "Write what the SDFormat specification says (http://sdformat.org/spec).";
    std::size_t reported = 0;
    for (const sdf::Error& error : errors) {
        if (is_consequence(error, joint_to_nowhere, reported)) continue;
        const Element at = locate(error);
        const std::string message = trimmed(error.Message());
        if (message.find("not defined in SDF") != std::string::npos) {
            report_unknown(message, at, model, diagnostics);
            continue;
        }
        // The first unreadable element says it all; its parents repeat it.
        if (error.Code() == sdf::ErrorCode::ELEMENT_INVALID && reported > 0) continue;
        if (at && message.rfind("Error reading element", 0) == 0) {
            diagnostics.error(at.where(), "bad-value",
                              "<" + std::string(at.node.name()) + "> in <" + at.node.parent().name() +
                                  "> is '" + at.node.text().get() + "', which is no value for it",
                              kRemedy);
        } else {
            const SourceLocation where = (at ? at : element_named_in(message, model)).where();
            diagnostics.error(where, "sdf", "model '" + model.name() + "': " + message, kRemedy);
        }
        ++reported;
    }
    return reported;
}

}  // namespace roboss::sdf_import
