// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>

namespace tunica {

/// Keeps a folder of results for one run: the lock of FOLDER/.lock (flock), which ends with the process that
/// holds it, however that ends. The file stays behind when the process is killed, and means nothing then.
class FolderLock {
 public:
  /// The folder has to be there. Waits for `patience` when another process has it. Throws InvalidInput that
  /// names the process when another one keeps the folder, and OutputFailure when files cannot be made in it.
  /// File systems without locks are written to without.
  explicit FolderLock(const std::filesystem::path& folder, std::chrono::milliseconds patience = {});
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace tunica
