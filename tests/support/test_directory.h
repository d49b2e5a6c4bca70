// SPDX-License-Identifier: GPL-3.0-or-later
// A directory for the files of one test.
#ifndef GNOMON_TESTS_SUPPORT_TEST_DIRECTORY_H
#define GNOMON_TESTS_SUPPORT_TEST_DIRECTORY_H

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>

namespace gnomon::test {

/// An empty directory of its own for the running test, removed by the destructor.
class TestDirectory {
 public:
  TestDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gnomon-test-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  TestDirectory(const TestDirectory&) = delete;
  TestDirectory& operator=(const TestDirectory&) = delete;
  ~TestDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }
  /// Of files and directories in it.
  std::size_t count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_),
                                                  std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_TEST_DIRECTORY_H
