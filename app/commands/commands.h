// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/commands/shard.h"
#include "app/exit_code.h"
#include "cdt/point.h"
#include "fields/field.h"
#include "io/meshes/part.h"
#include "io/planar/svg.h"
#include "io/stack.h"
#include "overlay/coverage.h"
#include "overlay/layer.h"
#include "reconstruct/options.h"

namespace loft::app {

/// Whether a stack is read as a whole.
enum class Memory { by_size, in_memory, out_of_core };

/// `loft reconstruct IN... -o OUT ...`
struct ReconstructCommand {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::filesystem::path> outputs;
  Options options = {.height_tolerance = 1e-4};
  std::optional<std::filesystem::path> links;  ///< file of link orders
  std::string unit;                            ///< not given: that of the stack, or mm
  Memory memory = Memory::by_size;
  io::ReadOptions read = {.unlabelled = io::Unlabelled::label_by_file};
  std::vector<std::string> only;  ///< labels, see LabelChoice
  std::vector<std::string> except;
  Shard shard;                                          ///< of the labels that are left
  bool skip_existing = false;                           ///< files that are there stay as they are
  bool is_neuroglancer = false;                         ///< outputs are folders of meshes for it
  io::Compression compression = io::Compression::none;  ///< of glTF
  bool with_contours = false;                           ///< lines in glTF
  std::vector<std::string> hidden;                      ///< labels, see LabelChoice; in glTF
  std::optional<std::filesystem::path> volumes;         ///< file for the table of volumes
  bool strict = false;  ///< a label that cannot be made is a failure
  bool json = false;
  bool slabs = false;  ///< in the report, too
  bool quiet = false;
};

/// `loft triangulate IN... -o OUT ...`
struct TriangulateCommand {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::filesystem::path> outputs;
  io::SvgOptions drawing;
  double epsilon = 0;  ///< in the unit of the input
  bool json = false;
  bool quiet = false;
};

/// `loft overlay IN... [--keep EXPRESSION] [-o OUT] ...`
struct OverlayCommand {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::filesystem::path> outputs;
  std::optional<std::string> keep;  ///< an expression over layers
  bool all_pieces = false;
  bool areas = false;
  std::optional<std::string> layer_by;  ///< a property; not given: a layer a file
  overlay::FillRule fill = overlay::FillRule::even_odd;
  io::SvgOptions drawing;
  bool json = false;
  bool quiet = false;
};

/// `loft query MAP --points|--lines FILE ...`
struct QueryCommand {
  std::filesystem::path map;
  std::optional<std::filesystem::path> points;  ///< one of these two
  std::optional<std::filesystem::path> lines;
  std::vector<std::filesystem::path> outputs;  ///< none: standard output
  std::optional<std::string> layer_by;         ///< a property; not given: the name, or the number
  io::SvgOptions drawing;
  bool json = false;
  bool quiet = false;
};

/// `loft classify POINTS --separators FILE ...`
struct ClassifyCommand {
  std::filesystem::path points;
  std::filesystem::path separators;
  std::vector<std::filesystem::path> outputs;
  std::optional<std::string> value;  ///< a column; not given: value, z or weight, if there is one
  io::SvgOptions drawing;
  bool json = false;
  bool quiet = false;
};

/// Columns and rows.
struct GridSize {
  std::size_t columns = 0;
  std::size_t rows = 0;
};

/// `loft field SAMPLES [--lines FILE] [--at FILE | --profile FILE | --isolines N] ...`
struct FieldCommand {
  std::filesystem::path samples;
  std::optional<std::string> value;  ///< a column; not given: value, z, height or elevation
  std::optional<std::filesystem::path> lines;
  fields::OnConflict on_conflict = fields::OnConflict::mean;
  fields::Smoothness smoothness = fields::Smoothness::linear;
  fields::Outside outside = fields::Outside::nothing;
  std::optional<std::filesystem::path> at;       ///< places
  std::optional<std::filesystem::path> profile;  ///< lines
  std::optional<std::size_t> isolines;           ///< about so many levels
  std::vector<double> levels;                    ///< these, if there are any
  bool bands = false;                            ///< polygons between levels, instead of lines
  std::optional<GridSize> grid;                  ///< at most; cells are square
  std::optional<double> cell;                    ///< their width
  std::optional<double> level;                   ///< volumes over and under it
  std::vector<std::filesystem::path> outputs;
  bool triangles = false;  ///< drawn, too
  io::SvgOptions drawing;
  bool json = false;
  bool quiet = false;
};

/// `loft path SCENE --from X,Y --to X,Y | --queries FILE ...`
struct PathCommand {
  std::filesystem::path scene;
  std::optional<cdt::Point> from;  ///< these two, or queries
  std::optional<cdt::Point> to;
  std::optional<std::filesystem::path> queries;
  std::optional<std::filesystem::path> moves;  ///< edits of the scene
  std::vector<std::filesystem::path> outputs;  ///< none: standard output
  double radius = 0;                           ///< where a query does not say it
  std::size_t most_expansions = std::numeric_limits<std::size_t>::max();  ///< of a search
  std::optional<std::string> layer_by;                                    ///< as in SceneRules
  std::optional<std::string> free;
  io::SvgOptions drawing;
  bool json = false;
  bool quiet = false;
};

/// `loft coverage MAP [--check] [--clean HEIR] [-o OUT] ...`
struct CoverageCommand {
  std::filesystem::path map;
  std::vector<std::filesystem::path> outputs;
  bool check = false;                   ///< faults are a failure
  bool borders = false;                 ///< lists what areas share
  std::optional<overlay::Heir> clean;   ///< who gets what several claim, or none
  std::optional<double> gap_width;      ///< wider gaps are no faults
  std::optional<std::string> layer_by;  ///< a property; not given: a layer a feature
  io::SvgOptions drawing;
  bool json = false;
  bool quiet = false;
};

/// `loft check MESH... [--stack STACK]`
struct CheckCommand {
  std::vector<std::filesystem::path> meshes;
  std::optional<std::filesystem::path> stack;
  io::ReadOptions read;
  double within = 0;  ///< how far contour vertices may have been moved
  bool json = false;
};

/// `loft info FILE...`
struct InfoCommand {
  std::vector<std::filesystem::path> files;
  io::ReadOptions read;
  bool volumes = true;  ///< of the labels of stacks
  bool json = false;
};

/// `loft convert IN... -o OUT`
struct ConvertCommand {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  io::ReadOptions read = {.unlabelled = io::Unlabelled::label_by_file};
  std::vector<std::string> only;
  std::vector<std::string> except;
  std::optional<double> fair;  ///< as Options::fair
  bool quiet = false;
};

/// `loft slice MESH -o OUT --gap G`
struct SliceCommand {
  std::filesystem::path mesh;
  std::filesystem::path output;
  std::optional<double> gap;    ///< between slices; or:
  std::vector<double> heights;  ///< along the normal
  Vec3 normal{0, 0, 1};         ///< of the slices, of any length but 0
  bool quiet = false;
};

/// `loft stream [IN] ...`
struct StreamCommand {
  std::optional<std::filesystem::path> input;  ///< not set or `-`: standard input
  bool follows = false;                        ///< the file grows
  bool has_input = true;
  std::vector<std::filesystem::path> outputs;
  std::optional<std::filesystem::path> replay;
  double replay_rate = 20;  ///< edits a second in it
  std::optional<std::filesystem::path> session;
  Options options;
  std::string unit = "mm";
  std::vector<StackLabel> labels;  ///< what the first line of the input tells of them
  std::set<std::string> given;     ///< settings (settings.h) that the command line names
  bool takes_stack_line = false;   ///< settings come from the first line of the input, too
  std::size_t every = 0;  ///< edits after which the outputs are written; 0: at the end only
  bool serves = false;
  std::string host = "127.0.0.1";
  int port = 8337;
  std::size_t most_megabytes = 16;  ///< of a body
  double most_effort = 2000;        ///< of an edit, in millions of steps
  std::string token;                ///< for changes from beyond this machine
  bool strict = false;
  bool json = false;
  bool quiet = false;
};

/// `loft view FILE`
struct ViewCommand {
  std::filesystem::path file;
  std::optional<std::uint64_t> at = {};              ///< of a session: the first so many edits
  std::optional<std::filesystem::path> folder = {};  ///< to write a page into, in place of serving
  bool overwrites = false;                           ///< whatever is in it
  std::string host = "127.0.0.1";
  int port = 8337;
  std::string unit = "mm";
  bool quiet = false;
};

/// `loft live [SCENE]`
struct LiveCommand {
  std::optional<std::filesystem::path> scene;
  std::optional<std::string> tab;  ///< not given: the first, or by what is in the scene
  std::string host = "127.0.0.1";
  int port = 8337;
  std::string token;  ///< for changes from beyond this machine
  bool quiet = false;
};

/// `loft session list|export|verify FILE`
struct SessionCommand {
  enum class What { list, export_slices, verify, history, undo, redo };

  What what = What::list;
  std::filesystem::path file;
  std::filesystem::path output = "-";    ///< `-`: standard output
  bool edits = false;                    ///< export them, not the slices that they left
  std::optional<std::uint64_t> at = {};  ///< only the first so many edits
  bool json = false;
  bool quiet = false;
};

/// Each command prints its results on stdout and its words on stderr. Throws UsageError and
/// loft::Error; outputs are complete or not there.
[[nodiscard]] ExitCode run(const ReconstructCommand& command);
[[nodiscard]] ExitCode run(const TriangulateCommand& command);
[[nodiscard]] ExitCode run(const OverlayCommand& command);
[[nodiscard]] ExitCode run(const QueryCommand& command);
[[nodiscard]] ExitCode run(const ClassifyCommand& command);
[[nodiscard]] ExitCode run(const FieldCommand& command);
[[nodiscard]] ExitCode run(const CoverageCommand& command);
[[nodiscard]] ExitCode run(const PathCommand& command);
[[nodiscard]] ExitCode run(const CheckCommand& command);
[[nodiscard]] ExitCode run(const InfoCommand& command);
[[nodiscard]] ExitCode run(const StreamCommand& command);
[[nodiscard]] ExitCode run(const ViewCommand& command);
[[nodiscard]] ExitCode run(const LiveCommand& command);
[[nodiscard]] ExitCode run(const SessionCommand& command);
[[nodiscard]] ExitCode run(const ConvertCommand& command);
[[nodiscard]] ExitCode run(const SliceCommand& command);

}  // namespace loft::app
