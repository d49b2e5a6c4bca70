// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/page/page_writer.h"

#include "report/json/json_writer.h"
#include "report/page/page_text.h"

namespace gnomon::report {

namespace {

/// Hands JSON on so that no browser sees the end of its element, or a comment, in it.
class ElementSink final : public TextSink {
 public:
  explicit ElementSink(TextSink& sink) : sink_(sink) {}
  void write(std::string_view text) override {
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<')) {
      sink_.write(text.substr(0, at));
      sink_.write("\\u003c");
      text.remove_prefix(at + 1);
    }
    sink_.write(text);
  }

 private:
  TextSink& sink_;
};

void write_texts(JsonWriter& json, std::string_view name, const std::vector<std::string>& texts) {
  json.key(name);
  json.begin_array();
  for (const std::string& text : texts) json.value(text);
  json.end_array();
}

void write_document(TextSink& sink, const PageDocument& document) {
  sink.write("<script type=\"application/json\" id=\"gnomon-data-" + document.name + "\">\n");
  ElementSink element(sink);
  document.write(element);
  sink.write("</script>\n");
}

}  // namespace

void write_page_head(TextSink& sink, const PageHead& head) {
  JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-page");
  json.member("version", 1);
  json.member("command", head.command);
  json.member("command_line", head.command_line);
  json.member("program", head.program);
  json.member("scene", head.scene);
  write_texts(json, "files", head.files);
  write_texts(json, "notes", head.notes);
  json.end_object();
  json.finish();
}

void write_page(TextSink& sink, const PageHead& head, std::span<const PageDocument> documents) {
  const PageText page = page_text();
  for (const std::string_view text : page.before) sink.write(text);
  write_document(sink, {"page", [&](TextSink& to) { write_page_head(to, head); }});
  for (const PageDocument& document : documents) write_document(sink, document);
  for (const std::string_view text : page.after) sink.write(text);
}

}  // namespace gnomon::report
