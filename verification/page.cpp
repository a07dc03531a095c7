// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/observables/result.hpp"

namespace tunica::verification {

Page::Page(std::filesystem::path file, const std::string& part, const std::string& program)
    : file_(std::move(file)) {
  std::ifstream stream(file_);
  if (!stream) throw std::runtime_error(fmt::format("{} cannot be read", file_.string()));
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string first = fmt::format("<!-- {}: written by {}, do not edit -->\n", part, program);
  const std::string last = fmt::format("<!-- end of {} -->\n", part);
  const std::size_t begin = text.find(first), end = text.find(last);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error(fmt::format("{} lacks the lines {}and {}", file_.string(), first, last));
  before_ = text.substr(0, begin + first.size());
  after_ = text.substr(end);
}

void Page::write(const std::string& text) const {
  write_whole(file_, before_ + "\n" + text + after_);
}

std::string markdown_table(const std::vector<std::string>& header,
                           const std::vector<std::vector<std::string>>& rows) {
  std::string text = fmt::format("| {} |\n|", fmt::join(header, " | "));
  for (std::size_t k = 0; k < header.size(); ++k) text += "---|";
  text += "\n";
  for (const auto& row : rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text + "\n";
}

}  // namespace tunica::verification
