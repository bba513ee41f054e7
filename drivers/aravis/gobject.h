// RAII wrappers for GLib's references and errors.
#pragma once

#include <glib-object.h>

#include <memory>
#include <string>

namespace mocap {

struct GUnref {
  void operator()(void* object) const { g_object_unref(object); }
};
/// Owns one reference.
template <typename T>
using GPtr = std::unique_ptr<T, GUnref>;

struct GFree {
  void operator()(void* memory) const { g_free(memory); }
};

/// Owns a GError; pass it where GLib expects a GError**.
class GFailure {
 public:
  GFailure() = default;
  GFailure(const GFailure&) = delete;
  GFailure& operator=(const GFailure&) = delete;
  ~GFailure() { Clear(); }

  /// For passing to a function; clears an earlier error.
  operator GError**() {
    Clear();
    return &error_;
  }
  bool failed() const { return error_ != nullptr; }
  std::string text() const { return error_ ? error_->message : "no reason given"; }

 private:
  void Clear() { g_clear_error(&error_); }
  GError* error_ = nullptr;
};

}  // namespace mocap
