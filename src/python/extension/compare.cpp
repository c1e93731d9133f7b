// 'piblocks compare' of pictures in memory or in files.
#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>
#include <pybind11/stl.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "cli/exit_code.hpp"
#include "cli/tolerance_options.hpp"
#include "core/descriptor.hpp"
#include "core/output_file.hpp"
#include "core/overwrite_check.hpp"
#include "core/text.hpp"
#include "golden/difference.hpp"
#include "golden/picture_list.hpp"
#include "golden/reports.hpp"
#include "golden/shown_frames.hpp"
#include "python/extension/picture.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

/// What is behind --mask, or a picture.
using MaskSource = std::variant<std::string, std::shared_ptr<Picture>>;

Mask drawn_mask(const Picture& picture, const std::string& name) {
  const Fetched fetched = picture.fetch(name);
  try {
    if (!fetched.problem.empty()) throw UsageError(fetched.problem);
    return cli::mask_of_picture(name, flattened(fetched.frame->rgb()));
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: {}", name, error.what()));
  }
}

ComparisonJob job_of(const Picture& reference, const Picture& actual, const Options& options,
                     const std::vector<MaskSource>& masks) {
  ComparisonJob job{reference.has_path() ? *reference.path() : "the reference",
                    actual.has_path() ? *actual.path() : "the actual picture"};
  cli::OptionMap given(options);
  for (const MaskSource& mask : masks) {
    if (const auto* text = std::get_if<std::string>(&mask)) given.add("--mask", *text);
  }
  cli::read_tolerance(given, job);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (const auto* picture = std::get_if<std::shared_ptr<Picture>>(&masks[i])) {
      job.masks.push_back(drawn_mask(**picture, fmt::format("masks[{}]", i)));
    }
  }
  return job;
}

/// A comparison that has been made.
class Comparison {
 public:
  /// @throws IoError if a side has no picture, or one that alone is compared cannot be read
  Comparison(const Picture& reference, const Picture& actual, ComparisonJob job,
             const std::stop_token& stop)
      : job_(std::move(job)),
        are_files_(reference.has_path() && actual.has_path()),
        is_named_(reference.has_path() || actual.has_path()) {
    const auto take_row = [this](const FrameComparison& row) { take(row); };
    if (are_files_) {
      result_ = compare_files(job_, take_row, stop);
    } else {
      Fetched expected = reference.fetch(job_.reference);
      Fetched found = actual.fetch(job_.actual);
      for (auto [side, other] : {std::pair(&expected, &found), std::pair(&found, &expected)}) {
        if (side->name.empty()) side->name = other->name.empty() ? "the picture" : other->name;
      }
      result_ = compare_pair(expected, found, job_, take_row);
    }
    const bool is_alone = rows_.size() == 1;
    if (is_alone && rows_[0].outcome == Outcome::unreadable) throw IoError(rows_[0].problem);
    if (result_.reference_frames == 0) refuse_empty(job_.reference);
    if (result_.actual_frames == 0) refuse_empty(job_.actual);
  }

  const char* outcome() const { return name_of(result_.worst()); }
  bool is_accepted() const { return cli::exit_code_of(result_) == 0; }
  bool is_pair() const noexcept { return pair_.has_value(); }
  const std::vector<FrameComparison>& rows() const noexcept { return rows_; }
  std::vector<std::string> lines() const {
    if (pair_) return {line_of(*pair_)};
    std::vector<std::string> lines = lines_.all();
    lines.push_back(printable(summary_text(job_, result_)));
    return lines;
  }
  std::string line_of(const FrameComparison& row) const {
    return printable(is_named_ ? row_text(row) : difference_text(row));
  }

  /// Pictures of a pair, by their kinds.
  std::vector<FramePicture> pictures() const {
    const std::scoped_lock lock(mutex_);
    return pictures_of(pair());
  }
  std::vector<std::uint8_t> deltas() const {
    const std::scoped_lock lock(mutex_);
    if (pair().deltas) return pair().deltas();
    throw UsageError(fmt::format("compare: there are no deltas: {}", difference_text(pair())));
  }
  /// Of a pair. Files that are equal byte by byte have not been decoded.
  int width_px() const {
    const std::scoped_lock lock(mutex_);
    return pair().width_px > 0 ? pair().width_px : pair().reference().width_px;
  }
  /// Writes the picture of the difference.
  void save(const std::string& output) const {
    for (const FramePicture& picture : pictures()) {
      if (picture.kind != std::string_view(kDiff)) continue;
      check_output(output);
      return write_file(output, picture.png);
    }
    throw UsageError(
        fmt::format("compare: there is no difference picture: {}", difference_text(pair())));
  }
  /// Pictures of a pair that is not accepted, instead of those of an earlier one.
  void save_pictures(const std::string& folder) const {
    DiffPictures files(folder, DiffPictures::Making::when_needed);
    for (const FramePicture& picture :
         pair().is_accepted() ? std::vector<FramePicture>() : pictures()) {
      files.add(pair().key, picture.kind, picture.png);
    }
    files.finish();
  }
  void report(const std::string& page, const std::stop_token& stop) const {
    check_output(page);
    const auto report = html_report(page, ReportForm::one_file);
    if (pair_) {
      const std::scoped_lock lock(mutex_);
      report->add(*pair_);
      return report->finish(job_, result_);
    }
    const auto add = [&](const FrameComparison& row) { report->add(row); };
    report->finish(job_, compare_files(job_, add, stop));
  }

 private:
  /// Keeps the pictures of a lone pair. What belongs to a video is gone after this.
  void take(const FrameComparison& row) {
    const bool is_kept = rows_.empty() && (!are_files_ || is_pair_of_files(row));
    pair_ = is_kept ? std::optional(row) : std::nullopt;
    lines_.add(row);
    rows_.push_back(row);
    rows_.back().reference = rows_.back().actual = {};
    rows_.back().deltas = {};
  }
  static bool is_pair_of_files(const FrameComparison& row) {
    return !row.reference_path.empty() && !row.actual_path.empty();
  }
  /// @throws IoError about a side without a frame
  [[noreturn]] void refuse_empty(const std::string& name) const {
    std::error_code error;
    const bool is_there = is_picture_pattern(name) || std::filesystem::exists(name, error);
    throw IoError(is_there
                      ? "compare: " + result_.problem
                      : fmt::format("compare: cannot read '{}': {}", name, error_text(ENOENT)));
  }
  const FrameComparison& pair() const {
    if (pair_) return *pair_;
    throw UsageError(fmt::format(
        "compare: '{}' and '{}' are no pair of pictures; compare two pictures to see them",
        job_.reference, job_.actual));
  }
  void check_output(const std::string& output) const {
    refuse_standard_output(output, "compare");
    OverwriteCheck check;
    if (pair_ && !pair_->reference_path.empty())
      check.reads("the reference", pair_->reference_path);
    if (pair_ && !pair_->actual_path.empty()) check.reads("the actual picture", pair_->actual_path);
    check.writes("file", output);
    check.check();
  }

  ComparisonJob job_;
  bool are_files_;
  bool is_named_;  // whether a side is a file, which lines name
  ComparisonResult result_;
  std::optional<FrameComparison> pair_;
  mutable std::mutex mutex_;           // of the pair's functions, which keep what they have made
  std::vector<FrameComparison> rows_;  // without pictures
  ShownLines lines_;
};

std::shared_ptr<Comparison> compare_sides(const Picture& reference, const Picture& actual,
                                          const Options& options,
                                          const std::vector<MaskSource>& masks) {
  std::shared_ptr<Comparison> comparison;
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    comparison = std::make_shared<Comparison>(reference, actual,
                                              job_of(reference, actual, options, masks), stop);
  });
  return comparison;
}

py::tuple tuple_of(const PixelRect& rect) {
  return py::make_tuple(rect.x_px, rect.y_px, rect.width_px, rect.height_px);
}

/// The fields of the package's Comparison.
py::dict fields_of(const Comparison& comparison, const FrameComparison& row) {
  py::dict fields;
  fields["name"] = printable(row.name);
  fields["ok"] = row.is_accepted();
  fields["outcome"] = name_of(row.outcome);
  fields["lines"] = py::make_tuple(comparison.line_of(row));
  if (!row.difference) return fields;
  const Difference& d = *row.difference;
  fields["different_pixels"] = d.different_pixels;
  fields["off_pixels"] = d.off_pixels;
  fields["masked_pixels"] = d.masked_pixels;
  fields["largest_delta"] = d.largest_delta;
  fields["max_level"] = d.max_level;
  if (!d.is_equal()) fields["first"] = py::make_tuple(d.first.x_px, d.first.y_px, d.first.channel);
  if (d.off_pixels > 0) fields["densest"] = tuple_of(d.densest);
  fields["densest_off"] = d.densest_off;
  return fields;
}

py::list rows_of(const Comparison& comparison) {
  py::list rows;
  for (const FrameComparison& row : comparison.rows()) rows.append(fields_of(comparison, row));
  return rows;
}

py::dict pictures_of_pair(const Comparison& comparison) {
  py::dict files;
  for (const FramePicture& picture : without_gil([&] { return comparison.pictures(); }))
    files[picture.kind] = bytes_object(picture.png);
  return files;
}

py::tuple deltas_of(const Comparison& comparison) {
  const auto deltas = without_gil([&] { return comparison.deltas(); });
  const int width_px = without_gil([&] { return comparison.width_px(); });
  return py::make_tuple(width_px, bytes_object(deltas));
}

py::bytes png_of_picture(const Picture& picture) {
  return bytes_object(without_gil([&] { return picture.png(); }));
}

}  // namespace

void bind_compare(py::module_& module) {
  py::class_<Picture, std::shared_ptr<Picture>>(module, "Picture", "One side of a comparison.")
      .def("png", &png_of_picture,
           "A PNG file. Raises IoError if the one that was given cannot be read.")
      .def("write", &Picture::write, py::call_guard<WithoutGil>(), py::arg("output"),
           "The same to a file.");
  module.def("picture_of_samples", &Picture::of_samples, py::arg("samples"),
             "Of a contiguous array: uint8 or uint16; height x width, perhaps x 3 or 4.");
  module.def("picture_of_png", &Picture::of_png, py::arg("png"), "Of a PNG file in memory.");
  module.def("picture_of_path", &Picture::of_path, py::arg("path"),
             "Of a file; or what a folder, a pattern or a video has.");
  py::class_<Comparison, std::shared_ptr<Comparison>>(module, "Comparison",
                                                      "A comparison that has been made.")
      .def_property_readonly("is_pair", &Comparison::is_pair, "Whether it has two pictures.")
      .def_property_readonly("ok", &Comparison::is_accepted, "Whether all is accepted.")
      .def_property_readonly("outcome", &Comparison::outcome, "The most severe one of the rows.")
      .def_property_readonly("lines", &Comparison::lines, "What the command line prints.")
      .def_property_readonly("rows", &rows_of, "Fields of every row.")
      .def("pictures", &pictures_of_pair, "PNG files of a pair: expected, actual, diff.")
      .def("deltas", &deltas_of, "Width, and a byte for each pixel of a pair: 255 is the range.")
      .def("save", &Comparison::save, py::call_guard<WithoutGil>(), py::arg("output"),
           "Writes the difference picture of a pair.")
      .def("save_pictures", &Comparison::save_pictures, py::call_guard<WithoutGil>(),
           py::arg("folder"), "Pictures of a pair that is not accepted; removes earlier ones.")
      .def(
          "report",
          [](const Comparison& comparison, const std::string& page) {
            run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
              comparison.report(page, stop);
            });
          },
          py::arg("page"), "Writes the page of 'piblocks compare --report-in-one-file'.");
  module.def("compare", &compare_sides, py::arg("reference"), py::arg("actual"), py::arg("options"),
             py::arg("masks"),
             "'piblocks compare'; options as it has them, masks as texts or pictures.");
}

}  // namespace piblocks::python
