// See worker.h. Parent and child exchange a number of ticks (0: judge) and a Report, as bytes over two pipes.
#include "peers/worker.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>

#include "core/check.h"
#include "peers/trial.h"

namespace roboss::bench {
namespace {

void copy_text(char* to, std::size_t size, const std::string& from) {
    std::snprintf(to, size, "%s", from.c_str());
}

bool send(int pipe, const void* data, std::size_t size) {
    return write(pipe, data, size) == static_cast<ssize_t>(size);
}

/// All bytes or nothing.
bool receive(int pipe, void* data, std::size_t size) {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = read(pipe, static_cast<char*>(data) + done, size - done);
        if (got <= 0) return false;
        done += static_cast<std::size_t>(got);
    }
    return true;
}

/// Answers until the parent closes its end.
void serve(const EngineKind& kind, const Scene& scene, double accuracy, int in, int out) {
    std::unique_ptr<Trial> trial;
    for (int ticks = 0; receive(in, &ticks, sizeof ticks);) {
        Report report;
        try {
            if (!trial) trial = std::make_unique<Trial>(kind, scene, accuracy);
            if (ticks > 0) {
                report.cpu_s = trial->run(ticks).cpu;
            } else {
                const Verdict verdict = trial->judge();
                report.good = verdict.good;
                copy_text(report.text, sizeof report.text, verdict.text);
            }
            report.build_s = trial->build_s();
            report.bytes = trial->memory_bytes();
            copy_text(report.engine, sizeof report.engine, trial->engine().name());
            copy_text(report.settings, sizeof report.settings, trial->engine().settings());
        } catch (const std::exception& error) {
            report.failed = true;
            copy_text(report.text, sizeof report.text, error.what());
        }
        if (!send(out, &report, sizeof report) || report.failed) return;
    }
}

Report failure(const std::string& why) {
    Report report;
    report.failed = true;
    copy_text(report.text, sizeof report.text, why);
    return report;
}

}  // namespace

Worker::Worker(const EngineKind& kind, const Scene& scene, double accuracy) {
    int orders[2], reports[2];
    ROBOSS_CHECK(pipe2(orders, O_CLOEXEC) == 0 && pipe2(reports, O_CLOEXEC) == 0, "pipe");
    std::fflush(nullptr);
    child_ = fork();
    ROBOSS_CHECK(child_ >= 0, "fork");
    if (child_ == 0) {
        close(orders[1]), close(reports[0]);
        serve(kind, scene, accuracy, orders[0], reports[1]);
        _exit(0);
    }
    close(orders[0]), close(reports[1]);
    to_child_ = orders[1], from_child_ = reports[0];
}

Worker::~Worker() {
    end();
}

void Worker::end() {
    if (child_ < 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    close(to_child_), close(from_child_);
    child_ = -1;
}

Report Worker::run(int ticks, double limit_s) {
    return ask(ticks, limit_s);
}

Report Worker::judge(double limit_s) {
    return ask(0, limit_s);
}

Report Worker::ask(int ticks, double limit_s) {
    Report report;
    if (!send(to_child_, &ticks, sizeof ticks)) return end(), failure("the engine's process has ended");
    pollfd answer{from_child_, POLLIN, 0};
    const int ready = poll(&answer, 1, static_cast<int>(1e3 * limit_s));
    if (ready == 0) {
        char why[80];
        std::snprintf(why, sizeof why, "took longer than %.0f s", limit_s);
        return end(), failure(why);
    }
    if (!receive(from_child_, &report, sizeof report)) {
        int status = 0;
        waitpid(child_, &status, 0);
        close(to_child_), close(from_child_);
        child_ = -1;
        return failure(WIFSIGNALED(status) ? std::string("the engine crashed: ") + strsignal(WTERMSIG(status))
                                           : "the engine ended its process");
    }
    if (report.failed) end();
    return report;
}

}  // namespace roboss::bench
