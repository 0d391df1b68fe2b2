// The viewer of a run or of a cluster: its options, the same for all subcommands, and its gateway.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "gateway/gateway.h"

namespace roboss {

struct ViewerOptions {
    std::string listen = "8090";      // [ADDRESS:]PORT
    std::string page_folder;          // empty: where it was built or installed
    bool headless = false;            // none at all
    std::string role = "administer";  // the greatest that a page gets
    std::string certificate, key;     // PEM files; empty: made for this run where one is needed
    std::string users;  // file of those who may open the page; empty: holders of a token of the run
};
enum class ViewerDefault {
    kAlways,    // there is a viewer
    kOn,        // unless disabled with --headless
    kOnDemand,  // only if --view asks for it
};
void add_viewer_options(CLI::App& command, ViewerOptions& options, ViewerDefault by_default);

/// Listens; `journal`: the run keeps one; `insecure`: also without encryption.
Result<std::unique_ptr<Gateway>> open_viewer(const ViewerOptions& options, bool journal, bool insecure);

/// Prints where the viewer is found, for each role, and the fingerprint of its certificate.
void print_urls(const Gateway& gateway);

}  // namespace roboss
