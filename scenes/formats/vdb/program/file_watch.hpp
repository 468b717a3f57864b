// Reports how much of a file this process has read, by the file offset, for libraries that read it
// themselves without reporting. One thread makes and destroys it; its own thread polls.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace luxodus::vdb {

class FileWatch {
 public:
  /// `share`: the part of the job's work (tell_share) that reading the whole file is.
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
