#include "gltf_accessors.hpp"

#include <cmath>
#include <cstring>

namespace pantin::gltf {
namespace {

/// Numbers of one model, 1 GiB as doubles: a small file may refer to the same bytes again and again.
constexpr std::uint64_t kGreatestCharge = std::uint64_t{1} << 27;
/// Elements of an accessor without bytes behind it, which is the one kind whose count nothing else bounds.
constexpr std::uint64_t kGreatestZeroCount = std::uint64_t{1} << 20;

std::size_t size_of(ComponentType type) {
  switch (type) {
    case ComponentType::Byte:
    case ComponentType::UnsignedByte:
      return 1;
    case ComponentType::Short:
    case ComponentType::UnsignedShort:
      return 2;
    case ComponentType::UnsignedInt:
    case ComponentType::Float:
      return 4;
  }
  return 4;
}

template <class T>
double read_as(const char* at) {
  T value{};
  std::memcpy(&value, at, sizeof value);  // accessors of damaged files need not be aligned
  return static_cast<double>(value);
}

/// glTF 2.0, 3.6.2.2: f = c / 127, max(c / 127, -1) where signed.
double read_component(const char* at, ComponentType type, bool normalized) {
  switch (type) {
    case ComponentType::Byte: {
      const double c = read_as<std::int8_t>(at);
      return normalized ? std::max(c / 127.0, -1.0) : c;
    }
    case ComponentType::UnsignedByte:
      return read_as<std::uint8_t>(at) / (normalized ? 255.0 : 1.0);
    case ComponentType::Short: {
      const double c = read_as<std::int16_t>(at);
      return normalized ? std::max(c / 32767.0, -1.0) : c;
    }
    case ComponentType::UnsignedShort:
      return read_as<std::uint16_t>(at) / (normalized ? 65535.0 : 1.0);
    case ComponentType::UnsignedInt:
      return read_as<std::uint32_t>(at);
    case ComponentType::Float:
      return read_as<float>(at);
  }
  return 0;
}

ComponentType component_in(Report& report, const JsonValue& holder) {
  const JsonValue value = require(report, holder, "componentType");
  const std::uint64_t code = to_size(report, value);
  if (code < 5120 || code > 5126 || code == 5124)
    report.refuse(value, "componentType " + std::to_string(code) + " is none of glTF 2.0",
                  "write 5120, 5121, 5122, 5123, 5125 or 5126");
  return static_cast<ComponentType>(code);
}

std::string_view type_for(AccessorUse use) {
  switch (use) {
    case AccessorUse::Position:
    case AccessorUse::Vector:
      return "VEC3";
    case AccessorUse::Rotation:
      return "VEC4";
    case AccessorUse::Index:
    case AccessorUse::Time:
      return "SCALAR";
  }
  return "SCALAR";
}

}  // namespace

struct Accessors::Layout {
  ComponentType component{ComponentType::Float};
  bool normalized{false};
  std::size_t width{1};
  std::uint64_t count{0};
  [[nodiscard]] std::size_t element_size() const { return width * size_of(component); }
};

Accessors::Layout Accessors::layout_of(const JsonValue& accessor, AccessorUse use) const {
  Layout layout;
  layout.component = component_in(report_, accessor);
  layout.normalized = flag_or_false(report_, accessor, "normalized");
  const JsonValue type = require(report_, accessor, "type");
  const std::string_view wanted = type_for(use);
  if (expect(report_, type, JsonKind::Text).text() != wanted)
    report_.refuse(type,
                   "its type is '" + shortened(type.text()) + "' where " + std::string{wanted} + " is needed",
                   "refer to an accessor of that type");
  layout.width = wanted == "SCALAR" ? 1 : wanted == "VEC3" ? 3 : 4;
  const JsonValue count = require(report_, accessor, "count");
  layout.count = to_size(report_, count);
  if (layout.count < 1) report_.refuse(count, "its count is 0", "leave the accessor out or give it elements");
  if (layout.normalized &&
      (layout.component == ComponentType::Float || layout.component == ComponentType::UnsignedInt))
    report_.refuse(accessor, "it is normalised, which its component type cannot be",
                   "leave 'normalized' out or use 8 or 16 bit integers");
  check_use(accessor, layout, use);
  return layout;
}

void Accessors::check_use(const JsonValue& accessor, const Layout& layout, AccessorUse use) const {
  const bool is_float = layout.component == ComponentType::Float;
  const bool is_unsigned = layout.component == ComponentType::UnsignedByte ||
                           layout.component == ComponentType::UnsignedShort ||
                           layout.component == ComponentType::UnsignedInt;
  if (use == AccessorUse::Index && (!is_unsigned || layout.normalized))
    report_.refuse(accessor, "indices must be plain unsigned integers",
                   "use componentType 5121, 5123 or 5125, not normalised");
  if (use == AccessorUse::Rotation && !is_float && !layout.normalized)
    report_.refuse(accessor, "rotations in integers must be normalised", "set 'normalized' to true");
  const bool quantized = use == AccessorUse::Position && is_quantized_;
  const bool floats_only =
      use == AccessorUse::Position || use == AccessorUse::Time || use == AccessorUse::Vector;
  if (floats_only && !is_float && !quantized)
    report_.tally(Severity::Warning, accessor, "integers stand where glTF 2.0 wants floats; read as they are",
                  "export the model again");
}

void Accessors::charge(const JsonValue& at, std::uint64_t numbers) {
  if (numbers > kGreatestCharge - charged_)
    report_.refuse(at,
                   "with this the model would hold more than " + std::to_string(kGreatestCharge) + " numbers",
                   "split the model");
  charged_ += numbers;
}

std::span<const char> Accessors::elements(const JsonValue& at, const JsonValue& holder, std::uint64_t count,
                                          std::size_t size, std::size_t& stride) {
  const JsonValue view =
      document_.item(Collection::BufferViews,
                     document_.index(require(report_, holder, "bufferView"), Collection::BufferViews));
  const std::uint64_t offset = size_or(report_, holder, "byteOffset", 0);
  const std::uint64_t step = size_or(report_, view, "byteStride", size);
  if (view.find("byteStride") && (step < 4 || step > 252 || step % 4 != 0))
    report_.refuse(view, "its byteStride is " + std::to_string(step), "write a multiple of 4 from 4 to 252");
  if (step < size)
    report_.refuse(
        at,
        "its elements of " + std::to_string(size) + " bytes overlap at byteStride " + std::to_string(step),
        "export the model again");
  const std::span<const char> bytes = buffers_.bytes_of(view);
  // count * step could overflow; a division cannot.
  if (offset > bytes.size() || size > bytes.size() - offset ||
      (bytes.size() - offset - size) / step < count - 1)
    report_.refuse(at,
                   "its " + std::to_string(count) + " elements of " + std::to_string(size) +
                       " bytes from byte " + std::to_string(offset) + " at stride " + std::to_string(step) +
                       " leave its view of " + std::to_string(bytes.size()) + " bytes",
                   "export the model again");
  stride = static_cast<std::size_t>(step);
  return bytes.subspan(static_cast<std::size_t>(offset));
}

AccessorData Accessors::read(const JsonValue& accessor, AccessorUse use) {
  const Layout layout = layout_of(accessor, use);
  const std::optional<JsonValue> sparse = member(report_, accessor, "sparse", JsonKind::Object);
  AccessorData data{
      .count = static_cast<std::size_t>(layout.count), .width = layout.width, .component = layout.component};
  if (accessor.find("bufferView")) {
    read_dense(accessor, layout, data);
  } else {
    if (layout.count > kGreatestZeroCount)
      report_.refuse(accessor, "it has no bufferView, but " + std::to_string(layout.count) + " elements",
                     "give it a bufferView or at most " + std::to_string(kGreatestZeroCount) + " elements");
    if (!sparse)
      report_.tally(Severity::Warning, accessor, "it has no bufferView: all its numbers are 0",
                    "export the model again");
    report_.supply(accessor, "bufferView", "0 is used for all numbers");
    charge(accessor, layout.count * layout.width);
    data.numbers.resize(data.count * data.width);
  }
  if (sparse) read_sparse(accessor, *sparse, layout, data);
  for (std::size_t i = 0; i < data.numbers.size(); ++i)
    if (!std::isfinite(data.numbers[i]))
      report_.refuse(accessor, "element " + std::to_string(i / data.width) + " is not a finite number",
                     "export the model again");
  return data;
}

void Accessors::read_dense(const JsonValue& accessor, const Layout& layout, AccessorData& data) {
  std::size_t stride = 0;
  const std::span<const char> bytes =
      elements(accessor, accessor, layout.count, layout.element_size(), stride);
  charge(accessor, layout.count * layout.width);
  data.numbers.reserve(data.count * data.width);
  const std::size_t size = size_of(layout.component);
  for (std::size_t i = 0; i < data.count; ++i)
    for (std::size_t k = 0; k < data.width; ++k)
      data.numbers.push_back(
          read_component(bytes.data() + i * stride + k * size, layout.component, layout.normalized));
}

void Accessors::read_sparse(const JsonValue& accessor, const JsonValue& sparse, const Layout& layout,
                            AccessorData& data) {
  const std::uint64_t count = to_size(report_, require(report_, sparse, "count"));
  if (count < 1 || count > layout.count)
    report_.refuse(
        sparse, "it replaces " + std::to_string(count) + " of " + std::to_string(layout.count) + " elements",
        "write a count from 1 to that");
  const JsonValue indices = require(report_, sparse, "indices");
  const JsonValue values = require(report_, sparse, "values");
  const ComponentType index_type = component_in(report_, indices);
  if (index_type != ComponentType::UnsignedByte && index_type != ComponentType::UnsignedShort &&
      index_type != ComponentType::UnsignedInt)
    report_.refuse(indices, "sparse indices must be unsigned integers",
                   "use componentType 5121, 5123 or 5125");
  std::size_t index_stride = 0;
  std::size_t value_stride = 0;
  const std::span<const char> index_bytes =
      elements(indices, indices, count, size_of(index_type), index_stride);
  const std::span<const char> value_bytes =
      elements(values, values, count, layout.element_size(), value_stride);
  double previous = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const double index = read_component(index_bytes.data() + i * index_stride, index_type, false);
    if (!(index > previous && index < static_cast<double>(data.count)))
      report_.refuse(accessor,
                     "sparse index " + std::to_string(i) + " is out of order or beyond the last element",
                     "export the model again");
    previous = index;
    for (std::size_t k = 0; k < data.width; ++k)
      data.numbers[static_cast<std::size_t>(index) * data.width + k] =
          read_component(value_bytes.data() + i * value_stride + k * size_of(layout.component),
                         layout.component, layout.normalized);
  }
}

}  // namespace pantin::gltf
