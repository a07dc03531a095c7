// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/watch.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace tunica::python {

namespace py = pybind11;

namespace {

/// What the computing and the watching thread share.
class Watch {
 public:
  RunControl control() {
    RunControl control;
    control.report = [this](const Progress& now) {
      const std::lock_guard lock(mutex_);
      latest_ = now;
    };
    control.interrupted = [this] { return stop_.load(std::memory_order_relaxed); };
    return control;
  }

  void end() {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
    ended_.notify_all();
  }

  /// True once the computation has ended.
  bool wait(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, time, [this] { return has_ended_; });
  }

  /// Tells what is new; the interpreter's lock is held.
  void tell(const py::object& progress) {
    if (raised_) return;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      std::optional<Progress> now;
      {
        const std::lock_guard lock(mutex_);
        now.swap(latest_);
      }
      if (now && !progress.is_none()) progress(now->beat, now->time, now->end_time, now->step);
    } catch (const py::error_already_set&) {
      raised_ = std::current_exception();
      stop_ = true;
    }
  }

  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::optional<Progress> latest_;
  std::atomic<bool> stop_{false};
  std::exception_ptr raised_;  ///< by Python
};

}  // namespace

void watched(const py::object& progress, const std::function<void(const RunControl&)>& compute) {
  using namespace std::chrono_literals;
  Watch watch;
  std::exception_ptr failure;
  {
    const py::gil_scoped_release free;
    const std::jthread computing([&] {
      try {
        compute(watch.control());
      } catch (...) {
        failure = std::current_exception();
      }
      watch.end();
    });
    while (!watch.wait(30ms)) {
      const py::gil_scoped_acquire hold;
      watch.tell(progress);
    }
  }
  watch.tell(progress);
  watch.rethrow();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tunica::python
