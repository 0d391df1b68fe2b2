// A thin owner of an SQLite connection: prepared statements with typed values, errors as Result.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace roboss {

using Blob = std::vector<std::uint8_t>;
using Value = std::variant<std::int64_t, std::string, Blob>;
using Row = std::vector<Value>;

class Database {
  public:
    static Result<Database> open_write(const std::string& path);  // made if it does not exist
    static Result<Database> open_read(const std::string& path);   // must exist

    Result<> run(const std::string& sql);
    /// One statement for many rows of parameters.
    Result<> insert(const std::string& sql, const std::vector<Row>& rows);
    Result<std::vector<Row>> select(const std::string& sql, const Row& parameters = {}) const;
    /// The same one by one, for more rows than memory should hold. An Error of `take` ends it.
    Result<> each(const std::string& sql, const Row& parameters,
                  const std::function<Result<>(Row)>& take) const;

  private:
    struct Close {
        void operator()(sqlite3* db) const;
    };
    Error error(const std::string& doing) const;

    std::string path_;
    std::unique_ptr<sqlite3, Close> db_;
};

}  // namespace roboss
