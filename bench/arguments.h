// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>
#include <vector>

namespace loft::bench {

/// The arguments of a program, the mode first. What is missing or no number throws
/// std::invalid_argument with the usage.
class Arguments {
 public:
  Arguments(int argc, char** argv, const char* usage)
      : words_(argv + 1, argv + argc), usage_(usage) {}

  [[nodiscard]] std::string word(std::size_t i) const {
    if (i >= words_.size()) throw std::invalid_argument(usage_);
    return words_[i];
  }
  [[nodiscard]] std::string word_or(std::size_t i, const char* otherwise) const {
    return i < words_.size() ? words_[i] : otherwise;
  }
  template <class Number>
  [[nodiscard]] Number number(std::size_t i) const {
    const std::string text = word(i);
    Number result{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    if (error != std::errc() || end != text.data() + text.size())
      throw std::invalid_argument(text + " is no number\n" + usage_);
    return result;
  }
  [[nodiscard]] int number_or(std::size_t i, int otherwise) const {
    return i < words_.size() ? number<int>(i) : otherwise;
  }

 private:
  std::vector<std::string> words_;
  const char* usage_;
};

}  // namespace loft::bench
