// A function that is only called while it lives: a lambda seen through one pointer more, without
// memory of its own. For arguments; what is kept for later is a std::function.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace lantern {

template <class Signature>
class FunctionRef;

template <class R, class... Args>
class FunctionRef<R(Args...)> {
 public:
  FunctionRef() = default;  // none: not to be called
  template <class F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef> &&
           std::is_invocable_r_v<R, F&, Args...>) FunctionRef(F&& f)
      : function_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
        call_([](void* function, Args... args) -> R {
          return (*static_cast<std::remove_reference_t<F>*>(function))(std::forward<Args>(args)...);
        }) {}

  R operator()(Args... args) const { return call_(function_, std::forward<Args>(args)...); }
  explicit operator bool() const { return call_ != nullptr; }

 private:
  void* function_ = nullptr;
  R (*call_)(void*, Args...) = nullptr;
};

}  // namespace lantern
