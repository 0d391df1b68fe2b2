// Redirects sdf::Console, std::cerr and std::cout (urdfdom logs there through console_bridge).
#include "sdf/console_capture.h"

#include <iostream>
#include <sdf/Console.hh>

namespace roboss::sdf_import {
namespace {

/// Takes "\033[1;33m" and the like away.
std::string without_colours(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\033') {
            while (i < text.size() && text[i] != 'm') ++i;
            continue;
        }
        result += text[i];
    }
    return result;
}

bool starts_with(const std::string& text, const char* prefix) {
    return text.rfind(prefix, 0) == 0;
}

/// "Warning [Utils.cc:129] message" -> message; "Error:   message" -> message.
ConsoleLine parsed(const std::string& line) {
    ConsoleLine result;
    result.is_error = starts_with(line, "Error");
    std::size_t start = 0;
    if (starts_with(line, "Error [") || starts_with(line, "Warning [")) start = line.find(']') + 1;
    if (starts_with(line, "Error:") || starts_with(line, "Warning:")) start = line.find(':') + 1;
    result.text = line.substr(start);
    result.text.erase(0, result.text.find_first_not_of(' '));
    return result;
}

std::mutex one_capture;

}  // namespace

ConsoleCapture::ConsoleCapture() : alone_(one_capture) {
    auto& stream = sdf::Console::Instance()->GetMsgStream();
    console_before_ = stream.GetStream();
    stream.SetStream(&captured_);
    cerr_before_ = std::cerr.rdbuf(captured_.rdbuf());
    cout_before_ = std::cout.rdbuf(captured_.rdbuf());
}

ConsoleCapture::~ConsoleCapture() {
    std::cout.rdbuf(cout_before_);
    std::cerr.rdbuf(cerr_before_);
    sdf::Console::Instance()->GetMsgStream().SetStream(console_before_);
}

std::vector<ConsoleLine> ConsoleCapture::lines() const {
    std::vector<ConsoleLine> result;
    std::istringstream text(without_colours(captured_.str()));
    for (std::string line; std::getline(text, line);) {
        if (line.find_first_not_of(" \t") == std::string::npos) continue;
        // urdfdom adds a second line with its own source position.
        if (starts_with(line, "         at line ")) continue;
        result.push_back(parsed(line));
    }
    return result;
}

}  // namespace roboss::sdf_import
