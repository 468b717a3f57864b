// A list through its members: each carries its own link, so joining and leaving cost a few pointers
// and no memory. An object is in at most one list per hook; it leaves by itself when it is
// destroyed. The list owns nothing. Belongs to one node; no locks.
#pragma once

namespace luxodus {

/// What an object inherits to be in lists. Requires: the object stays where it is (not movable).
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

  // A ring: a lone hook, and the head of an empty list, point to themselves.
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

  /// The first, taken out; null where there is none.
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
