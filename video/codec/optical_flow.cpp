// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/optical_flow.h"

#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <utility>

namespace kinetri::video {
namespace {

const cv::Size window(15, 15);
constexpr int levels = 3;
constexpr float furthest_back = 0.5F;
// Of the least eigenvalue of the matrix of gradients, for a pixel: below it there is no corner. In
// OpenCV's unit, gray levels are divided by 32 and gradients by 32.
constexpr float least_eigenvalue = 1e-3F;

}  // namespace

struct Optical_flow::Pyramids {
  std::vector<cv::Mat> present;
  std::vector<cv::Mat> next;
};

Optical_flow::Optical_flow(std::uint32_t width, std::uint32_t height)
    : width_(static_cast<int>(width)),
      height_(static_cast<int>(height)),
      pyramids_(std::make_unique<Pyramids>()) {}

Optical_flow::~Optical_flow() = default;

void Optical_flow::add(std::span<const std::uint8_t> brightness) {
  pyramids_->present = std::move(pyramids_->next);
  cv::Mat frame(height_, width_, CV_8UC1);
  std::ranges::copy(brightness, frame.data);
  pyramids_->next = {};
  cv::buildOpticalFlowPyramid(frame, pyramids_->next, window, levels);
}

std::vector<Track> Optical_flow::follow(std::span<const Vector_2> places) const {
  std::vector<Track> result(places.size());
  if (places.empty()) return result;
  // A pixel's center has whole numbers as coordinates there.
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
  // The way back begins with the expected result, which is the place itself.
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
