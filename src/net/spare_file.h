// SpareFile: a file descriptor that is kept for the moment when there is no other.
#pragma once

#include <fcntl.h>
#include <unistd.h>

namespace roboss {

class SpareFile {
  public:
    SpareFile() { take(); }
    ~SpareFile() { give_back(); }
    SpareFile(const SpareFile&) = delete;
    SpareFile& operator=(const SpareFile&) = delete;

    bool is_there() const { return file_ >= 0; }
    /// False: it is not there.
    bool give_back() {
        if (file_ < 0) return false;
        ::close(file_);
        file_ = -1;
        return true;
    }
    void take() {
        if (file_ < 0) file_ = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    }

  private:
    int file_ = -1;
};

}  // namespace roboss
