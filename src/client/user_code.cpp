// One pointer per thread.
#include "client/user_code.h"

namespace roboss {
namespace {

thread_local const UserCode* g_running = nullptr;

}  // namespace

UserCode::UserCode(const std::string& program, const char* what)
    : program_(program.c_str()), what_(what), outer_(g_running) {
    g_running = this;
}

UserCode::~UserCode() {
    g_running = outer_;
}

const UserCode* UserCode::running() {
    return g_running;
}

}  // namespace roboss
