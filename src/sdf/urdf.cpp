// Converts URDF to SDF text and maps lines by the names of links and joints.
#include "sdf/urdf.h"

#include <map>
#include <sdf/sdf.hh>
#include <sstream>

#include "sdf/console_capture.h"

namespace roboss::sdf_import {
namespace {

std::string text_of(const SourceFile& file) {
    std::ostringstream text;
    file.root().print(text, "", pugi::format_raw);
    return text.str();
}

/// For each line of the SDF the line of the URDF link or joint it came from (the robot's until the first).
std::vector<int> map_lines(const SourceFile& urdf, const std::string& sdf) {
    std::map<std::string, int> line_of;
    for (const auto node : urdf.root().children()) {
        if (node.attribute("name")) line_of.emplace(std::string(node.name()) + " " + node.attribute("name").value(), urdf.line(node));
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

}  // namespace

std::unique_ptr<SourceFile> urdf_to_sdf(const SourceFile& urdf, Diagnostics& diagnostics) {
    const SourceLocation where = urdf.where(urdf.root());
    sdf::Errors errors;
    std::string text;
    std::vector<ConsoleLine> printed;
    {
        const ConsoleCapture capture;
        try {
            const sdf::SDFPtr document = std::make_shared<sdf::SDF>();
            sdf::init(document);
            sdf::ParserConfig config;
            if (sdf::readString(text_of(urdf), config, document, errors)) text = document->Root()->ToString("");
        } catch (const std::exception& exception) {
            errors.emplace_back(sdf::ErrorCode::STRING_READ, exception.what());
        }
        printed = capture.lines();
    }
    for (const ConsoleLine& line : printed) {
        if (line.is_error) {
            diagnostics.error(where, "urdf", line.text, "Correct the URDF (check_urdf FILE tells more).");
        } else {
            diagnostics.warning(where, "urdf", line.text);
        }
    }
    for (const sdf::Error& error : errors) {
        diagnostics.error(where, "urdf", error.Message(), "Correct the URDF (check_urdf FILE tells more).");
    }
    if (text.empty()) {
        if (!diagnostics.has_errors()) {
            diagnostics.error(where, "urdf", "libsdformat cannot read this <robot> as URDF",
                              "Check it with: check_urdf FILE.");
        }
        return nullptr;
    }
    std::vector<int> lines = map_lines(urdf, text);
    return SourceFile::from_text(urdf.path(), std::move(text), std::move(lines), diagnostics);
}

}  // namespace roboss::sdf_import
