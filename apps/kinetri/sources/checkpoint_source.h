// SPDX-License-Identifier: GPL-3.0-or-later
//
// A checkpoint as the source of a run: one that was broken off.
#ifndef KINETRI_APPS_CHECKPOINT_SOURCE_H
#define KINETRI_APPS_CHECKPOINT_SOURCE_H

#include "kinetri/io/checkpoint_file.h"
#include "sources/run_source.h"

namespace kinetri::app {

class Checkpoint_source final : public Run_source {
 public:
  /// `path` is a path, or "-"; `until` the end of the run.
  Checkpoint_source(std::string path, double until) : path_(std::move(path)), until_(until) {}

  std::string path() const override { return path_; }
  void read() override;
  std::size_t number_of_points() const override;
  double from() const override { return time().to_double(); }
  double until() const override { return until_; }
  std::string response() const override { return checkpoint_.response; }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  std::vector<std::string> remarks() const override;

 private:
  const Algebraic_number& time() const {
    return std::visit(
        [](const auto& snapshot) -> auto& { return snapshot.triangulation.time; },
        checkpoint_.simulation);
  }

  std::string path_;
  double until_;
  Checkpoint checkpoint_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_CHECKPOINT_SOURCE_H
