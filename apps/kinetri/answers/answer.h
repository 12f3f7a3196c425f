// SPDX-License-Identifier: GPL-3.0-or-later
//
// The answers to questions about a run. An answer is an observer of the simulation from its start
// on, and a table written at the end. Each has a row in outputs/output_table.h, a row in
// answers.cpp and a source here.
#ifndef KINETRI_APPS_ANSWER_H
#define KINETRI_APPS_ANSWER_H

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "answers/answer_settings.h"
#include "outputs/run_outputs.h"
#include "sources/any_simulation.h"
#include "sources/run_source.h"

namespace kinetri::app {

/// Observes a run from its construction on. The simulation must outlive it.
class Answer {
 public:
  virtual ~Answer() = default;
  Answer(const Answer&) = delete;
  Answer& operator=(const Answer&) = delete;

  /// Writes the answer up to now.
  virtual void write(std::ostream& out) = 0;

 protected:
  Answer() = default;
};

/// An answer and its output.
struct Followed_answer {
  Output output;
  std::unique_ptr<Answer> answer;
};

/// Constructs the answers that the outputs need. `source` must outlive the result. Throws
/// Usage_error if a question has no answer for this kind of motion.
std::vector<Followed_answer> follow_answers(Run_outputs& outputs, const Answer_settings& settings,
                                            const Any_simulation& simulation,
                                            const Run_source& source);

/// `time_lo,time_hi` of a time, as in every table.
std::string time_bounds(const Algebraic_number& time);

/// @{
/// Those that there are.
std::unique_ptr<Answer> closest_answer(const Answer_settings& settings,
                                       const Any_simulation& simulation, const Run_source& source);
std::unique_ptr<Answer> neighbors_answer(const Answer_settings& settings,
                                         const Any_simulation& simulation,
                                         const Run_source& source);
std::unique_ptr<Answer> exchanges_answer(const Answer_settings& settings,
                                         const Any_simulation& simulation,
                                         const Run_source& source);
std::unique_ptr<Answer> nearest_answer(const Answer_settings& settings,
                                       const Any_simulation& simulation, const Run_source& source);
std::unique_ptr<Answer> components_answer(const Answer_settings& settings,
                                          const Any_simulation& simulation,
                                          const Run_source& source);
std::unique_ptr<Answer> connected_answer(const Answer_settings& settings,
                                         const Any_simulation& simulation,
                                         const Run_source& source);
std::unique_ptr<Answer> spanning_tree_answer(const Answer_settings& settings,
                                             const Any_simulation& simulation,
                                             const Run_source& source);
std::unique_ptr<Answer> mean_areas_answer(const Answer_settings& settings,
                                          const Any_simulation& simulation,
                                          const Run_source& source);
std::unique_ptr<Answer> encounters_answer(const Answer_settings& settings,
                                          const Any_simulation& simulation,
                                          const Run_source& source);
std::unique_ptr<Answer> contact_plan_answer(const Answer_settings& settings,
                                            const Any_simulation& simulation,
                                            const Run_source& source);
/// @}

}  // namespace kinetri::app

#endif  // KINETRI_APPS_ANSWER_H
