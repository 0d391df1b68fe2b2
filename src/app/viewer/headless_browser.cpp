// Runs Chromium with two pipes: JSON messages, each terminated by a zero byte.
#include "app/viewer/headless_browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace roboss {
namespace {

using Json = nlohmann::json;

constexpr auto kAnswersWithin = std::chrono::seconds(60);  // software rendering on a busy machine is slow
constexpr int kServeEvery_ms = 5;

std::string find_browser() {
    if (const char* named = std::getenv("ROBOSS_BROWSER")) return named;
    const char* path = std::getenv("PATH");
    std::string folders = path == nullptr ? "/usr/bin:/bin" : path;
    for (const char* name :
         {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"})
        for (std::size_t begin = 0; begin <= folders.size();) {
            const std::size_t end = std::min(folders.find(':', begin), folders.size());
            const std::string file = folders.substr(begin, end - begin) + "/" + name;
            if (access(file.c_str(), X_OK) == 0) return file;
            begin = end + 1;
        }
    return {};
}

std::string from_base64(const std::string& text) {
    static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string::npos) break;
        bits = bits << 6 | static_cast<unsigned>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xFFu);
    }
    return bytes;
}

Error gone() {
    return {"the browser has ended", "start it by hand (chromium --headless) and look for errors",
            "browser-ended"};
}

/// In the child: its ends of the pipes become 3 and 4, as the browser wants them.
[[noreturn]] void become(const std::vector<std::string>& words, int read_end, int write_end) {
    const int in = fcntl(read_end, F_DUPFD, 10), out = fcntl(write_end, F_DUPFD, 10);
    dup2(in, 3), dup2(out, 4);
    const int nowhere = ::open("/dev/null", O_RDWR);
    dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    close_range(5, ~0u, 0);
    setpgid(0, 0);
    std::vector<char*> pointers;
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    execv(pointers[0], pointers.data());
    _exit(127);
}

}  // namespace

Result<std::unique_ptr<HeadlessBrowser>> HeadlessBrowser::start(int width, int height,
                                                                std::function<bool()> serve) {
    const std::string browser = find_browser();
    if (browser.empty())
        return Error{"Chromium was not found",
                     "install it (apt-get install chromium), or set ROBOSS_BROWSER to its path",
                     "no-browser"};
    std::string folder = (std::filesystem::temp_directory_path() / "roboss-browser-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr)
        return Error{"cannot create the folder " + folder + " for the browser", "free some space there"};
    std::unique_ptr<HeadlessBrowser> result(new HeadlessBrowser(std::move(serve)));
    result->folder_ = folder;
    std::vector<std::string> words{browser,
                                   "--headless=new",
                                   "--remote-debugging-pipe",
                                   "--use-gl=angle",
                                   "--use-angle=swiftshader",
                                   "--enable-unsafe-swiftshader",
                                   "--hide-scrollbars",
                                   "--no-first-run",
                                   "--disable-dev-shm-usage",
                                   "--user-data-dir=" + folder,
                                   "--window-size=" + std::to_string(width) + "," + std::to_string(height)};
    if (geteuid() == 0) words.push_back("--no-sandbox");
    words.push_back("about:blank");
    std::array<int, 2> in{}, out{};
    if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0)
        return Error{"cannot create a pipe", "see the limits (ulimit -n)"};
    result->id_ = fork();
    if (result->id_ == 0) become(words, in[0], out[1]);
    close(in[0]), close(out[1]);
    result->to_ = in[1], result->from_ = out[0];
    if (result->id_ < 0) return Error{"a process could not be started", "see the limits (ulimit -u)"};
    ::signal(SIGPIPE, SIG_IGN);

    Result<Json> target = result->call("Target.createTarget", {{"url", "about:blank"}});
    if (!target) return target.error();
    Result<Json> session =
        result->call("Target.attachToTarget", {{"targetId", target.value()["targetId"]}, {"flatten", true}});
    if (!session) return session.error();
    result->session_ = session.value().value("sessionId", "");
    Result<Json> sized =
        result->call("Emulation.setDeviceMetricsOverride",
                     {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
    if (!sized) return sized.error();
    return result;
}

HeadlessBrowser::~HeadlessBrowser() {
    if (to_ >= 0) close(to_);
    if (from_ >= 0) close(from_);
    if (id_ > 0) {
        ::kill(-id_, SIGKILL);  // it has child processes
        ::kill(id_, SIGKILL);
        waitpid(id_, nullptr, 0);
    }
    std::error_code none;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, none);
}

Result<> HeadlessBrowser::open(const std::string& url) {
    Result<Json> answer = call("Page.navigate", {{"url", url}});
    if (!answer) return answer.error();
    if (answer.value().contains("errorText"))
        return Error{"the page cannot be opened: " + answer.value().value("errorText", ""),
                     "build the viewer's page, or give its folder with --web"};
    return Ok{};
}

Result<Json> HeadlessBrowser::evaluate(const std::string& expression) {
    Result<Json> answer = call("Runtime.evaluate",
                               {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
    if (!answer) return answer.error();
    return answer.value().value("result", Json::object()).value("value", Json());
}

Result<std::string> HeadlessBrowser::picture() {
    Result<Json> answer = call("Page.captureScreenshot", {{"format", "png"}});
    if (!answer) return answer.error();
    return from_base64(answer.value().value("data", ""));
}

Result<Json> HeadlessBrowser::call(const std::string& method, Json parameters) {
    const int number = ++number_;
    Json message{{"id", number}, {"method", method}, {"params", std::move(parameters)}};
    if (!session_.empty()) message["sessionId"] = session_;
    const std::string text = message.dump();
    for (std::size_t done = 0; done <= text.size();) {  // including the terminating zero
        const ssize_t n = ::write(to_, text.c_str() + done, text.size() + 1 - done);
        if (n <= 0) return gone();
        done += static_cast<std::size_t>(n);
    }
    for (;;) {
        Result<Json> answer = next_message();
        if (!answer) return answer.error();
        if (answer.value().value("id", 0) != number) continue;  // an event
        if (!answer.value().contains("error")) return answer.value().value("result", Json::object());
        return Error{"the browser refuses " + method + ": " + answer.value()["error"].value("message", ""),
                     "install a recent Chromium"};
    }
}

Result<Json> HeadlessBrowser::next_message() {
    const auto end_of_patience = std::chrono::steady_clock::now() + kAnswersWithin;
    for (;;) {
        if (const std::size_t end = unread_.find('\0'); end != std::string::npos) {
            Json message = Json::parse(unread_.substr(0, end), nullptr, false);
            unread_.erase(0, end + 1);
            if (message.is_discarded()) return gone();
            return message;
        }
        pollfd waits{from_, POLLIN, 0};
        if (poll(&waits, 1, kServeEvery_ms) <= 0) {
            if (!serve_())
                return Error{"the run ended before the picture was drawn", "see the messages above",
                             "no-picture"};
            if (std::chrono::steady_clock::now() > end_of_patience)
                return Error{"the browser does not respond", "try again when the machine is less busy",
                             "no-picture"};
            continue;
        }
        std::array<char, 65536> buffer;
        const ssize_t n = ::read(from_, buffer.data(), buffer.size());
        if (n <= 0) return gone();
        unread_.append(buffer.data(), static_cast<std::size_t>(n));
    }
}

}  // namespace roboss
