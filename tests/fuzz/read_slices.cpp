// SPDX-License-Identifier: MIT
// A stack, its lines as edits, and all of it as orders to link contours.
#include <sstream>

#include "io/stacks/edit.h"
#include "io/stacks/links_json.h"
#include "io/stacks/slices_json.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;

void read_stack(const std::string& text) {
  std::istringstream in(text);
  const std::vector<Slice> slices = io::read_slices_json(in, "a.ndjson", 1);
  std::stringstream again;
  io::write_slices_json(again, slices);
  fuzz::require(io::read_slices_json(again, "a.ndjson", 1) == slices, "another stack comes back");
}

void read_edit(const std::string& line) {
  const io::EditLine read = io::parse_edit_line(line);
  if (!read.problems.empty()) return;
  const io::EditLine again = io::parse_edit_line(io::to_line(read.edit));
  fuzz::require(again.problems.empty() && again.edit == read.edit, "another edit comes back");
}

void read_links(const std::string& text) {
  const std::vector<Slice> slices{{0, {{{{0, 0}, {4, 0}, {0, 4}}, ""}}},
                                  {1, {{{{0, 0}, {4, 0}, {0, 4}}, ""}}}};
  std::istringstream in(text);
  for (const LinkOrder& order : io::read_links_json(in, "a.ndjson", slices))
    fuzz::require(order.from.slice < 2 && order.to.slice < 2 && order.from.contour == 0 &&
                      order.to.contour == 0,
                  "an order for what is not there");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::try_to([&] { read_stack(text); });
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) read_edit(line);
  fuzz::try_to([&] { read_links(text); });
  return 0;
}
