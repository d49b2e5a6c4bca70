// SPDX-License-Identifier: LGPL-3.0-or-later
// The syntax of Radiance's files, files within files, and the reader.
#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/files/beside.h"
#include "scene/files/readers.h"
#include "scene/files/usable_id.h"
#include "scene/radiance/rad_reader.h"

namespace gnomon {

namespace {

constexpr std::size_t kMostOpened = 100'000, kMostDepth = 32;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

}  // namespace

tl::unexpected<Error> RadReader::error(ErrorCode code, std::string what, std::string expected,
                                       std::size_t offset) {
  return fail(code, std::move(what), std::move(expected),
              place_in_text(here().file, *here().text, offset));
}

/// Words between blanks; one that begins with a quotation mark goes on to the next.
std::optional<RadReader::Word> RadReader::word() {
  Open& file = here();
  const std::string& text = *file.text;
  while (file.at < text.size() && is_blank(text[file.at])) ++file.at;
  if (file.at == text.size()) return std::nullopt;
  const std::size_t first = file.at;
  const char quote = text[first];
  if (quote == '"' || quote == '\'') {
    const std::size_t end =
        std::min(text.find_first_of(std::string{quote, '\n'}, first + 1), text.size());
    file.at = std::min(end + 1, text.size());
    return Word{text.substr(first + 1, end - first - 1), first};
  }
  while (file.at < text.size() && !is_blank(text[file.at])) ++file.at;
  return Word{text.substr(first, file.at - first), first};
}

Expected<RadReader::Word> RadReader::word(const char* wanted) {
  auto found = word();
  if (found) return *std::move(found);
  return error(ErrorCode::kSyntax, "the file ends inside a primitive", wanted, here().text->size());
}

Expected<std::size_t> RadReader::count(const char* wanted) {
  const auto found = word(wanted);
  if (!found) return tl::unexpected(found.error());
  std::uint32_t value = 0;
  const char* const end = found->text.data() + found->text.size();
  const auto parsed = std::from_chars(found->text.data(), end, value);
  if (parsed.ec != std::errc{} || parsed.ptr != end) {
    return error(ErrorCode::kSyntax, quoted_text(found->text) + " is no count", wanted,
                 found->offset);
  }
  return value;
}

/// modifier type name, and then three lists: each its length and its words.
Expected<RadReader::Primitive> RadReader::primitive(Word first) {
  Primitive result;
  result.offset = first.offset;
  result.modifier = std::move(first.text);
  auto type = word("a type, such as polygon");
  if (!type) return tl::unexpected(std::move(type.error()));
  result.type = std::move(type->text);
  auto name = word("a name");
  if (!name) return tl::unexpected(std::move(name.error()));
  result.name = std::move(name->text);
  if (result.type == "alias") {
    auto target = word("the name that the alias stands for");
    if (!target) return tl::unexpected(std::move(target.error()));
    result.reals.push_back(*std::move(target));
    return result;
  }
  constexpr const char* kLists[] = {"the number of words", "the number of integers",
                                    "the number of reals"};
  for (int list = 0; list < 3; ++list) {
    const auto length = count(kLists[list]);
    if (!length) return tl::unexpected(length.error());
    for (std::size_t i = 0; i < *length; ++i) {
      auto argument = word("an argument");
      if (!argument) return tl::unexpected(std::move(argument.error()));
      if (list == 2) result.reals.push_back(*std::move(argument));
    }
  }
  return result;
}

/// From '!' to the end of the line, which a backslash carries on.
Expected<void> RadReader::command() {
  const std::size_t offset = here().at;
  std::string line;
  {
    Open& file = here();
    const std::string& text = *file.text;
    for (++file.at; file.at < text.size() && text[file.at] != '\n'; ++file.at) {
      if (text[file.at] == '\\' && text.compare(file.at + 1, 1, "\n") == 0) {
        ++file.at;
        line += ' ';
      } else {
        line += text[file.at];
      }
    }
  }
  std::vector<std::string> words;
  for (std::size_t at = 0; at < line.size();) {
    while (at < line.size() && is_blank(line[at])) ++at;
    const std::size_t first = at;
    while (at < line.size() && !is_blank(line[at])) ++at;
    if (at > first) words.push_back(line.substr(first, at - first));
  }
  if (!is_xform(words)) {
    ++commands_[words.empty() ? "" : usable_id(words[0])];
    return {};
  }
  const auto xform = parse_xform(words);
  if (!xform) return error(xform.error().code, xform.error().what, xform.error().expected, offset);
  return open_files(*xform, offset);
}

Expected<void> RadReader::open_files(const XformCommand& xform, std::size_t offset) {
  const Open outer = here();
  if (outer.depth >= kMostDepth) {
    return error(ErrorCode::kLimit, "files within files, too deep", "at most 32 levels", offset);
  }
  // The last on the stack is the next to be read.
  for (std::size_t i = xform.files.size() * xform.placements.size(); i-- > 0;) {
    const std::string& name = xform.files[i % xform.files.size()];
    const RadTransform& placement = xform.placements[i / xform.files.size()];
    if (++opened_ > kMostOpened) {
      return error(ErrorCode::kLimit, "too many files within files", "at most 100000", offset);
    }
    // By the folder of the main file, in which Radiance is run.
    auto path = path_beside(open_.front().file, name);
    if (!path) return error(ErrorCode::kFile, path.error().what, path.error().expected, offset);
    auto& text = texts_[*path];
    if (!text) {
      auto read = read_file(*path);
      if (!read) return tl::unexpected(std::move(read.error()));
      if (auto readable = check_is_text(*read, *path); !readable) {
        return tl::unexpected(std::move(readable.error()));
      }
      text = std::make_shared<const std::string>(*std::move(read));
    }
    if (placement.error() > 0) ++turned_;
    error_ = std::max(error_, placement.error());
    stretch_ = std::max(stretch_, placement.stretch());
    open_.push_back({text, *path, byte_order_mark(*text), placement.then(outer.transform),
                     outer.prefix + usable_id(xform.prefix),
                     outer.modifier.empty() ? xform.modifier : outer.modifier,
                     outer.depth == 0 ? offset : outer.main_offset, outer.depth + 1});
  }
  return {};
}

Expected<ReadResult> RadReader::read() {
  if (auto readable = check_is_text(*here().text, here().file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  while (!open_.empty()) {
    Open& file = here();
    const std::string& text = *file.text;
    while (file.at < text.size() && is_blank(text[file.at])) ++file.at;
    Expected<void> done;
    if (file.at == text.size()) {
      open_.pop_back();
    } else if (text[file.at] == '#') {
      file.at = std::min(text.find('\n', file.at), text.size());
    } else if (text[file.at] == '!') {
      done = command();
    } else {
      const auto next = primitive(*word());
      done = next ? define(*next) : tl::unexpected(next.error());
    }
    if (!done) return tl::unexpected(std::move(done.error()));
  }
  warn();
  builder_.scene().two_sided = true;
  builder_.write_extra("radiance", {});
  return builder_.finish();
}

/// Does a line of the first ones begin with a modifier and a type that no other format has, or with
/// a command?
Likeness looks_like_radiance(std::string_view text) {
  constexpr std::size_t kFarEnough = std::size_t{1} << 16;
  constexpr std::string_view kTypes[] = {"polygon", "plastic", "metal",  "light", "glow",
                                         "source",  "glass",   "sphere", "trans", "cylinder",
                                         "ring",    "mirror",  "illum"};
  text = first_word_on(text).substr(0, kFarEnough);
  if (text.starts_with("{") || text.starts_with("<")) return Likeness::kNone;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    std::string_view words[2];
    std::size_t at = 0;
    for (std::string_view& word : words) {
      while (at < line.size() && is_blank(line[at])) ++at;
      const std::size_t first = at;
      while (at < line.size() && !is_blank(line[at])) ++at;
      word = line.substr(first, at - first);
    }
    if (words[0] == "!xform" || words[0] == "!genbox" || words[0] == "!gensky") {
      return Likeness::kPossible;
    }
    if (!words[0].starts_with("#") &&
        std::find(std::begin(kTypes), std::end(kTypes), words[1]) != std::end(kTypes))
      return Likeness::kPossible;
  }
  return Likeness::kNone;
}

Expected<ReadResult> read_radiance(const std::string& text, const std::string& file,
                                   const ReadOptions& options) {
  return RadReader(text, file, options).read();
}

}  // namespace gnomon
