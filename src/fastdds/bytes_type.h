// Data of DDS that are bytes: std::string where they arrive, std::string_view where they are sent.
#pragma once

#include <string>
#include <string_view>

#include "fastdds/versions.h"

namespace roboss::fastdds {

/// A type of messages whose data are CDR that others encode and read.
class BytesType final : public NamedType {
  public:
    using NamedType::NamedType;

    std::string_view bytes_of(const void* data) const override {
        return *static_cast<const std::string_view*>(data);
    }
    bool keep(std::string_view bytes, void* data) const override {
        static_cast<std::string*>(data)->assign(bytes);
        return true;
    }
    void* make() const override { return new std::string; }
    void free(void* data) const override { delete static_cast<std::string*>(data); }
};

}  // namespace roboss::fastdds
