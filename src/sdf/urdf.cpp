// Converts URDF to SDF text and maps lines by the names of links and joints.
#include "sdf/urdf.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <sdf/sdf.hh>
#include <sstream>
#include <string_view>

#include "sdf/console_capture.h"
#include "sdf/urdf_control.h"
#include "sdf/urdf_repairs.h"

namespace roboss::sdf_import {
namespace {

std::string text_of(pugi::xml_node robot) {
    std::ostringstream text;
    robot.print(text, "", pugi::format_raw);
    return text.str();
}

/// Without its inertial, a link would be left out with all that hangs on it.
bool loses_a_link(const std::string& message) {
    return message.find("Could not parse inertial") != std::string::npos;
}

/// Errors name links and joints as "[name]": the line of that element, else the robot's.
SourceLocation where_of(const std::string& message, const SourceFile& urdf) {
    for (const auto node : urdf.root().children()) {
        const std::string name = node.attribute("name").value();
        if (!name.empty() && message.find("[" + name + "]") != std::string::npos) return urdf.where(node);
    }
    return urdf.where(urdf.root());
}

/// libsdformat 12 leaves <mimic> out of a URDF without a word: writes it into the joint's <axis>, on the same
/// line, for the importer to read.
void add_mimics(pugi::xml_node robot, std::string& sdf) {
    for (const auto joint : robot.children("joint")) {
        const auto mimic = joint.child("mimic");
        if (!mimic) continue;
        const std::size_t at = sdf.find("<joint name='" + std::string(joint.attribute("name").value()) + "'");
        const std::size_t axis = at == std::string::npos ? at : sdf.find("<axis>", at);
        if (axis == std::string::npos || axis > sdf.find("</joint>", at)) continue;
        const auto number = [&](const char* name, const char* otherwise) {
            return "<" + std::string(name) + ">" + mimic.attribute(name).as_string(otherwise) + "</" + name +
                   ">";
        };
        sdf.insert(axis + 6, "<mimic joint='" + std::string(mimic.attribute("joint").value()) +
                                 "' axis='axis'>" + number("multiplier", "1") + number("offset", "0") +
                                 "</mimic>");
    }
}

/// Gives the joints their own types back, on the same line.
void add_joint_types(const std::map<std::string, std::string>& types, std::string& sdf) {
    for (const auto& [name, type] : types) {
        const std::size_t at = sdf.find("<joint name='" + name + "'");
        const std::size_t end = at == std::string::npos ? at : sdf.find('>', at);
        if (end != std::string::npos) sdf.insert(end + 1, "<roboss:joint type='" + type + "'/>");
    }
}

/// Gives the joints the positions that they start at, on the same line.
void add_initial_positions(const std::map<std::string, std::string>& positions, std::string& sdf) {
    for (const auto& [joint, position] : positions) {
        const std::size_t at = sdf.find("<joint name='" + joint + "'");
        const std::size_t axis = at == std::string::npos ? at : sdf.find("<axis>", at);
        if (axis == std::string::npos || axis > sdf.find("</joint>", at)) continue;
        sdf.insert(axis + 6, "<initial_position>" + position + "</initial_position>");
    }
}

/// Gives the cameras their own <horizontal_fov> back, on the same line.
void add_views(const std::map<std::string, std::string>& views, std::string& sdf) {
    const std::string begin = "<horizontal_fov>", end = "</horizontal_fov>";
    for (const auto& [sensor, view] : views) {
        const std::size_t at = sdf.find("<sensor name='" + sensor + "'");
        const std::size_t from = at == std::string::npos ? at : sdf.find(begin, at);
        if (from == std::string::npos || from > sdf.find("</sensor>", at)) continue;
        const std::size_t text = from + begin.size();
        sdf.replace(text, sdf.find(end, text) - text, view);
    }
}

/// Each <inertial> becomes one that is computed from the link's collisions, those merged into it included.
void make_inertials_automatic(std::string& sdf) {
    const std::string begin = "<inertial>", end = "</inertial>", automatic = "<inertial auto='true'/>";
    for (std::size_t at = 0; (at = sdf.find(begin, at)) != std::string::npos; at += automatic.size()) {
        const std::size_t to = sdf.find(end, at);
        if (to == std::string::npos) return;
        sdf.replace(at, to + end.size() - at, automatic);
    }
}

/// The elements of a transmission with their texts, but for the joints that it names.
void list_parts(pugi::xml_node parent, std::string& parts) {
    for (const auto node : parent.children()) {
        if (node.type() != pugi::node_element) continue;
        if (const std::string name = node.name(); name != "joint" && name != "actuator")
            parts += (parts.empty() ? "<" : ", <") + name + "> " + node.text().get();
        list_parts(node, parts);
    }
}

/// libsdformat leaves transmissions out silently.
void report_transmissions(const SourceFile& urdf, Diagnostics& diagnostics) {
    for (const auto node : urdf.root().children("transmission")) {
        std::string joints, parts;
        for (const auto joint : node.children("joint"))
            joints += " '" + std::string(joint.attribute("name").value()) + "'";
        list_parts(node, parts);
        diagnostics.note(urdf.where(node), "transmission",
                         "transmission '" + std::string(node.attribute("name").value()) +
                             "' has no effect: motors act on the joint" + joints +
                             " itself, without gears and hardware interface. Ignored: " +
                             (parts.empty() ? "all of it" : parts),
                         "Give setpoints and limits at the joint; write a rotor's inertia, times the square "
                         "of the reduction, as <armature> of <roboss:motor> in SDFormat.");
    }
}

/// Whether the SDF has the link, or a frame where it was merged into its parent.
bool has_link(const std::string& sdf, const std::string& name) {
    return sdf.find("<link name='" + name + "'") != std::string::npos ||
           sdf.find("<frame name='" + name + "'") != std::string::npos;
}

/// The three numbers of an attribute; zeros if it is missing; empty: they are no numbers.
std::string three_numbers(pugi::xml_attribute attribute) {
    std::istringstream words(attribute.as_string("0 0 0"));
    std::string text, word;
    for (int i = 0; i < 3; ++i) {
        if (!(words >> word)) return {};
        char* end = nullptr;
        if (!std::isfinite(std::strtod(word.c_str(), &end)) || *end != 0) return {};
        text += (i == 0 ? "" : " ") + word;
    }
    return text;
}

/// Whether a frame of the SDF may have the name of this link.
bool may_name_a_frame(const std::string& link) {
    return link != "world" && link.rfind("__", 0) != 0 && link.find_first_of("'<>&") == std::string::npos;
}

/// The <frame> of a link that a fixed joint merges into its parent, or into what that is merged into; empty:
/// no such link, or lost. `depth`: how many parents may follow (a loop of joints has no end).
std::string frame_of_merged(pugi::xml_node robot, const std::string& sdf, const std::string& link,
                            std::size_t depth) {
    if (depth == 0 || !may_name_a_frame(link)) return {};
    for (const auto joint : robot.children("joint")) {
        if (link != joint.child("child").attribute("link").value()) continue;
        const std::string parent = joint.child("parent").attribute("link").value();
        const std::string xyz = three_numbers(joint.child("origin").attribute("xyz")),
                          rpy = three_numbers(joint.child("origin").attribute("rpy"));
        if (std::strcmp(joint.attribute("type").value(), "fixed") != 0 || xyz.empty() || rpy.empty())
            return {};
        if (!has_link(sdf, parent) && frame_of_merged(robot, sdf, parent, depth - 1).empty()) return {};
        return "<frame name='" + link + "' attached_to='" + parent + "'><pose>" + xyz + " " + rpy +
               "</pose></frame>";
    }
    return {};
}

/// libsdformat 12 merges links at fixed joints without a trace: they become frames, on the line of the
/// model's end.
void add_merged_links(pugi::xml_node robot, std::string& sdf) {
    const auto joints = robot.children("joint");
    const auto count = static_cast<std::size_t>(std::distance(joints.begin(), joints.end()));
    std::string frames;
    for (const auto link : robot.children("link")) {
        const std::string name = link.attribute("name").value();
        if (!has_link(sdf, name)) frames += frame_of_merged(robot, sdf, name, count);
    }
    if (const std::size_t end = sdf.rfind("</model>"); end != std::string::npos) sdf.insert(end, frames);
}

/// "'a', 'b' and 10 more".
std::string first_of(const std::vector<std::string>& names) {
    constexpr std::size_t kShown = 5;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i)
        text += (i == 0 ? "'" : ", '") + names[i] + "'";
    if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
    return text;
}

/// libsdformat leaves out a moving link without mass, and all that hangs on it, silently; so it does with
/// what moves on a link without mass that a fixed joint merges. `robot`: repaired, with the same links in the
/// same order. False: nothing is left.
bool report_lost_links(const SourceFile& urdf, pugi::xml_node robot, const std::string& sdf,
                       Diagnostics& diagnostics) {
    std::vector<std::string> without, lost;
    SourceLocation where;
    auto repaired = robot.child("link");
    for (const auto link : urdf.root().children("link")) {
        const std::string name = link.attribute("name").value(), now = repaired.attribute("name").value();
        repaired = repaired.next_sibling("link");
        if (name == "world" || has_link(sdf, now)) continue;
        if (lost.empty()) where = urdf.where(link);
        lost.push_back(name);
        if (link.child("inertial")) continue;
        if (without.empty()) where = urdf.where(link);
        without.push_back(name);
    }
    if (lost.empty()) return true;
    const bool any = sdf.find("<link name=") != std::string::npos;
    const std::string left_out = std::to_string(lost.size()) + (lost.size() == 1 ? " link" : " links");
    std::string message =
        "left out, because they hang on links without mass, are " + left_out + ": " + first_of(lost);
    if (!without.empty())
        message = "<inertial> is missing in " + std::to_string(without.size()) +
                  (without.size() == 1 ? " link: " : " links: ") + first_of(without) +
                  (any ? "; left out, with what hangs on them, are " + left_out
                       : "; no link is left that could be simulated");
    const char* const remedy =
        "Give each link, and those that they hang on, an <inertial> with <mass> and <inertia>.";
    if (any)
        diagnostics.warning(where, "no-inertial", message, remedy);
    else
        diagnostics.error(where, "no-inertial", message, remedy);
    return any;
}

/// For each line of the SDF the line of the URDF link or joint it came from (the robot's until the first).
/// `robot`: repaired, with the same parts in the same order.
std::vector<int> map_lines(const SourceFile& urdf, pugi::xml_node robot, const std::string& sdf) {
    std::map<std::string, int> line_of;
    auto repaired = robot.first_child();
    for (const auto node : urdf.root().children()) {
        if (node.attribute("name"))
            line_of.emplace(std::string(node.name()) + " " + repaired.attribute("name").value(),
                            urdf.line(node));
        repaired = repaired.next_sibling();
    }
    std::vector<int> lines;
    int line = urdf.line(urdf.root());
    std::istringstream stream(sdf);
    for (std::string text; std::getline(stream, text);) {
        for (const std::string tag : {"link", "joint"}) {
            const std::size_t at = text.find("<" + tag + " name='");
            if (at == std::string::npos) continue;
            const std::size_t from = at + tag.size() + 8;
            const auto found = line_of.find(tag + " " + text.substr(from, text.find('\'', from) - from));
            if (found != line_of.end()) line = found->second;
        }
        lines.push_back(line);
    }
    return lines;
}

/// The first element that xacro would expand: one of its own, or one with ${...} or $(...) in an attribute.
pugi::xml_node find_xacro(pugi::xml_node parent) {
    for (const auto node : parent.children()) {
        if (std::string_view(node.name()).starts_with("xacro:")) return node;
        for (const auto attribute : node.attributes()) {
            const std::string_view value = attribute.value();
            if (value.find("${") != value.npos || value.find("$(") != value.npos) return node;
        }
        if (const auto found = find_xacro(node)) return found;
    }
    return {};
}

/// True, and an error, for a file that xacro has not expanded yet.
bool report_xacro(const SourceFile& urdf, Diagnostics& diagnostics) {
    const auto node = find_xacro(urdf.root());
    if (!node) return false;
    diagnostics.error(urdf.where(node), "xacro",
                      "the file holds xacro macros (<" + std::string(node.name()) +
                          ">), which are expanded before it is URDF",
                      "Run: xacro FILE > robot.urdf (of ROS, or pip install xacro), and give robot.urdf.");
    return true;
}

}  // namespace

std::unique_ptr<SourceFile> urdf_to_sdf(const SourceFile& urdf, Diagnostics& diagnostics) {
    if (report_xacro(urdf, diagnostics)) return nullptr;
    const SourceLocation where = urdf.where(urdf.root());
    pugi::xml_document repaired;
    repaired.append_copy(urdf.root());
    const pugi::xml_node robot = repaired.document_element();
    repair_urdf(robot, urdf, diagnostics);
    const bool masses_follow = stand_in_for_masses(robot, urdf, diagnostics);
    report_transmissions(urdf, diagnostics);
    const auto positions = read_ros2_control(robot, urdf, diagnostics);
    const auto joint_types = replace_joint_types(robot, urdf, diagnostics);
    const auto views = replace_narrow_views(robot);
    sdf::Errors errors;
    std::string text;
    std::vector<ConsoleLine> printed;
    {
        const ConsoleCapture capture;
        try {
            const sdf::SDFPtr document = std::make_shared<sdf::SDF>();
            sdf::init(document);
            sdf::ParserConfig config;
            if (sdf::readString(text_of(robot), config, document, errors))
                text = document->Root()->ToString("");
        } catch (const std::exception& exception) {
            errors.emplace_back(sdf::ErrorCode::STRING_READ, exception.what());
        }
        printed = capture.lines();
    }
    constexpr const char* kRemedy = "Correct the URDF (check_urdf FILE tells more).";
    for (const ConsoleLine& line : printed) {
        // urdfdom goes on without what it cannot read, a visual for instance.
        if (line.is_error && (text.empty() || loses_a_link(line.text))) {
            diagnostics.error(where_of(line.text, urdf), "urdf", line.text, kRemedy);
        } else {
            diagnostics.warning(where_of(line.text, urdf), "urdf", line.text);
        }
    }
    for (const sdf::Error& error : errors) diagnostics.error(where, "urdf", error.Message(), kRemedy);
    if (text.empty()) {
        if (!diagnostics.has_errors()) {
            diagnostics.error(where, "urdf", "libsdformat cannot read this <robot> as URDF",
                              "Check it with: check_urdf FILE.");
        }
        return nullptr;
    }
    add_merged_links(robot, text);
    if (!report_lost_links(urdf, robot, text, diagnostics)) return nullptr;
    if (masses_follow) make_inertials_automatic(text);
    add_mimics(robot, text);
    add_initial_positions(positions, text);
    add_joint_types(joint_types, text);
    add_views(views, text);
    std::vector<int> lines = map_lines(urdf, robot, text);
    return SourceFile::from_text(urdf.path(), std::move(text), std::move(lines), diagnostics);
}

}  // namespace roboss::sdf_import
