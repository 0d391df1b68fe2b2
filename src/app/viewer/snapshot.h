// A picture of a run as its viewer shows it, drawn by a headless browser.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "model/model.h"

namespace roboss {

struct SnapshotOptions {
    std::string file;  // PNG; empty: none is taken
    int width = 1280, height = 800;
    std::vector<std::pair<std::string, std::string>> parameters;  // of the page's URL (docs/viewer-page.md)
};
void add_snapshot_options(CLI::App& command, SnapshotOptions& options);

/// Before the run: whether the robots that the options name are there, and the viewer's page.
Result<> check_snapshot(const SnapshotOptions& options, const std::string& page_folder, const Model& model);

/// Takes the picture of the page at `url`; `serve` drives the run meanwhile; false ends it.
Result<> take_snapshot(const SnapshotOptions& options, const std::string& url,
                       const std::function<bool()>& serve);

void add_snapshot_command(CLI::App& app, int& exit_code);

}  // namespace roboss
