// Short forms for vectors of numbers. For kernels only, after each_target.h.
//
// A kernel processes blocks of a fixed number of values, in as many vectors as the target needs.
// Sums and products are never fused and never reordered: all targets produce the same bits.
//
// Compiled once for each target, which this guard allows.
#if defined(MOCAP_CORE_KERNELS_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MOCAP_CORE_KERNELS_VECTORS_INL_H
#undef MOCAP_CORE_KERNELS_VECTORS_INL_H
#else
#define MOCAP_CORE_KERNELS_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of at most `most` floats, and of as many integers.
template <std::size_t most>
using FloatsUpTo = hn::CappedTag<float, most>;
template <typename D>
using IntsFor = hn::Rebind<std::int32_t, D>;

/// Loads integers as floats.
template <typename D, typename Number>
HWY_INLINE hn::Vec<D> LoadAsFloats(D d, const Number* from) {
  const hn::Rebind<Number, D> d_number;
  return hn::ConvertTo(d, hn::PromoteTo(IntsFor<D>(), hn::LoadU(d_number, from)));
}

/// The larger and the smaller number. Max() and Min() depend on the target if one is NaN.
template <typename V>
HWY_INLINE V Larger(V a, V b) {
  return hn::IfThenElse(hn::Lt(a, b), b, a);
}
template <typename V>
HWY_INLINE V Lesser(V a, V b) {
  return hn::IfThenElse(hn::Lt(a, b), a, b);
}
template <typename D>
HWY_INLINE hn::Vec<D> Clamped(D d, hn::Vec<D> x, hn::TFromD<D> low, hn::TFromD<D> high) {
  x = Larger(x, hn::Set(d, low));
  return hn::IfThenElse(hn::Gt(x, hn::Set(d, high)), hn::Set(d, high), x);
}

/// Returns a bit for each lane, the first in the lowest bit. At most eight lanes.
template <typename D>
HWY_INLINE unsigned BitsOf(D d, hn::Mask<D> mask) {
  static_assert(hn::MaxLanes(D()) <= 8);
  std::uint8_t bits[8];
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

// Two things that Highway 1.0.3 does slowly, and the compiler's own vectors do not. Targets without
// registers for vectors gain nothing.
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#undef MOCAP_HAS_REGISTERS
#define MOCAP_HAS_REGISTERS 1
/// Makes a Highway vector from a compiler's vector of the same size.
template <typename V, typename Raw>
HWY_INLINE V FromRaw(Raw raw) {
  return V{reinterpret_cast<decltype(V::raw)>(raw)};
}
// GCC 12 ignores the attribute of an alias whose size depends on a parameter.
template <typename Number, std::size_t size>
struct RawVector {
  typedef Number Type __attribute__((vector_size(size)));
};
template <typename Number, typename V>
using RawLike = typename RawVector<Number, sizeof(V::raw)>::Type;
#else
#undef MOCAP_HAS_REGISTERS
#define MOCAP_HAS_REGISTERS 0
#endif

/// Rounds towards zero. Numbers must fit: ConvertTo() takes four instructions more for those that
/// do not.
template <typename D>
HWY_INLINE hn::Vec<IntsFor<D>> Truncated([[maybe_unused]] D d, hn::Vec<D> x) {
#if MOCAP_HAS_REGISTERS
  using Ints = hn::Vec<IntsFor<D>>;
  return FromRaw<Ints>(__builtin_convertvector(x.raw, RawLike<std::int32_t, Ints>));
#else
  return hn::ConvertTo(IntsFor<D>(), x);
#endif
}

/// Places in tables. They pass through memory, because extracting them from a register one by one
/// occupies the units that shuffle. They are volatile, or compilers would know that they are still
/// there.
template <typename D>
class Places {
 public:
  HWY_INLINE explicit Places(hn::Vec<IntsFor<D>> places) { hn::Store(places, IntsFor<D>(), at_); }
  HWY_INLINE std::int32_t operator[](std::size_t lane) const {
    const volatile std::int32_t* const at = at_;
    return at[lane];
  }
  template <typename Number>
  HWY_INLINE auto LookUp(const Number* table) const {
    return LookUp(table, std::make_index_sequence<kLanes>());
  }

 private:
  static constexpr std::size_t kLanes = hn::MaxLanes(D());

  // Written to memory, the numbers would be read again only after all writes are done.
  template <typename Number, std::size_t... lanes>
  HWY_INLINE auto LookUp(const Number* table, std::index_sequence<lanes...>) const {
    constexpr hn::Rebind<Number, D> d;
#if MOCAP_HAS_REGISTERS
    using V = hn::Vec<std::remove_const_t<decltype(d)>>;
    return FromRaw<V>(RawLike<Number, V>{table[(*this)[lanes]]...});
#else
    HWY_ALIGN const Number found[kLanes] = {table[(*this)[lanes]]...};
    return hn::Load(d, found);
#endif
  }

  HWY_ALIGN std::int32_t at_[kLanes];
};

}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // MOCAP_CORE_KERNELS_VECTORS_INL_H
