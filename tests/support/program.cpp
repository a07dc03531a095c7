// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <system_error>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/observables/table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica::test_support {

namespace fs = std::filesystem;

Program::Program(const std::vector<std::string>& arguments, const fs::path& folder,
                 const std::function<void()>& before) {
  static std::atomic<int> number = 0;
  const std::string stem = (fs::temp_directory_path() /
                            ("tunica-program-" + std::to_string(::getpid()) + "-" + std::to_string(number++)))
                               .string();
  out_ = stem + ".out";
  err_ = stem + ".err";
  std::vector<char*> argv;
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  child_ = ::fork();
  if (child_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child_ > 0) return;
  const auto redirect = [](const fs::path& file, int to) {
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (opened < 0 || ::dup2(opened, to) < 0) ::_exit(125);
    ::close(opened);
  };
  redirect(out_, STDOUT_FILENO);
  redirect(err_, STDERR_FILENO);
  if (::chdir(folder.c_str()) != 0) ::_exit(125);
  before();
  ::execv(argv[0], argv.data());
  ::_exit(126);
}

Program::~Program() {
  if (status_ < 0) {
    send(SIGKILL);
    wait();
  }
  std::error_code ignored;
  fs::remove(out_, ignored);
  fs::remove(err_, ignored);
}

void Program::send(int signal) const {
  ::kill(child_, signal);
}

bool Program::running() {
  if (status_ >= 0) return false;
  int status = 0;
  if (::waitpid(child_, &status, WNOHANG) == 0) return true;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 256 + WTERMSIG(status);
  return false;
}

int Program::wait() {
  if (status_ >= 0) return status_;
  int status = 0;
  ::waitpid(child_, &status, 0);
  return status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 256 + WTERMSIG(status);
}

std::string Program::output() const {
  return read_text(out_);
}
std::string Program::errors() const {
  return read_text(err_);
}

Ended tunica(const std::vector<std::string>& arguments, const fs::path& folder,
             const std::function<void()>& before) {
  std::vector<std::string> all{TUNICA_PROGRAM};
  all.insert(all.end(), arguments.begin(), arguments.end());
  Program program(all, folder, before);
  const int code = program.wait();
  return {code, program.output(), program.errors()};
}

bool is_one_line(const std::string& errors) {
  return errors.starts_with("tunica: ") && errors.ends_with('\n') &&
         std::count(errors.begin(), errors.end(), '\n') == 1;
}

std::string broken_file(const fs::path& folder) {
  if (!fs::exists(folder)) return {};
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (entry.is_directory()) {
      if (const std::string broken = broken_file(entry.path()); !broken.empty()) return name + "/" + broken;
      continue;
    }
    if ((name.starts_with('.') && name.ends_with(".part")) || name == ".lock") continue;
    if (name == "fields" && entry.is_directory()) {
      if (const std::string broken = broken_file(entry.path()); !broken.empty()) return broken;
      continue;
    }
    const std::string text = read_text(entry.path());
    if (name.ends_with(".csv")) {
      // read_csv asks for a value or an empty cell in every column of every row.
      try {
        observables::read_csv(entry.path());
      } catch (const InvalidInput& error) {
        return error.what();
      }
      if (!text.ends_with('\n')) return name + " does not end its last line";
    } else if (name.ends_with(".json")) {
      if (!nlohmann::json::accept(text)) return name + " does not parse";
    } else if (name.ends_with(".xdmf")) {
      if (!text.ends_with("</Xdmf>\n")) return name + " is cut off";
    } else if (name.ends_with(".html")) {
      if (text.find("</html>") == std::string::npos) return name + " is cut off";
    } else if (name.ends_with(".xdmf")) {
      if (text.find("</Xdmf>") == std::string::npos) return name + " is cut off";
    } else if (text.empty()) {
      return name + " is empty";
    }
  }
  return {};
}

}  // namespace tunica::test_support
