// HeadlessBrowser: headless Chromium, controlled over two pipes (the Chrome DevTools Protocol,
// --remote-debugging-pipe). It ends with this object.
#pragma once

#include <sys/types.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/result.h"

namespace roboss {

class HeadlessBrowser {
  public:
    /// Starts the browser found by PATH (chromium, google-chrome ...) or named by ROBOSS_BROWSER, with one
    /// page of this size in pixels. While it is waited for, `serve` is called again and again: the page may
    /// need this thread. False ends the wait, with an Error.
    static Result<std::unique_ptr<HeadlessBrowser>> start(int width, int height, std::function<bool()> serve);
    ~HeadlessBrowser();
    HeadlessBrowser(const HeadlessBrowser&) = delete;
    HeadlessBrowser& operator=(const HeadlessBrowser&) = delete;

    Result<> open(const std::string& url);
    /// The value of a JavaScript expression, as JSON; of a Promise what it promises.
    Result<nlohmann::json> evaluate(const std::string& expression);
    /// What the page shows, as a PNG file.
    Result<std::string> picture();

  private:
    explicit HeadlessBrowser(std::function<bool()> serve) : serve_(std::move(serve)) {}
    Result<nlohmann::json> call(const std::string& method,
                                nlohmann::json parameters = nlohmann::json::object());
    Result<nlohmann::json> next_message();

    std::function<bool()> serve_;
    pid_t id_ = -1;
    int to_ = -1, from_ = -1;
    std::string folder_;   // of its profile, removed at the end
    std::string session_;  // of the page
    std::string unread_;
    int number_ = 0;
};

}  // namespace roboss
