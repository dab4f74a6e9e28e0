// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruct.h"

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/surfaces.h"
#include "io/unit.h"
#include "python/binding/arrays.h"
#include "python/binding/errors.h"
#include "python/binding/job.h"
#include "python/binding/options.h"
#include "python/binding/parts.h"
#include "reconstruct/fair.h"
#include "reconstruct/option_names.h"

namespace loft::python {

namespace {

struct Made {
  std::string label;
  std::size_t slices = 0;  ///< that the label is in
  std::shared_ptr<Reconstructed> made;
};

struct All {
  std::vector<Made> labels;
  std::vector<std::pair<std::string, std::string>> skipped;  ///< and why
};

/// Makes the surfaces of labels one after the other.
class Work {
 public:
  Work(std::shared_ptr<const Stack> stack, Options options, std::vector<std::string> labels)
      : stack_(std::move(stack)), options_(std::move(options)), labels_(std::move(labels)) {}

  All run(Job& job) {
    if (options_.fair) make_fair();
    const ContoursByLabel contours(stack_->slices);
    const bool is_labelled =
        contours.labels().size() > 1 || (!labels_.empty() && !labels_[0].empty());
    if (labels_.empty()) labels_.emplace_back();
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (is_labelled) options_.label = labels_[i];
      make(job, contours, i);
    }
    if (is_fatal_ || all_.skipped.size() == labels_.size())
      throw problems_.size() == 1 ? problems_[0] : InputError(everything());
    return std::move(all_);
  }

 private:
  void make_fair() {
    stack_ = std::make_shared<Stack>(
        fair(*stack_, *options_.fair, options_.height_tolerance, options_.threads));
    options_.fair = {};
  }

  void make(Job& job, const ContoursByLabel& contours, std::size_t i) {
    const auto progress = [&](Stage stage, double fraction) {
      return job.report(stage, (static_cast<double>(i) + overall(stage, fraction)) /
                                   static_cast<double>(labels_.size()));
    };
    try {
      all_.labels.push_back({labels_[i], count_slices(contours.of(labels_[i])),
                             std::make_shared<Reconstructed>(
                                 options_.label ? reconstruct(*stack_, contours, options_, progress)
                                                : reconstruct(*stack_, options_, progress))});
    } catch (const InputError& error) {
      note(labels_[i], error);
    }
  }

  /// Labels with too few slices stop no others.
  void note(const std::string& label, const InputError& error) {
    problems_.push_back(error);
    if (is_too_little(error)) {
      all_.skipped.emplace_back(label, error.what());
    } else {
      is_fatal_ = true;
    }
  }

  [[nodiscard]] std::vector<Defect> everything() const {
    std::vector<Defect> defects;
    for (const InputError& problem : problems_) {
      if (problem.defects().empty()) throw InputError(problem);
      defects.insert(defects.end(), problem.defects().begin(), problem.defects().end());
    }
    return defects;
  }

  [[nodiscard]] static std::size_t count_slices(std::span<const ContourId> contours) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < contours.size(); ++i)
      if (i == 0 || contours[i].slice != contours[i - 1].slice) ++count;
    return count;
  }

  std::shared_ptr<const Stack> stack_;
  Options options_;
  std::vector<std::string> labels_;
  std::vector<InputError> problems_;
  bool is_fatal_ = false;
  All all_;
};

py::list contour_list(const std::vector<ContourId>& contours) {
  py::list list;
  for (const ContourId& id : contours) list.append(py::make_tuple(id.slice, id.contour));
  return list;
}

py::dict link_dict(const LinkReport& link) {
  using namespace py::literals;
  return py::dict("kind"_a = name(link.kind), "is_solid"_a = link.is_solid,
                  "reason"_a = name(link.reason), "lower"_a = contour_list(link.lower),
                  "upper"_a = contour_list(link.upper), "shift"_a = link.shift,
                  "turn"_a = link.turn, "overlap"_a = link.overlap,
                  "confidence"_a = link.confidence);
}

py::list slab_list(const std::vector<SlabReport>& slabs) {
  using namespace py::literals;
  py::list list;
  for (const SlabReport& slab : slabs) {
    py::list links;
    for (const LinkReport& link : slab.links) links.append(link_dict(link));
    list.append(py::dict("lower_slice"_a = static_cast<std::int32_t>(slab.lower_slice),
                         "upper_slice"_a = static_cast<std::int32_t>(slab.upper_slice),
                         "lower_z"_a = slab.lower_z, "upper_z"_a = slab.upper_z,
                         "overlap"_a = slab.overlap, "shift"_a = slab.shift,
                         "confidence"_a = slab.confidence, "links"_a = links));
  }
  return list;
}

using GivenLink = std::tuple<std::array<std::uint32_t, 2>, std::array<std::uint32_t, 2>, bool>;

std::vector<LinkOrder> orders_of(const std::vector<GivenLink>& links) {
  std::vector<LinkOrder> orders;
  for (const auto& [from, to, is_link] : links)
    orders.push_back({{from[0], from[1]},
                      {to[0], to[1]},
                      is_link,
                      "links[" + std::to_string(orders.size()) + ']'});
  return orders;
}

/// The stack with the fill rule that the caller asks for in the place of its own.
std::shared_ptr<const Stack> with_choice(const std::shared_ptr<Stack>& stack, bool has_fill,
                                         Options& options) {
  if (!has_fill || !stack->fill || *stack->fill == options.fill) {
    options.fill = stack->fill.value_or(options.fill);
    return stack;
  }
  auto changed = std::make_shared<Stack>(*stack);
  changed->fill = options.fill;
  return changed;
}

py::tuple reconstruct_labels(const std::shared_ptr<Stack>& stack,
                             const std::vector<std::string>& labels, const py::dict& named,
                             const std::vector<GivenLink>& links, const py::object& progress) {
  Options options = options_of(named);
  options.links = orders_of(links);
  const bool has_fill = named.contains("fill") && !named["fill"].is_none();
  const std::shared_ptr<const Stack> chosen = with_choice(stack, has_fill, options);
  const auto settings = settings_of(options);
  const All all = result_of(progress, [chosen, options, labels](Job& job) {
    return Work(chosen, options, labels).run(job);
  });
  py::list made;
  for (const Made& one : all.labels)
    made.append(py::make_tuple(
        one.label, SharedSurface(std::shared_ptr<const Surface>(one.made, &one.made->surface)),
        defect_list(one.made->repairs), slab_list(one.made->slabs), one.made->slab_volume,
        one.slices));
  return py::make_tuple(made, all.skipped, settings);
}

/// Label, surface, colour, id, kind, source, slices, hidden.
using GivenPart = std::tuple<std::string, SharedSurface, std::optional<std::array<std::uint8_t, 3>>,
                             std::string, std::string, std::string, std::size_t, bool>;

io::Compression compression_of(const std::string& word) {
  if (word.empty()) return io::Compression::none;
  if (word == "quantize") return io::Compression::quantize;
  if (word == "meshopt") return io::Compression::meshopt;
  throw InputError("compress: '" + word + "' is none of 'quantize', 'meshopt'");
}

double metres_of(const std::string& unit) {
  const std::optional<double> metres = io::metres_per_unit(unit);
  if (!metres) throw InputError("unit: '" + unit + "' is none of " + std::string(io::unit_names));
  return *metres;
}

py::dict written_dict(const io::Written& written) {
  using namespace py::literals;
  return py::dict("faults"_a = written.rounding.faults, "moved"_a = written.rounding.moved,
                  "collapsed"_a = written.rounding.collapsed, "left"_a = written.rounding.left,
                  "origin"_a = written.origin);
}

/// `contours_of`: the stack whose contours are written beside the surfaces, or None.
py::dict write_surfaces(const std::string& path, const std::vector<GivenPart>& given,
                        const std::string& unit, const std::vector<std::string>& sources,
                        const std::map<std::string, std::string>& settings,
                        const std::string& compress, const std::shared_ptr<Stack>& contours_of) {
  io::WriteOptions options;
  options.metres_per_unit = metres_of(unit);
  options.sources = sources;
  options.settings = settings;
  options.compression = compression_of(compress);
  return written_dict(result_of(py::none(), [=](Job&) {
    std::vector<io::Part> parts;
    for (const auto& [label, surface, colour, id, kind, source, slices, is_hidden] : given) {
      io::Part& part = parts.emplace_back();
      part.label = label;
      part.surface = surface.get().get();
      if (colour) part.colour = Colour{(*colour)[0], (*colour)[1], (*colour)[2]};
      part.id = id;
      part.kind = kind;
      part.source = source;
      part.slices = slices;
      part.is_hidden = is_hidden;
      if (contours_of) part.contours = io::contour_lines(*contours_of, label);
    }
    return io::write(path, parts, options);
  }));
}

}  // namespace

void add_reconstruct(py::module_& module) {
  module.def("reconstruct", &reconstruct_labels);
  module.def("write", &write_surfaces);
}

}  // namespace loft::python
