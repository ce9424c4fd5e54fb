#pragma once
// A glTF document ready to be read: its JSON checked for version and required extensions, and its items at
// hand.
#include <array>
#include <filesystem>

#include "gltf_container.hpp"
#include "gltf_fields.hpp"

namespace pantin::gltf {

/// The arrays of a document that its values refer to by index.
enum class Collection { Accessors, Animations, Buffers, BufferViews, Meshes, Nodes, Scenes };

class Document {
 public:
  /// Refuses files that are no glTF 2, or that need an extension which is not known here.
  Document(const std::filesystem::path& file, Report& report);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  [[nodiscard]] Report& report() const noexcept { return report_; }
  [[nodiscard]] const Container& container() const noexcept { return container_; }
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] JsonValue root() const { return tree_.root(); }
  /// All values of the document, those that hold others before these.
  [[nodiscard]] std::size_t value_count() const noexcept { return tree_.size(); }
  [[nodiscard]] JsonValue value(std::size_t index) const { return tree_.value(index); }
  [[nodiscard]] std::size_t count(Collection collection) const;
  [[nodiscard]] JsonValue item(Collection collection, std::size_t i) const;
  /// The index that `value` holds into a collection; refused if it is none.
  [[nodiscard]] std::size_t index(const JsonValue& value, Collection collection) const;
  /// The item that member `key` of `object` refers to, or nothing where there is no such member.
  [[nodiscard]] std::optional<JsonValue> referred(const JsonValue& object, std::string_view key,
                                                  Collection collection) const;
  /// Whether the document says that it uses an extension.
  [[nodiscard]] bool uses(std::string_view extension) const;

 private:
  void check_asset() const;
  void check_required_extensions() const;

  Report& report_;
  std::filesystem::path folder_;
  Container container_;
  JsonTree tree_;
  std::array<std::optional<JsonValue>, 7> collections_{};
};

/// The name of a collection in the document, "bufferViews" say.
[[nodiscard]] std::string_view to_string(Collection collection) noexcept;

/// What is known of an extension.
enum class ExtensionUse {
  Read,        ///< all or part of it is read
  Appearance,  ///< about looks or sound only: physics has no use for it
  Unknown,
};
[[nodiscard]] ExtensionUse use_of(std::string_view extension) noexcept;

}  // namespace pantin::gltf
