// Options and addresses.
#include "app/viewer/viewer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "app/output/say.h"
#include "app/viewer/page_users.h"
#include "net/key_folder.h"
#include "net/meeting_place.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUrlsOf = ".urls";  // behind the process, in the folder of runs

/// Writes addresses with tokens to a file that only this user can read. The answer: where it is.
Result<fs::path> keep_secret(const std::vector<std::string>& lines) {
    const Result<fs::path> folder = run_folder();
    if (!folder) return folder.error();
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.value(), ignored))
        if (entry.path().extension() == kUrlsOf && !is_alive(std::atoi(entry.path().stem().c_str())))
            fs::remove(entry.path(), ignored);
    const fs::path file = folder.value() / (std::to_string(getpid()) + kUrlsOf);
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    if (Result<> written = write_private(file, text); !written) return written.error();
    return file;
}

void add_access_options(CLI::App& command, ViewerOptions& o, const std::string& group) {
    CLI::Option* certificate =
        command.add_option("--view-cert", o.certificate,
                           "serve the viewer over TLS with this certificate (PEM; behind it those between it "
                           "and its authority). "
                           "Default: beyond loopback, one made for this run, whose fingerprint is printed");
    CLI::Option* key =
        command.add_option("--view-key", o.key, "key of that certificate (PEM), which only you may read");
    certificate->check(CLI::ExistingFile)->needs(key)->group(group);
    key->check(CLI::ExistingFile)->needs(certificate)->group(group);
    command
        .add_option("--view-users", o.users,
                    "file of users, each with a token and a role (`roboss keys add KEYS NAME --role steer` "
                    "writes KEYS/users); then only they may open the viewer, also on loopback")
        ->check(CLI::ExistingFile)
        ->group(group);
}

/// The user's own certificate and key, if options name their files.
Result<std::optional<KeyPair>> certificate_of(const ViewerOptions& o) {
    if (o.certificate.empty()) return std::optional<KeyPair>();
    const Result<std::string> certificate = read_text(o.certificate), key = read_private(o.key);
    for (const auto* text : {&certificate, &key})
        if (!*text) return Error{text->error().message, "see --view-cert and --view-key", text->error().code};
    return std::optional(KeyPair{certificate.value(), key.value()});
}

}  // namespace

void add_viewer_options(CLI::App& command, ViewerOptions& o, ViewerDefault by_default) {
    const std::string group = "Viewer (docs/viewer.md)";
    const bool on_demand = by_default == ViewerDefault::kOnDemand;
    CLI::Option* view =
        command.add_option("--view", o.listen,
                           std::string(on_demand ? "serve the viewer at " : "") +
                               "[ADDRESS:]PORT of the viewer for browsers; if the port is in use, the next "
                               "free one. The default address is loopback only; with any other, the page is "
                               "served over TLS and the printed URL carries a token");
    view->group(group);
    o.headless = on_demand;
    if (on_demand)
        view->each([&o](const std::string&) { o.headless = false; });
    else
        view->capture_default_str();
    command
        .add_option("--web", o.page_folder,
                    "folder of the viewer's web page (default: the built or installed one)")
        ->check(CLI::ExistingDirectory)
        ->group(group);
    command
        .add_option("--view-role", o.role,
                    "the most that a page may do: watch; steer (order robots, pause, rewind); or administer "
                    "(also save files, end the run and its Simulators)")
        ->check(CLI::IsMember({"watch", "steer", "administer"}))
        ->capture_default_str()
        ->group(group);
    add_access_options(command, o, group);
    if (by_default == ViewerDefault::kOn)
        command.add_flag("--headless", o.headless, "do not serve the viewer")->group(group);
    else if (on_demand)  // so that scripts may use the flag with every subcommand
        command
            .add_flag_callback(
                "--headless", [] {}, "do not serve the viewer (the default)")
            ->excludes(view)
            ->group(group);
}

void print_urls(const Gateway& gateway) {
    const std::string& fingerprint = gateway.fingerprint();
    if (!fingerprint.empty())
        say(stderr, "roboss: the certificate of the viewer has the SHA-256 fingerprint\n  {}\n", fingerprint);
    std::vector<std::string> lines{"viewer at " + gateway.url()};
    for (const std::string& url : gateway.other_urls()) lines.push_back("viewer " + url);
    const std::string::size_type token = lines.front().find("?token=");
    if (token == std::string::npos || isatty(STDERR_FILENO) == 1) {
        for (const std::string& line : lines) say(stderr, "roboss: {}\n", line);
        return;
    }
    const Result<fs::path> file = keep_secret(lines);
    say(stderr, "roboss: {}; {}\n", lines.front().substr(0, token),
        file ? "its addresses with their tokens are in " + file.value().string()
             : "its tokens cannot be kept: " + file.error().text());
}

Result<std::unique_ptr<Gateway>> open_viewer(const ViewerOptions& o, bool journal, bool insecure) {
    Result<std::optional<KeyPair>> certificate = certificate_of(o);
    if (!certificate) return certificate.error();
    GatewayOptions options;
    options.listen = o.listen;
    options.page_folder = o.page_folder;
    options.program = "roboss " ROBOSS_VERSION;
    options.journal = journal;
    options.role = parse_page_role(o.role).value_or(PageRole::kWatch);
    options.certificate = std::move(certificate).value();
    options.insecure = insecure;
    if (!o.users.empty()) options.users = [file = o.users] { return read_page_users(file); };
    options.new_address = [] {
        std::random_device device;
        return Address{Role::kClient, static_cast<std::uint64_t>(device()) << 32 | device()};
    };
    return Gateway::open(options);
}

}  // namespace roboss
