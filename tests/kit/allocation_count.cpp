#include "tests/kit/allocation_count.hpp"

#include <link.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

thread_local uint64_t allocations = 0;
thread_local uint64_t zmq_allocations = 0;

/// Address range of libzmq in the loaded program.
uintptr_t zmq_begin = 0, zmq_end = 0;

int find_zmq(dl_phdr_info* object, size_t, void*) {
  if (std::strstr(object->dlpi_name, "libzmq") == nullptr) return 0;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& part = object->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
    zmq_begin = object->dlpi_addr + part.p_vaddr;
    zmq_end = zmq_begin + part.p_memsz;
  }
  return 1;
}

[[gnu::constructor]] void find_libraries() {
  dl_iterate_phdr(find_zmq, nullptr);
}

[[maybe_unused]] void note(const void* caller) {  // sanitizers have counts of their own
  ++allocations;
  const auto at = reinterpret_cast<uintptr_t>(caller);
  if (at >= zmq_begin && at < zmq_end) ++zmq_allocations;
}

}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

// glibc's allocator under its other names; free() needs none, since it is the same allocator.
extern "C" {
void* __libc_malloc(size_t bytes);
void* __libc_calloc(size_t count, size_t bytes);
void* __libc_realloc(void* old, size_t bytes);
void* __libc_memalign(size_t alignment, size_t bytes);

void* malloc(size_t bytes) {
  note(__builtin_return_address(0));
  return __libc_malloc(bytes);
}
void* calloc(size_t count, size_t bytes) {
  note(__builtin_return_address(0));
  return __libc_calloc(count, bytes);
}
void* realloc(void* old, size_t bytes) {
  note(__builtin_return_address(0));
  return __libc_realloc(old, bytes);
}
void* memalign(size_t alignment, size_t bytes) {
  note(__builtin_return_address(0));
  return __libc_memalign(alignment, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) {
  note(__builtin_return_address(0));
  return __libc_memalign(alignment, bytes);
}
int posix_memalign(void** out, size_t alignment, size_t bytes) {
  note(__builtin_return_address(0));
  *out = __libc_memalign(alignment, bytes);
  return *out == nullptr ? ENOMEM : 0;
}
}

// Not in the library, where the caller would be hidden.
void* operator new(size_t bytes) {
  note(__builtin_return_address(0));
  if (void* memory = __libc_malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
  note(__builtin_return_address(0));
  return __libc_malloc(bytes);
}
void operator delete(void* memory) noexcept {
  free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  free(memory);
}

bool luxodus::test::allocations_are_counted() {
  return true;
}

#else

bool luxodus::test::allocations_are_counted() {
  return false;
}

#endif

uint64_t luxodus::test::allocations_of_this_thread() {
  return allocations;
}

uint64_t luxodus::test::allocations_by_zmq() {
  return zmq_allocations;
}
