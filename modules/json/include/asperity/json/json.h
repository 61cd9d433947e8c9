#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <limits>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace asperity {

struct JsonMember;
struct JsonMembers;

// Where a value begins in the text that it was read from, from 1; line 0: it was not read from a text.
struct JsonPlace {
  std::size_t line = 0;
  std::size_t column = 0;
};

// One value of JSON: null, true or false, a number, a text, a list or an object. The members of an object keep the
// order in which they were set; finding one of n takes of the order of log n comparisons. Whole numbers keep all of
// their 64 bits. A use that does not fit the kind of value throws Error. Lists and objects are copied whole.
//
//   Json out;
//   out["name"] = "wood";
//   out["peaks"] = {{"count", 3}, {"at_m", {0.1, 0.2, 0.4}}};
//   write_file(path, out.dump(2) + "\n");
class Json {
 public:  // NOLINTBEGIN(google-explicit-constructor): values become Json wherever one is wanted
  Json() noexcept {}
  Json(std::nullptr_t) noexcept {}
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();

  template <class T>
  requires std::is_arithmetic_v<T> Json(T value)
  noexcept {
    if constexpr (std::is_same_v<T, bool>) {
      set_bool(value);
    } else if constexpr (std::is_floating_point_v<T>) {
      set_number(static_cast<double>(value));
    } else if constexpr (std::is_signed_v<T>) {
      set_integer(value);
    } else {
      set_unsigned(value);
    }
  }
  template <class T>
  requires std::convertible_to<const T&, std::string_view> Json(const T& text) { set_text(std::string_view(text)); }
  Json(std::string&& text);
  // A list of what the range holds, or an object of a map.
  template <std::ranges::input_range R>
  requires(!std::convertible_to<const R&, std::string_view> && !std::same_as<R, Json> &&
           !std::same_as<std::ranges::range_value_t<R>, R>) Json(const R& range) {
    if constexpr (requires { typename R::mapped_type; }) {
      become_object();
      for (const auto& [key, value] : range) (*this)[key] = Json(value);
    } else {
      become_list();
      for (const auto& value : range) push_back(Json(value));
    }
  }
  // An object if each is a list of a text and a value, otherwise a list.
  Json(std::initializer_list<Json> values);
  // NOLINTEND(google-explicit-constructor)
  static Json array(std::initializer_list<Json> values = {});
  static Json object();

  bool is_null() const noexcept { return kind_ == kNull; }
  bool is_boolean() const noexcept { return kind_ == kBool; }
  bool is_number() const noexcept { return kind_ == kInteger || kind_ == kUnsigned || kind_ == kNumber; }
  bool is_number_integer() const noexcept { return kind_ == kInteger || kind_ == kUnsigned; }
  bool is_number_unsigned() const noexcept { return kind_ == kUnsigned; }  // read as a whole number of 0 or more
  bool is_string() const noexcept { return kind_ == kText; }
  bool is_array() const noexcept { return kind_ == kList; }
  bool is_object() const noexcept { return kind_ == kObject; }

  // The value as a bool, number, std::string or vector of those. Throws Error if it is of another kind or does not fit.
  template <class T>
  T get() const {
    if constexpr (std::is_same_v<T, Json>) {
      return *this;
    } else if constexpr (std::is_same_v<T, bool>) {
      return as_bool();
    } else if constexpr (std::is_floating_point_v<T>) {
      return static_cast<T>(as_number());
    } else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>) {
      return static_cast<T>(as_integer(std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
    } else if constexpr (std::is_integral_v<T>) {
      return static_cast<T>(as_unsigned(std::numeric_limits<T>::max()));
    } else if constexpr (std::is_same_v<T, std::string>) {
      return text();
    } else {
      T out;
      for (const Json& value : list()) out.push_back(value.template get<typename T::value_type>());
      return out;
    }
  }
  const std::string& text() const;
  const std::vector<Json>& list() const;

  // Of a list or object; 0 for null, 1 for others.
  std::size_t size() const noexcept;
  bool empty() const noexcept { return size() == 0; }

  // Elements of a list. null becomes a list when something is appended.
  void push_back(Json value);
  Json& at(std::size_t i);
  const Json& at(std::size_t i) const;
  template <std::integral I>
  Json& operator[](I i) {
    return at(static_cast<std::size_t>(i));
  }
  template <std::integral I>
  const Json& operator[](I i) const {
    return at(static_cast<std::size_t>(i));
  }
  const Json& back() const { return at(size() - 1); }
  // Of a list; of null there is nothing.
  Json* begin();
  Json* end();
  const Json* begin() const;
  const Json* end() const;
  void erase_at(std::size_t i);
  void insert_at(std::size_t i, Json value);

  // Members of an object. null becomes an object when a member is set.
  Json& operator[](std::string_view key);  // null, appended, if it was not there
  const Json& operator[](std::string_view key) const { return at(key); }
  Json& at(std::string_view key);
  const Json& at(std::string_view key) const;
  // nullptr if it is not there or this is not an object.
  Json* find(std::string_view key);
  const Json* find(std::string_view key) const;
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  const std::vector<JsonMember>& items() const;
  std::size_t erase(std::string_view key);
  void update(const Json& other);  // sets all members of `other`
  // `fallback` if the member is not there.
  template <class T>
  T value(std::string_view key, const T& fallback) const {
    const Json* found = require_object().find(key);
    return found == nullptr ? fallback : found->template get<T>();
  }
  std::string value(std::string_view key, const char* fallback) const { return value(key, std::string(fallback)); }

  // The members of this and of all objects within, by their keys' bytes.
  void sort_keys();

  // The text: on one line, or with `indent` blanks a level. Numbers that are not finite are written as null. Throws
  // Error for a text that is not UTF-8.
  std::string dump(int indent = -1) const;
  // The same; bytes that are not UTF-8 become U+FFFD.
  std::string dump_repaired(int indent = -1) const;
  // The same as dump(), the members of all objects in the order of their keys' bytes.
  std::string dump_sorted() const;

  // Numbers by their value, objects by their members and order; places do not count.
  friend bool operator==(const Json& a, const Json& b) { return equal(a, b); }
  friend std::ostream& operator<<(std::ostream& out, const Json& value);

  JsonPlace place() const noexcept { return {line_, column_}; }
  void set_place(JsonPlace place) noexcept;

 private:
  enum Kind : std::uint8_t { kNull, kBool, kInteger, kUnsigned, kNumber, kText, kList, kObject };

  void set_bool(bool value) noexcept;
  void set_integer(std::int64_t value) noexcept;
  void set_unsigned(std::uint64_t value) noexcept;
  void set_number(double value) noexcept;
  void set_text(std::string_view text);
  void become_list();
  void become_object();
  void clear() noexcept;
  const Json& require_object() const;
  bool as_bool() const;
  double as_number() const;
  std::int64_t as_integer(std::int64_t low, std::int64_t high) const;
  std::uint64_t as_unsigned(std::uint64_t high) const;
  [[noreturn]] void refuse(const char* wanted) const;
  static bool equal(const Json& a, const Json& b);

  friend class JsonTreeBuilder;

  Kind kind_ = kNull;
  std::uint32_t column_ : 24 = 0;
  std::uint32_t line_ = 0;
  union {
    bool flag_;
    std::int64_t integer_;
    std::uint64_t unsigned_ = 0;
    double number_;
    std::string* text_;
    std::vector<Json>* list_;
    JsonMembers* members_;
  };
};

struct JsonMember {
  std::string key;
  Json value;
};

// JSON has no nan and no infinity.
Json number_or_null(double value);

// What a value is, for messages: "an object", "a list", or its text, cut.
std::string shown(const Json& value);

}  // namespace asperity
