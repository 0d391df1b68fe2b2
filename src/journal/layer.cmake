# SQLite holds checkpoint files; no other layer knows it.
find_package(SQLite3 REQUIRED)
target_link_libraries(roboss_journal PRIVATE SQLite::SQLite3)
target_compile_definitions(roboss_journal PRIVATE ROBOSS_VERSION="${PROJECT_VERSION}")
