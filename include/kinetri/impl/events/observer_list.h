// SPDX-License-Identifier: GPL-3.0-or-later
//
// The observers of an object, which may be removed while they are called.
#ifndef KINETRI_IMPL_EVENTS_OBSERVER_LIST_H
#define KINETRI_IMPL_EVENTS_OBSERVER_LIST_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// Observers in the order in which they were added. An observer that is removed while they are
/// called, by itself or by another one, is not called any more; one that is added then is called
/// from the next call on.
template <class Observer>
class Observer_list {
 public:
  bool empty() const noexcept { return observers_.empty(); }

  void add(Observer& observer) { observers_.push_back(&observer); }

  /// Does nothing if the observer is not there.
  void remove(const Observer& observer) {
    if (calls_ == 0) {
      std::erase(observers_, &observer);
    } else {  // the others keep their numbers
      std::ranges::replace_if(
          observers_, [&](const Observer* other) { return other == &observer; }, nullptr);
    }
  }

  template <class Function>
  void call(const Function& function) {
    const Call call(*this);
    const std::size_t size = observers_.size();
    for (std::size_t i = 0; i < size; ++i) {
      if (observers_[i] != nullptr) function(*observers_[i]);
    }
  }

  template <class Predicate>
  bool any_of(const Predicate& is_so) const {
    return std::ranges::any_of(observers_, [&](const Observer* observer) {
      return observer != nullptr && is_so(*observer);
    });
  }

 private:
  class Call {
   public:
    explicit Call(Observer_list& list) : list_(list) { ++list_.calls_; }
    ~Call() {
      if (--list_.calls_ == 0) std::erase(list_.observers_, nullptr);
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    Observer_list& list_;
  };

  std::vector<Observer*> observers_;  // null if it was removed during a call
  int calls_ = 0;                     // that have not ended
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_EVENTS_OBSERVER_LIST_H
