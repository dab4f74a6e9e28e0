// SPDX-License-Identifier: MIT
#include "python/binding/options.h"

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "mesh/admitted.h"
#include "python/binding/job.h"
#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"
#include "reconstruct/option_names.h"
#include "reconstruct/usable.h"

namespace loft::python {

namespace {

/// One option after the other is taken out of a copy; what is left is not known.
class Named {
 public:
  explicit Named(const py::dict& named)
      : left_(py::reinterpret_steal<py::dict>(PyDict_Copy(named.ptr()))) {}

  /// None where it is not given.
  [[nodiscard]] py::object take(const char* key) {
    if (!left_.contains(key)) return py::none();
    return left_.attr("pop")(key);
  }

  [[nodiscard]] std::optional<double> number(const char* key) {
    const py::object value = take(key);
    if (value.is_none()) return {};
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() != nullptr) {
      PyErr_Clear();
      throw InputError(std::string(key) + ": a number is wanted, not " + shown(value));
    }
    return number;
  }

  /// A share from 0 to `most`.
  void share(const char* key, double& share, double most) {
    const std::optional<double> given = number(key);
    if (!given) return;
    if (!(*given >= 0 && *given <= most))
      throw InputError(std::string(key) + ": a share from 0 to " + exact(most) +
                       " is wanted, not " + exact(*given));
    share = *given;
  }

  [[nodiscard]] bool flag(const char* key) {
    const py::object value = take(key);
    if (value.is_none()) return false;
    if (!py::isinstance<py::bool_>(value))
      throw InputError(std::string(key) + ": True or False is wanted, not " + shown(value));
    return py::cast<bool>(value);
  }

  [[nodiscard]] std::string text(const char* key) {
    const py::object value = take(key);
    if (value.is_none()) return {};
    if (!py::isinstance<py::str>(value))
      throw InputError(std::string(key) + ": a string is wanted, not " + shown(value));
    return py::cast<std::string>(value);
  }

  template <class Choice>
  void choose(const char* key, Choice& choice,
              std::initializer_list<std::pair<const char*, Choice>> choices) {
    const std::string given = text(key);
    if (given.empty()) return;
    std::string known;
    for (const auto& [word, value] : choices) {
      if (given == word) {
        choice = value;
        return;
      }
      known += (known.empty() ? "'" : ", '") + std::string(word) + '\'';
    }
    throw InputError(std::string(key) + ": '" + given + "' is none of " + known);
  }

  [[nodiscard]] unsigned threads() {
    const py::object value = take("threads");
    if (value.is_none()) return usable_threads(0);
    const long count = PyLong_Check(value.ptr()) != 0 ? PyLong_AsLong(value.ptr()) : -1;
    PyErr_Clear();
    if (count < 0 || count > 1024)
      throw InputError("threads: a number from 0 (all there are) to 1024 is wanted, not " +
                       shown(value));
    return usable_threads(static_cast<unsigned>(count));
  }

  /// Throws where there are others.
  void finish() const {
    if (left_.empty()) return;
    throw InputError("there is no option " + shown(left_.attr("__iter__")().attr("__next__")()));
  }

 private:
  [[nodiscard]] static std::string shown(const py::handle& value) {
    const py::object start = py::repr(value)[py::slice(0, 80, 1)];
    return py::cast<std::string>(start.attr("encode")("utf-8", "backslashreplace"));
  }

  py::dict left_;
};

template <class Choice>
std::pair<const char*, Choice> named(Choice choice) {
  return {name(choice), choice};
}

}  // namespace

Options options_of(const py::dict& given) {
  Named from(given);
  Options options;
  options.height_tolerance = 1e-4;
  from.choose("fill", options.fill,
              {named(Fill::even_odd), named(Fill::nonzero), named(Fill::keyhole_aware)});
  from.choose("cap", options.cap,
              {named(Cap::flat), named(Cap::dome), named(Cap::open), named(Cap::extend)});
  from.choose("link", options.link,
              {named(LinkRule::automatic), named(LinkRule::overlap), named(LinkRule::none)});
  from.share("tolerance", options.tolerance, 0.01);
  from.share("height_tolerance", options.height_tolerance, 0.1);
  options.keyhole_width = from.number("keyhole_width");
  options.fair = from.number("fair");
  options.max_edge = from.number("max_edge");
  options.target_edge = from.number("target_edge");
  options.simplify = from.number("simplify");
  options.max_shift = from.number("max_shift");
  options.smooth_tolerance = from.number("smooth_tolerance");
  options.smooth = from.flag("smooth") || options.smooth_tolerance;
  options.reports_slabs = from.flag("slabs");
  options.threads = from.threads();
  from.finish();
  if ((options.max_edge ? 1 : 0) + (options.target_edge ? 1 : 0) + (options.simplify ? 1 : 0) > 1)
    throw InputError("max_edge, target_edge and simplify exclude each other: give one of them");
  require_usable(options);
  return options;
}

io::ReadOptions read_options_of(const py::dict& given) {
  Named from(given);
  io::ReadOptions options;
  std::optional<Fill> fill;
  from.choose<std::optional<Fill>>("fill", fill,
                                   {{"evenodd", Fill::even_odd},
                                    {"nonzero", Fill::nonzero},
                                    {"keyhole-aware", Fill::keyhole_aware}});
  options.fill = fill;
  from.choose("outline", options.outline,
              {{"iso", io::Outline::iso_lines},
               {"edges", io::Outline::edges},
               {"fair", io::Outline::fair}});
  from.choose("close", options.open_lines, {{"border", io::OpenLines::close_along_border}});
  if (const py::object spacing = from.take("spacing"); !spacing.is_none()) {
    Vec3 lengths{};
    try {
      lengths = {py::cast<double>(spacing[py::int_(0)]), py::cast<double>(spacing[py::int_(1)]),
                 py::cast<double>(spacing[py::int_(2)])};
    } catch (const std::exception&) {
      throw InputError("spacing: three lengths are wanted");
    }
    for (const double length : lengths)
      if (!(length > 0) || !admitted::length.admits_length(length))
        throw InputError("spacing: lengths from 1e-30 to 1e70 are wanted, not " + exact(length));
    options.spacing = lengths;
  }
  options.level = from.number("level");
  options.z_property = from.text("z_property");
  options.alignment = from.text("alignment");
  if (from.flag("label_by_file")) options.unlabelled = io::Unlabelled::label_by_file;
  options.threads = from.threads();
  from.finish();
  return options;
}

}  // namespace loft::python
