// SPDX-License-Identifier: MIT
#include "io/stacks/links_json.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "io/bytes/file.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/near_word.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "reconstruct/link/link_orders.h"
#include "reconstruct/nearest_height.h"

namespace loft::io {

namespace {

constexpr const char* wanted_contour = "[slice, contour] or {\"z\": ..., \"contour\": ...}";

/// One line.
class OrderReader {
 public:
  OrderReader(std::string_view text, std::span<const Slice> slices)
      : json_(text), slices_(slices) {}

  /// None if there were problems.
  std::optional<LinkOrder> read() {
    try {
      read_order();
    } catch (const JsonError& error) {
      complain("broken JSON at column " + std::to_string(error.column()) + ": " + error.what());
    }
    if (problems_.empty()) return order_;
    return std::nullopt;
  }

  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  void complain(std::string problem) { problems_.push_back(std::move(problem)); }

  void reject(const std::string& place, const std::string& wanted) {
    complain(place + loft::io::reject(json_, wanted));
  }

  void read_order() {
    if (json_.peek() != JsonKind::object)
      return reject("", "an order {\"from\": ..., \"to\": ..., \"link\": true or false}");
    KeyWatch keys{"from", "to", "link"};
    json_.begin_object();
    while (const auto key = json_.next_key()) {
      keys.note(*key);
      if (*key == "from") {
        read_contour("\"from\": ", order_.from);
      } else if (*key == "to") {
        read_contour("\"to\": ", order_.to);
      } else if (*key == "link") {
        read_link();
      } else {
        json_.skip();
      }
    }
    json_.end("; one order a line");
    for (const std::string& problem : keys.misspelt()) complain(problem);
    if (keys.lacks("from")) complain(std::string("\"from\" is missing; write ") + wanted_contour);
    if (keys.lacks("to")) complain(std::string("\"to\" is missing; write ") + wanted_contour);
  }

  void read_link() {
    if (json_.peek() != JsonKind::boolean) return reject("\"link\": ", "true or false");
    json_.skip();
    order_.is_link = json_.last_word() == "true";
  }

  void read_contour(const std::string& place, ContourId& id) {
    if (json_.peek() == JsonKind::list) return read_pair(place, id);
    if (json_.peek() == JsonKind::object) return read_height(place, id);
    reject(place, wanted_contour);
  }

  void read_pair(const std::string& place, ContourId& id) {
    std::size_t count = 0;
    json_.begin_list();
    for (; json_.next_item(); ++count) {
      const std::uint32_t index = read_index(place);
      if (count == 0) id.slice = index;
      if (count == 1) id.contour = index;
    }
    if (count != 2)
      complain(place + "has " + std::to_string(count) + " numbers instead of [slice, contour]");
  }

  void read_height(const std::string& place, ContourId& id) {
    KeyWatch keys{"z", "contour"};
    json_.begin_object();
    while (const auto key = json_.next_key()) {
      keys.note(*key);
      if (*key == "z") {
        read_z(place + "\"z\": ", id);
      } else if (*key == "contour") {
        id.contour = read_index(place + "\"contour\": ");
      } else {
        json_.skip();
      }
    }
    for (const std::string& problem : keys.misspelt()) complain(place + problem);
    if (keys.lacks("z") || keys.lacks("contour")) complain(place + "needs \"z\" and \"contour\"");
  }

  void read_z(const std::string& place, ContourId& id) {
    if (json_.peek() != JsonKind::number) return reject(place, "the height of a slice");
    const double z = json_.number();
    const auto found = std::ranges::find(slices_, z, &Slice::z);
    if (found == slices_.end()) return complain(place + no_slice_at(z, heights()));
    id.slice = static_cast<std::uint32_t>(found - slices_.begin());
  }

  /// For a message only: made when there is something wrong.
  [[nodiscard]] std::map<double, bool> heights() const {
    std::map<double, bool> heights;
    for (const Slice& slice : slices_) heights[slice.z] = true;
    return heights;
  }

  std::uint32_t read_index(const std::string& place) {
    if (json_.peek() != JsonKind::number) {
      reject(place, "an index, counted from 0");
      return 0;
    }
    const double value = json_.number();
    const bool is_index = value >= 0 && value == std::floor(value) &&
                          value < std::numeric_limits<std::uint32_t>::max();
    if (is_index) return static_cast<std::uint32_t>(value);
    complain(place + std::string(json_.last_word()) +
             " is no index; write a whole number, counted from 0");
    return 0;
  }

  JsonReader json_;
  std::span<const Slice> slices_;
  LinkOrder order_;
  std::vector<std::string> problems_;
};

}  // namespace

std::vector<LinkOrder> read_links_json(std::istream& in, std::string_view name,
                                       std::span<const Slice> slices) {
  std::vector<LinkOrder> orders;
  Problems problems;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const std::string_view text = number == 1 ? without_mark(line) : std::string_view(line);
    if (without_blanks(text).empty()) continue;
    const std::string place = std::string(name) + ':' + std::to_string(number);
    OrderReader reader(text, slices);
    if (auto order = reader.read()) {
      order->place = place;
      orders.push_back(std::move(*order));
    }
    for (const std::string& problem : reader.problems()) problems.add(place + ": " + problem);
  }
  if (in.bad()) throw FileError(Access::read, std::filesystem::path(name), "read failed");
  for (const std::string& problem : find_bad_orders(slices, orders)) problems.add(problem);
  problems.raise(name);
  return orders;
}

std::vector<LinkOrder> read_links_json(const std::filesystem::path& path,
                                       std::span<const Slice> slices) {
  if (std::filesystem::is_directory(path)) throw FileError(Access::read, path, "it is a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(Access::read, path, last_cause());
  return read_links_json(file, path.string(), slices);
}

}  // namespace loft::io
