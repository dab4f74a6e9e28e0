// SPDX-License-Identifier: MIT
#include "io/contours/jser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "io/bytes/json_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/contours/jser_section.h"
#include "io/contours/stack_builder.h"
#include "io/contours/take_away.h"
#include "io/contours/winding.h"
#include "mesh/admitted.h"
#include "reconstruct/usable.h"

namespace loft::io {

namespace {

/// The number behind the last dot of a name, or all of it: `series.12`, `12`.
std::optional<std::size_t> section_number(std::string_view name) {
  name = name.substr(name.rfind('.') + 1);  // npos + 1 is 0
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  constexpr std::size_t most = 100'000'000;
  if (error != std::errc() || end != name.data() + name.size() || number > most) return {};
  return number;
}

/// The traces of one name in one section.
struct Traces {
  std::vector<Contour> positive;
  std::vector<Contour> negative;
};

class JserReader {
 public:
  JserReader(const StackInput& input, const ReadOptions& options)
      : text_(without_mark(input.bytes)), name_(input.name), options_(options), builder_(name_) {}

  Stack read() {
    try {
      find_sections();
      problems_.raise(name_);
      read_sections();
    } catch (const JsonError& error) {
      problems_.add(std::string(name_) + ": byte " + std::to_string(error.column() - 1) +
                    ": broken JSON: " + error.what());
    }
    problems_.raise(name_);
    require_alignment();
    stack_.unit = "um";
    stack_.fill = Fill::nonzero;
    for (auto& [name, colour] : colours_) stack_.labels.push_back({name, colour, "", "", {}});
    builder_.finish(stack_, "a surface needs closed traces that are not hidden");
    return std::move(stack_);
  }

 private:
  void complain(const std::string& place, const std::string& problem) {
    problems_.add(std::string(name_) + ": " + place + (place.empty() ? "" : ": ") + problem);
  }

  void find_sections() {
    JsonReader json(text_, "text");
    if (json.peek() != JsonKind::object)
      return complain("", reject(json, "a series {\"sections\": ..., \"series\": ...}"));
    json.begin_object();
    while (const auto key = json.next_key()) {
      if (*key == "sections" && json.peek() == JsonKind::list) {
        json.begin_list();
        for (std::size_t i = 0; json.next_item(); ++i) note_section(i, json);
      } else if (*key == "sections" && json.peek() == JsonKind::object) {
        json.begin_object();
        while (const auto name = json.next_key()) note_section(section_number(*name), json);
      } else if ((*key == "series" || key->ends_with(".ser")) && json.peek() == JsonKind::object) {
        read_series(json);
      } else {
        note_section(section_number(*key), json);
      }
    }
    json.end();
    if (sections_.empty())
      complain("", "has no section; it is no series of PyReconstruct, or an empty one");
  }

  void note_section(std::optional<std::size_t> number, JsonReader& json) {
    const bool is_one = number && json.peek() == JsonKind::object;
    const JsonReader here = json;
    json.skip();
    if (is_one) sections_.insert_or_assign(*number, here);
  }

  void read_series(JsonReader& json) {
    json.begin_object();
    while (const auto key = json.next_key()) {
      if (*key == "alignment" && json.peek() == JsonKind::string) {
        alignment_ = json.string();
      } else {
        json.skip();
      }
    }
  }

  void read_sections() {
    if (!options_.alignment.empty()) alignment_ = options_.alignment;
    for (auto& [number, json] : sections_) {
      place_ = "section " + std::to_string(number);
      const JserComplain complain_there = [&](const std::string& problem) {
        complain(place_, problem);
      };
      const JserSection section = read_jser_section(json, complain_there);
      raise(number, section);
      for (const auto& one : section.alignments) alignments_.insert(one.first);
      const auto found = section.alignments.find(alignment_);
      const bool wants_none = alignment_ == "no-alignment";
      if (found == section.alignments.end() && !section.alignments.empty() && !wants_none)
        ++unaligned_;
      transform_ = found == section.alignments.end() ? jser_identity : found->second;
      if (section.contours) read_traces(*section.contours, complain_there);
    }
  }

  /// The height of a section: of its own thickness above the one before, once for each that is
  /// missing between them.
  void raise(std::size_t number, const JserSection& section) {
    if (!section.thickness) return complain(place_, "\"thickness\" is missing, or no number");
    const double thickness = *section.thickness;
    if (!(thickness > 0) || !admitted::slice.admits(thickness))
      return complain(place_, "its thickness is not positive; set it in PyReconstruct");
    const double steps = static_cast<double>(number + 1 - next_number_) + 1;
    if (thickness != thickness_) {
      base_ = z_;
      run_ = 0;
      thickness_ = thickness;
    }
    run_ += steps;
    z_ = base_ + run_ * thickness;  // no sum of rounded sums
    next_number_ = number + 2;
  }

  void read_traces(const JsonReader& contours, const JserComplain& complain_there) {
    std::map<std::string, Traces> traces;
    read_jser_traces(contours, complain_there,
                     [&](const std::string& raw, std::size_t number, const JserTrace& trace) {
                       const std::string name = json_text(one_line(raw));
                       colours_.emplace(name, trace.colour);
                       take(name, number, trace, traces[name]);
                     });
    for (auto& [name, of_name] : traces) add(name, of_name);
  }

  void take(const std::string& name, std::size_t number, const JserTrace& trace, Traces& traces) {
    if (trace.is_hidden) return builder_.skip(name, "hidden trace");
    if (!trace.is_closed) return builder_.skip(name, "open trace");
    if (trace.x.size() < 3) return builder_.skip(name, "contour of 1 or 2 points");
    Contour contour{{}, name, place_ + " trace " + std::to_string(number)};
    for (std::size_t i = 0; i < trace.x.size(); ++i)
      contour.points.push_back(moved({trace.x[i], trace.y[i]}));
    for (const cdt::Point& point : contour.points)
      if (!admitted::slice.admits(point.x) || !admitted::slice.admits(point.y))
        return complain(place_, in_quotes(name) + " trace " + std::to_string(number) +
                                    ": the alignment moves it out of range");
    if (doubled_area(contour.points) < 0) std::ranges::reverse(contour.points);
    (trace.is_negative ? traces.negative : traces.positive).push_back(std::move(contour));
  }

  [[nodiscard]] cdt::Point moved(const cdt::Point& p) const {
    if (transform_ == jser_identity) return p;
    const JserTransform& m = transform_;
    return {m[0] * p.x + m[1] * p.y + m[2], m[3] * p.x + m[4] * p.y + m[5]};
  }

  void add(const std::string& name, Traces& traces) {
    if (traces.positive.empty()) {
      builder_.skip(name, "negative trace that is alone in its section", traces.negative.size());
    } else if (traces.negative.empty()) {
      for (Contour& contour : traces.positive) builder_.add(std::move(contour), z_);
    } else {
      for (auto& ring : take_away(traces.positive, traces.negative, z_))
        builder_.add({std::move(ring), name, place_ + " without its negative traces"}, z_);
    }
  }

  void require_alignment() {
    if (unaligned_ == 0) return;
    std::string known;
    for (const std::string& one : alignments_)
      known += (known.empty() ? "" : ", ") + in_quotes(one);
    const std::string missing = "the alignment " + in_quotes(alignment_) + " is missing in " +
                                counted(unaligned_, "section") + "; there are " + known +
                                ": name one by --alignment";
    throw InputError(std::string(name_) + ": " + missing);
  }

  std::string_view text_;
  std::string_view name_;
  const ReadOptions& options_;
  StackBuilder builder_;
  Problems problems_;
  Stack stack_;
  std::map<std::size_t, JsonReader> sections_;
  std::map<std::string, Colour> colours_;
  std::string alignment_ = "default";
  std::set<std::string> alignments_;
  std::size_t unaligned_ = 0;
  std::string place_;
  JserTransform transform_ = jser_identity;
  std::size_t next_number_ = 1;  // of the section after the one before, from 1
  double z_ = 0;
  double base_ = 0;
  double run_ = 0;
  double thickness_ = 0;
};

}  // namespace

Stack read_jser(const StackInput& input, const ReadOptions& options) {
  return JserReader(input, options).read();
}

}  // namespace loft::io
