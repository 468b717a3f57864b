// Tells how much of a file this process has read, by where its reading stands: for libraries that
// read it by themselves and do not say. One thread makes and ends it; a thread of its own looks.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace luxodus::vdb {

class FileWatch {
 public:
  /// `share`: of the work of a job (tell_share), which reading all of the file is.
  /// Requires: the file is open.
  FileWatch(const std::string& file, double share);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;

 private:
  void look(int descriptor, double bytes);

  const double share_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace luxodus::vdb
