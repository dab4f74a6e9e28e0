// SPDX-License-Identifier: MIT
#include "io/bytes/csv_rows.h"

#include <csv.h>

#include <algorithm>
#include <array>
#include <new>
#include <tuple>
#include <utility>

#include "io/bytes/text.h"
#include "io/bytes/words.h"

namespace loft::io {

namespace {

extern "C" {

int is_csv_blank(unsigned char c) { return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n'); }
int is_csv_line_end(unsigned char c) { return c == '\n'; }

}  // extern "C"

/// A line without what is in quotes.
std::string outside_quotes(std::string_view line) {
  std::string result;
  bool is_in_quotes = false;
  for (const char c : line) {
    if (c == '"') is_in_quotes = !is_in_quotes;
    if (!is_in_quotes) result += c;
  }
  return result;
}

}  // namespace

/// libcsv, and the row that it is in.
struct CsvRows::Parser {
  csv_parser csv{};
  std::string text;               // of all cells, one after the other
  std::vector<std::size_t> ends;  // of the cells in it
  bool is_finished = false;
  bool is_row_there = false;
  bool ends_in_quotes = false;

  explicit Parser(char separator) {
    if (csv_init(&csv, 0) != 0) throw std::bad_alloc();
    constexpr std::size_t step = 1 << 16;  // in which its memory grows
    csv_set_blk_size(&csv, step);
    csv_set_delim(&csv, static_cast<unsigned char>(separator));
    csv_set_space_func(&csv, is_csv_blank);
    csv_set_term_func(&csv, is_csv_line_end);
  }
  ~Parser() { csv_free(&csv); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  static void take_cell(void* cell, std::size_t size, void* parser) {
    auto& self = *static_cast<Parser*>(parser);
    if (cell != nullptr) self.text.append(static_cast<const char*>(cell), size);
    self.ends.push_back(self.text.size());
  }
  static void take_row(int, void* parser) { static_cast<Parser*>(parser)->is_row_there = true; }

  void begin_row() {
    text.clear();
    ends.clear();
    is_row_there = false;
  }
  /// A line with its end.
  void feed(std::string_view line) {
    if (csv_parse(&csv, line.data(), line.size(), take_cell, take_row, this) != line.size())
      throw std::bad_alloc();
  }
  void finish() {
    is_finished = true;
    csv_set_opts(&csv, CSV_STRICT | CSV_STRICT_FINI);  // the text must not end in quotes
    if (csv_fini(&csv, take_cell, take_row, this) == 0) return;
    if (csv_error(&csv) != CSV_EPARSE) throw std::bad_alloc();
    ends_in_quotes = true;
  }
};

CsvRows::CsvRows(std::string_view text) : text_(without_mark(text)) { find_style(); }
CsvRows::~CsvRows() = default;
CsvRows::CsvRows(CsvRows&&) noexcept = default;
CsvRows& CsvRows::operator=(CsvRows&&) noexcept = default;

bool CsvRows::ends_in_quotes() const { return parser_ && parser_->ends_in_quotes; }

/// With its end.
std::optional<std::string_view> CsvRows::next_line() {
  if (text_.empty()) return {};
  const std::size_t end = std::min(text_.find('\n'), text_.size() - 1) + 1;
  const std::string_view line = text_.substr(0, end);
  text_.remove_prefix(end);
  ++number_;
  return line;
}

/// By the first two lines that have something; a first one without a number is a header.
void CsvRows::find_style() {
  const auto begin = std::pair(text_, number_);
  std::array<std::string, 2> lines;
  std::string_view first;
  for (std::size_t found = 0; found < lines.size();) {
    const auto line = next_line();
    if (!line) break;
    if (without_blanks(*line).empty() || line->starts_with('#')) continue;
    if (found == 0) first = without_blanks(*line);
    lines[found++] = outside_quotes(without_blanks(*line));
  }
  std::tie(text_, number_) = begin;
  style_ = find_csv_style("", lines[0]);
  const auto is_number = [&](auto cell) { return csv_number(cell, style_).has_value(); };
  const bool has_header =
      !first.empty() && std::ranges::none_of(csv_cells(first, style_), is_number);
  if (has_header) style_ = find_csv_style(lines[0], lines[1]);
  if (style_.separator != ' ') parser_ = std::make_unique<Parser>(style_.separator);
  if (has_header && next()) names_.assign(cells_.begin(), cells_.end());
}

bool CsvRows::next() {
  cells_.clear();
  if (parser_) return parse_row();
  while (const auto line = next_line()) {
    if (without_blanks(*line).empty() || line->starts_with('#')) continue;
    cells_ = csv_cells(*line, style_);
    line_ = number_;
    return true;
  }
  return false;
}

/// Feeds lines until they make up a row.
bool CsvRows::parse_row() {
  if (parser_->is_finished) return false;
  parser_->begin_row();
  bool is_inside = false;
  while (!parser_->is_row_there) {
    const auto line = next_line();
    if (!line) {
      parser_->finish();
      break;
    }
    if (!is_inside && (without_blanks(*line).empty() || line->starts_with('#'))) continue;
    if (!is_inside) line_ = number_;
    is_inside = true;
    parser_->feed(*line);
  }
  if (!parser_->is_row_there) return false;
  const std::string_view text = parser_->text;
  std::size_t begin = 0;
  for (const std::size_t end : parser_->ends) {
    cells_.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return true;
}

}  // namespace loft::io
