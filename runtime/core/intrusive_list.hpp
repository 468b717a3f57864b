// An intrusive list: each member carries its own link, so insertion and removal cost a few pointer
// writes and no memory. An object is in at most one list per hook and leaves it when it is
// destroyed. The list owns nothing. Thread rule: belongs to one node; no locks.
#pragma once

namespace luxodus {

/// Base class of list members. Requires: the object is not moved.
class ListHook {
 public:
  ListHook() = default;
  ListHook(const ListHook&) = delete;
  ListHook& operator=(const ListHook&) = delete;
  ~ListHook() { unlink(); }

  bool linked() const { return next_ != this; }

  /// Leaves the list it is in, if any.
  void unlink() {
    previous_->next_ = next_;
    next_->previous_ = previous_;
    previous_ = next_ = this;
  }

 private:
  template <class T>
  friend class IntrusiveList;

  // A ring: an unlinked hook, and the head of an empty list, point to themselves.
  ListHook* previous_ = this;
  ListHook* next_ = this;
};

/// First in, first out. T inherits ListHook.
template <class T>
class IntrusiveList {
 public:
  IntrusiveList() = default;
  ~IntrusiveList() { clear(); }

  bool empty() const { return !head_.linked(); }

  /// Requires: `member` is in no list.
  void push_back(T& member) {
    ListHook& hook = member;
    hook.previous_ = head_.previous_;
    hook.next_ = &head_;
    head_.previous_->next_ = &hook;
    head_.previous_ = &hook;
  }

  /// Requires: !empty().
  T& front() { return static_cast<T&>(*head_.next_); }

  /// Removes and returns the first; null if the list is empty.
  T* pop_front() {
    if (empty()) return nullptr;
    T& first = front();
    static_cast<ListHook&>(first).unlink();
    return &first;
  }

  void clear() {
    while (!empty()) head_.next_->unlink();
  }

 private:
  ListHook head_;
};

}  // namespace luxodus
