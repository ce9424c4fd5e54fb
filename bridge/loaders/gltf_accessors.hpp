#pragma once
// Reads accessors: typed numbers in the bytes of buffers, interleaved, normalised or sparse. glTF 2.0, 3.6.2.
// Float values become doubles exactly; normalised integers are divided in double.
#include "gltf_buffers.hpp"

namespace pantin::gltf {

enum class ComponentType : std::uint16_t {
  Byte = 5120,
  UnsignedByte = 5121,
  Short = 5122,
  UnsignedShort = 5123,
  UnsignedInt = 5125,
  Float = 5126,
};

/// What an accessor is read for, and what glTF allows there.
enum class AccessorUse {
  Position,  ///< VEC3 float; any integer where KHR_mesh_quantization is used
  Index,     ///< SCALAR unsigned integer, not normalised
  Time,      ///< SCALAR float
  Vector,    ///< VEC3 float: translations and scales
  Rotation,  ///< VEC4 float or normalised integer
};

struct AccessorData {
  std::size_t count{0};  ///< elements
  std::size_t width{0};  ///< numbers per element
  ComponentType component{ComponentType::Float};
  std::vector<double> numbers{};  ///< count * width, finite
};

class Accessors {
 public:
  explicit Accessors(const Document& document)
      : document_{document}, report_{document.report()}, buffers_{document} {}

  /// Refuses an accessor of the wrong type, one that reaches beyond its bytes, and numbers that are not
  /// finite.
  [[nodiscard]] AccessorData read(const JsonValue& accessor, AccessorUse use);
  /// Counts numbers that the model will hold; refused, by the place given, beyond a billion bytes of them.
  void charge(const JsonValue& at, std::uint64_t numbers);
  [[nodiscard]] const Buffers& buffers() const noexcept { return buffers_; }

 private:
  struct Layout;
  [[nodiscard]] Layout layout_of(const JsonValue& accessor, AccessorUse use) const;
  void check_use(const JsonValue& accessor, const Layout& layout, AccessorUse use) const;
  void read_dense(const JsonValue& accessor, const Layout& layout, AccessorData& data);
  void read_sparse(const JsonValue& accessor, const JsonValue& sparse, const Layout& layout,
                   AccessorData& data);
  std::span<const char> elements(const JsonValue& at, const JsonValue& holder, std::uint64_t count,
                                 std::size_t size, std::size_t& stride);

  const Document& document_;
  Report& report_;
  Buffers buffers_;
  bool is_quantized_{document_.uses("KHR_mesh_quantization")};
  std::uint64_t charged_{0};
};

}  // namespace pantin::gltf
