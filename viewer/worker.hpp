// viewer/worker.hpp
//
// Worker: one thread that does one piece of work after the other.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace cleancolor {

class Worker {
 public:
  Worker() : thread_([this] { run(); }) {}
  /// Work that has not begun is dropped; what runs is waited for.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// The work must not throw.
  void add(std::function<void()> work);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool ending_ = false;
  std::thread thread_;  // the last member: it uses all others
};

}  // namespace cleancolor
