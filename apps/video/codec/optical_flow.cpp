// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/optical_flow.h"

#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace kinetri::video {
namespace {

const cv::Size window(15, 15);
constexpr int levels = 3;
constexpr float furthest_back = 0.5F;
// Threshold per pixel of the least eigenvalue of the matrix of gradients: below it there is no
// corner. In OpenCV's units, gray levels are divided by 32 and gradients by 32.
constexpr float least_eigenvalue = 1e-3F;
// Parts in a row and in a column in which a fade is detected.
constexpr int parts = 8;
// The fraction of parts whose contrast decreases, or increases, in a fade.
constexpr double share_of_fade = 0.8;

// Samples of the next frame, where the picture is at rest, are those of the present one times a
// factor plus an offset.
struct Fade {
  double factor = 1;
  double sum = 0;
};

double median(std::array<double, parts * parts>& values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The fade from one frame to the next, in which nearly all parts of the picture change their
// contrast in the same direction; motion changes it in both directions.
std::optional<Fade> fade_between(const cv::Mat& present, const cv::Mat& next) {
  if (present.cols < 2 * parts || present.rows < 2 * parts) return std::nullopt;
  std::array<double, parts* parts> factors = {};
  std::array<double, parts* parts> present_means = {};
  std::array<double, parts* parts> next_means = {};
  std::size_t weaker = 0;
  std::size_t stronger = 0;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const int column = static_cast<int>(i) % parts;
    const int row = static_cast<int>(i) / parts;
    const cv::Rect part(
        cv::Point(present.cols * column / parts, present.rows * row / parts),
        cv::Point(present.cols * (column + 1) / parts, present.rows * (row + 1) / parts));
    cv::Scalar present_mean;
    cv::Scalar present_deviation;
    cv::Scalar next_mean;
    cv::Scalar next_deviation;
    cv::meanStdDev(present(part), present_mean, present_deviation);
    cv::meanStdDev(next(part), next_mean, next_deviation);
    factors[i] = present_deviation[0] > 0 ? next_deviation[0] / present_deviation[0] : 1;
    present_means[i] = present_mean[0];
    next_means[i] = next_mean[0];
    if (factors[i] < 1) ++weaker;
    if (factors[i] > 1) ++stronger;
  }
  if (static_cast<double>(std::max(weaker, stronger)) <
      share_of_fade * static_cast<double>(factors.size())) {
    return std::nullopt;
  }
  Fade result;
  result.factor = median(factors);
  std::array<double, parts* parts> sums = {};
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] = next_means[i] - result.factor * present_means[i];
  }
  result.sum = median(sums);
  return result;
}

std::vector<cv::Mat> pyramid_of(const cv::Mat& frame) {
  std::vector<cv::Mat> result;
  cv::buildOpticalFlowPyramid(frame, result, window, levels);
  return result;
}

}  // namespace

struct Optical_flow::Pyramids {
  cv::Mat next_frame;
  std::vector<cv::Mat> present;
  std::vector<cv::Mat> next;
};

Optical_flow::Optical_flow(std::uint32_t width, std::uint32_t height)
    : width_(static_cast<int>(width)),
      height_(static_cast<int>(height)),
      pyramids_(std::make_unique<Pyramids>()) {}

Optical_flow::~Optical_flow() = default;

void Optical_flow::add(std::span<const std::uint8_t> brightness) {
  cv::Mat frame(height_, width_, CV_8UC1);
  std::ranges::copy(brightness, frame.data);
  pyramids_->present = std::move(pyramids_->next);
  pyramids_->next = pyramid_of(frame);
  if (const cv::Mat& present = pyramids_->next_frame; !present.empty()) {
    // The flow expects samples to keep their brightness.
    if (const auto fade = fade_between(present, frame)) {
      cv::Mat faded;
      present.convertTo(faded, CV_8UC1, fade->factor, fade->sum);
      pyramids_->present = pyramid_of(faded);
    }
  }
  pyramids_->next_frame = std::move(frame);
}

std::vector<Track> Optical_flow::follow(std::span<const Vector_2> places) const {
  std::vector<Track> result(places.size());
  if (places.empty()) return result;
  // OpenCV's coordinates of pixel centers are whole numbers.
  std::vector<cv::Point2f> from;
  for (const Vector_2& p : places) {
    from.emplace_back(static_cast<float>(p.x - 0.5), static_cast<float>(p.y - 0.5));
  }
  std::vector<cv::Point2f> to;
  std::vector<cv::Point2f> back;
  std::vector<unsigned char> found;
  std::vector<unsigned char> found_back;
  std::vector<float> eigenvalues;
  std::vector<float> errors;
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.02);
  cv::calcOpticalFlowPyrLK(pyramids_->present, pyramids_->next, from, to, found, eigenvalues,
                           window, levels, criteria, cv::OPTFLOW_LK_GET_MIN_EIGENVALS, 1e-6);
  // The backward search starts with the expected result, the original position.
  back = from;
  cv::calcOpticalFlowPyrLK(pyramids_->next, pyramids_->present, to, back, found_back, errors,
                           window, levels, criteria, cv::OPTFLOW_USE_INITIAL_FLOW, 1e-6);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const cv::Point2f gap = back[i] - from[i];
    result[i].place = {to[i].x + 0.5, to[i].y + 0.5};
    const bool comes_back =
        found[i] != 0 && found_back[i] != 0 && gap.dot(gap) <= furthest_back * furthest_back;
    if (!(eigenvalues[i] >= least_eigenvalue)) {
      result[i].kind = Track::Kind::featureless;
    } else {
      result[i].kind = comes_back ? Track::Kind::followed : Track::Kind::lost;
    }
  }
  return result;
}

}  // namespace kinetri::video
