// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace loft::io {

/// The known word that `word` probably stands for: the first of those that the fewest edits lead
/// to, at most `most`, capitals aside. An edit is a letter too many, too few or wrong, or two that
/// changed places. Words of one or two letters stand for themselves only.
/// Cost: O(known words * their length).
[[nodiscard]] std::optional<std::string> near_word(std::string_view word,
                                                   std::span<const std::string_view> known,
                                                   std::size_t most);

/// The keys of a JSON object as they come: finds those that are misspelt. An unknown key is
/// misspelt if it is an edit away from a known one that does not come; any other is none of ours.
class KeyWatch {
 public:
  explicit KeyWatch(std::initializer_list<std::string_view> known) : known_(known) {}

  void note(std::string_view key);

  /// At the object's end: `unknown key 'contour'; write "contours"`, one sentence each.
  [[nodiscard]] std::vector<std::string> misspelt() const;
  /// Whether a known key neither came nor is in misspelt().
  [[nodiscard]] bool lacks(std::string_view known) const;

 private:
  struct Suspect {
    std::string key;
    std::string known;
  };
  [[nodiscard]] bool came(std::string_view known) const;

  std::vector<std::string_view> known_;
  std::vector<std::string_view> came_;
  std::vector<Suspect> suspects_;
};

}  // namespace loft::io
