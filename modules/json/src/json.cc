#include "asperity/json/json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "json_members.h"

namespace asperity {

static_assert(sizeof(Json) == 16, "a value's place is to cost nothing");

Json::Json(const Json& other) : kind_(other.kind_), column_(other.column_), line_(other.line_) {
  switch (kind_) {
    case kText:
      text_ = new std::string(*other.text_);
      break;
    case kList:
      list_ = new std::vector<Json>(*other.list_);
      break;
    case kObject:
      members_ = new JsonMembers(*other.members_);
      break;
    default:
      unsigned_ = other.unsigned_;
  }
}

Json::Json(Json&& other) noexcept
    : kind_(other.kind_), column_(other.column_), line_(other.line_), unsigned_(other.unsigned_) {
  // The union's members share their bytes; the pointer goes along with any of them.
  other.kind_ = kNull;
}

Json& Json::operator=(const Json& other) {
  if (this != &other) *this = Json(other);
  return *this;
}

Json& Json::operator=(Json&& other) noexcept {
  // `other` may be a part of this: it is taken out before the rest goes.
  Json taken(std::move(other));
  std::swap(kind_, taken.kind_);
  std::swap(unsigned_, taken.unsigned_);
  column_ = taken.column_;
  line_ = taken.line_;
  return *this;
}

Json::~Json() { clear(); }

Json::Json(std::string&& text) : kind_(kText), text_(new std::string(std::move(text))) {}

Json::Json(std::initializer_list<Json> values) {
  const auto is_member = [](const Json& value) {
    return value.is_array() && value.size() == 2 && value.at(0).is_string();
  };
  if (values.size() == 0 || !std::all_of(values.begin(), values.end(), is_member)) {
    *this = array(values);
    return;
  }
  become_object();
  for (const Json& value : values) (*this)[value.at(0).text()] = value.at(1);
}

Json Json::array(std::initializer_list<Json> values) {
  Json out;
  out.become_list();
  out.list_->assign(values.begin(), values.end());
  return out;
}

Json Json::object() {
  Json out;
  out.become_object();
  return out;
}

void Json::clear() noexcept {
  if (kind_ == kText) delete text_;
  if (kind_ == kList) delete list_;
  if (kind_ == kObject) delete members_;
  kind_ = kNull;
}

void Json::set_bool(bool value) noexcept { kind_ = kBool, flag_ = value; }
void Json::set_integer(std::int64_t value) noexcept { kind_ = kInteger, integer_ = value; }
void Json::set_unsigned(std::uint64_t value) noexcept { kind_ = kUnsigned, unsigned_ = value; }
void Json::set_number(double value) noexcept { kind_ = kNumber, number_ = value; }
void Json::set_text(std::string_view text) { text_ = new std::string(text), kind_ = kText; }
void Json::become_list() { list_ = new std::vector<Json>, kind_ = kList; }
void Json::become_object() { members_ = new JsonMembers, kind_ = kObject; }

void Json::set_place(JsonPlace place) noexcept {
  constexpr std::size_t kLastColumn = (1U << 24U) - 1;
  line_ = static_cast<std::uint32_t>(std::min<std::size_t>(place.line, std::numeric_limits<std::uint32_t>::max()));
  column_ = static_cast<std::uint32_t>(std::min(place.column, kLastColumn)) & kLastColumn;
}

void Json::refuse(const char* wanted) const { throw Error(std::string("JSON: not ") + wanted + ": " + shown(*this)); }

bool Json::as_bool() const {
  if (kind_ != kBool) refuse("true or false");
  return flag_;
}

double Json::as_number() const {
  if (kind_ == kNumber) return number_;
  if (kind_ == kInteger) return static_cast<double>(integer_);
  if (kind_ == kUnsigned) return static_cast<double>(unsigned_);
  refuse("a number");
}

std::int64_t Json::as_integer(std::int64_t low, std::int64_t high) const {
  constexpr double kTooLarge = 9223372036854775808.0;  // 2^63
  if (kind_ == kNumber && number_ >= -kTooLarge && number_ < kTooLarge) {
    const auto whole = static_cast<std::int64_t>(number_);
    if (whole >= low && whole <= high) return whole;
  }
  if (kind_ == kInteger && integer_ >= low && integer_ <= high) return integer_;
  if (kind_ == kUnsigned && unsigned_ <= static_cast<std::uint64_t>(high)) return static_cast<std::int64_t>(unsigned_);
  refuse("a whole number of that size");
}

std::uint64_t Json::as_unsigned(std::uint64_t high) const {
  constexpr double kTooLarge = 18446744073709551616.0;  // 2^64
  if (kind_ == kNumber && number_ > -1.0 && number_ < kTooLarge) {
    const auto whole = static_cast<std::uint64_t>(number_);
    if (whole <= high) return whole;
  }
  if (kind_ == kInteger && integer_ >= 0 && static_cast<std::uint64_t>(integer_) <= high) {
    return static_cast<std::uint64_t>(integer_);
  }
  if (kind_ == kUnsigned && unsigned_ <= high) return unsigned_;
  refuse("a whole number of that size, 0 or more");
}

const std::string& Json::text() const {
  if (kind_ != kText) refuse("a text");
  return *text_;
}

const std::vector<Json>& Json::list() const {
  if (kind_ != kList) refuse("a list");
  return *list_;
}

std::size_t Json::size() const noexcept {
  if (kind_ == kNull) return 0;
  if (kind_ == kList) return list_->size();
  if (kind_ == kObject) return members_->list.size();
  return 1;
}

void Json::push_back(Json value) {
  if (kind_ == kNull) become_list();
  if (kind_ != kList) refuse("a list");
  list_->push_back(std::move(value));
}

const Json& Json::at(std::size_t i) const {
  if (i >= list().size()) throw Error("JSON: a list has no element " + std::to_string(i));
  return (*list_)[i];
}
Json& Json::at(std::size_t i) { return const_cast<Json&>(static_cast<const Json&>(*this).at(i)); }

const Json* Json::begin() const { return kind_ == kNull ? nullptr : list().data(); }
const Json* Json::end() const { return kind_ == kNull ? nullptr : list().data() + list().size(); }
Json* Json::begin() { return const_cast<Json*>(static_cast<const Json&>(*this).begin()); }
Json* Json::end() { return const_cast<Json*>(static_cast<const Json&>(*this).end()); }

void Json::erase_at(std::size_t i) {
  static_cast<void>(at(i));
  list_->erase(list_->begin() + static_cast<std::ptrdiff_t>(i));
}

void Json::insert_at(std::size_t i, Json value) {
  if (i > list().size()) throw Error("JSON: a list has no position " + std::to_string(i));
  list_->insert(list_->begin() + static_cast<std::ptrdiff_t>(i), std::move(value));
}

const Json& Json::require_object() const {
  if (kind_ != kObject) refuse("an object");
  return *this;
}

Json& Json::operator[](std::string_view key) {
  if (kind_ == kNull) become_object();
  if (Json* found = require_object().members_->list.empty() ? nullptr : find(key)) return *found;
  return members_->append(std::string(key));
}

const Json* Json::find(std::string_view key) const {
  if (kind_ != kObject) return nullptr;
  const std::size_t place = members_->find(key);
  return place == JsonMembers::kNone ? nullptr : &members_->list[place].value;
}
Json* Json::find(std::string_view key) { return const_cast<Json*>(static_cast<const Json&>(*this).find(key)); }

const Json& Json::at(std::string_view key) const {
  const Json* found = require_object().find(key);
  if (found == nullptr) throw Error("JSON: no key '" + printable(key) + "'");
  return *found;
}
Json& Json::at(std::string_view key) { return const_cast<Json&>(static_cast<const Json&>(*this).at(key)); }

const std::vector<JsonMember>& Json::items() const {
  static const std::vector<JsonMember> nothing;
  return kind_ == kNull ? nothing : require_object().members_->list;
}

std::size_t Json::erase(std::string_view key) {
  const std::size_t place = require_object().members_->find(key);
  if (place == JsonMembers::kNone) return 0;
  members_->erase(place);
  return 1;
}

void Json::update(const Json& other) {
  for (const auto& [key, value] : other.items()) (*this)[key] = value;
}

void Json::sort_keys() {
  if (kind_ == kList) {
    for (Json& value : *list_) value.sort_keys();
  }
  if (kind_ != kObject) return;
  members_->sort();
  for (JsonMember& member : members_->list) member.value.sort_keys();
}

bool Json::equal(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number()) {
    if (a.kind_ == kNumber || b.kind_ == kNumber) return a.as_number() == b.as_number();
    // Two negative whole numbers, or two of 0 and more, have equal bits; others differ.
    const bool same_sign = (a.kind_ == kInteger && a.integer_ < 0) == (b.kind_ == kInteger && b.integer_ < 0);
    return same_sign && a.unsigned_ == b.unsigned_;
  }
  if (a.kind_ != b.kind_) return false;
  switch (a.kind_) {
    case kBool:
      return a.flag_ == b.flag_;
    case kText:
      return *a.text_ == *b.text_;
    case kList:
      return *a.list_ == *b.list_;
    case kObject:
      return std::equal(a.members_->list.begin(), a.members_->list.end(), b.members_->list.begin(),
                        b.members_->list.end(),
                        [](const JsonMember& x, const JsonMember& y) { return x.key == y.key && x.value == y.value; });
    default:
      return true;
  }
}

std::ostream& operator<<(std::ostream& out, const Json& value) { return out << value.dump_repaired(); }

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  return printable(value.dump_repaired());
}

}  // namespace asperity
