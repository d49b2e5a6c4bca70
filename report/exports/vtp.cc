// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exports/vtp.h"

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "report/sides/polygon_sides.h"
#include "report/text/xml_text.h"

namespace gnomon::report {

namespace {

template <class Number>
void append(std::string& text, Number number) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

int class_number(LightState state) {
  switch (state) {
    case LightState::kLit:
      return 0;
    case LightState::kPenumbra:
      return 1;
    case LightState::kUmbra:
      return 2;
    default:
      return 3;
  }
}

class VtpWriter {
 public:
  VtpWriter(TextSink& sink, std::span<const ResultPiece> pieces) : sink_(sink), pieces_(pieces) {}

  /// Texts as their bytes, each with a 0 behind it, as VTK has them.
  void names(std::string_view name, const std::vector<std::string>& texts) {
    sink_.write("<Array type=\"String\" Name=\"" + xml_text(name) + "\" NumberOfTuples=\"" +
                std::to_string(texts.size()) + "\" format=\"ascii\">\n");
    for (const std::string& text : texts) {
      std::string line;
      for (const char c : text) {
        append(line, static_cast<int>(static_cast<unsigned char>(c)));
        line += ' ';
      }
      sink_.write(line + "0\n");
    }
    sink_.write("</Array>\n");
  }

  void points() {
    begin("Float64", "Points", "NumberOfComponents=\"3\" ");
    for (const ResultPiece& piece : pieces_) {
      for (const auto& point : piece.loop) {
        std::string line;
        for (const double coordinate : point) {
          append(line, coordinate);
          line += ' ';
        }
        line.back() = '\n';
        sink_.write(line);
      }
    }
    end();
  }

  /// Every piece has vertices of its own.
  void cells() {
    begin("Int64", "connectivity");
    std::int64_t point = 0;
    for (const ResultPiece& piece : pieces_) {
      std::string line;
      for (std::size_t i = 0; i < piece.loop.size(); ++i) {
        append(line, point++);
        line += ' ';
      }
      sink_.write(line + "\n");
    }
    end();
    point = 0;
    array("Int64", "offsets", [&](const ResultPiece& piece) {
      return point += static_cast<std::int64_t>(piece.loop.size());
    });
  }

  /// One number for each piece.
  template <class Value>
  void array(const char* type, std::string_view name, const Value& value) {
    begin(type, name);
    for (const ResultPiece& piece : pieces_) {
      std::string line;
      append(line, value(piece));
      sink_.write(line + "\n");
    }
    end();
  }

 private:
  void begin(const char* type, std::string_view name, const std::string& more = {}) {
    sink_.write("<DataArray type=\"" + std::string(type) + "\" Name=\"" + xml_text(name) + "\" " +
                more + "format=\"ascii\">\n");
  }
  void end() { sink_.write("</DataArray>\n"); }

  TextSink& sink_;
  std::span<const ResultPiece> pieces_;
};

}  // namespace

void write_vtp(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
               const ShadowResult& result, std::span<const ResultPiece> pieces,
               const VtpExtras& extras) {
  std::size_t points = 0;
  for (const ResultPiece& piece : pieces) points += piece.loop.size();
  std::vector<std::string> polygons, lights;
  for (const Polygon& polygon : scene.polygons) polygons.push_back(polygon.id);
  for (const LightResult& light : result.lights) {
    lights.push_back(light_name(scene, prepared, light));
  }
  VtpWriter writer(sink, pieces);
  sink.write(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<FieldData>\n");
  writer.names("polygon_ids", polygons);
  writer.names("light_ids", lights);
  for (const NamedTexts& field : extras.fields) writer.names(field.name, field.texts);
  sink.write("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(points) +
             "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
             std::to_string(pieces.size()) + "\">\n<CellData Scalars=\"class\">\n");
  writer.array("Int64", "polygon", [](const ResultPiece& piece) { return piece.polygon; });
  writer.array("Int64", "light", [](const ResultPiece& piece) { return piece.light; });
  writer.array("Int64", "caster", [](const ResultPiece& piece) {
    return piece.caster ? static_cast<std::int64_t>(*piece.caster) : -1;
  });
  writer.array("Int32", "side",
               [](const ResultPiece& piece) { return piece.side == Side::kBack ? 1 : 0; });
  writer.array("Int32", "class",
               [](const ResultPiece& piece) { return class_number(piece.state); });
  writer.array("Float64", "lit_share", [](const ResultPiece& piece) { return piece.lit.middle(); });
  writer.array("Float64", "lit_share_width",
               [](const ResultPiece& piece) { return piece.lit.upper - piece.lit.lower; });
  for (const CellArray& more : extras.cells) {
    auto value = more.values.begin();
    writer.array("Float64", more.name, [&](const ResultPiece&) { return *value++; });
  }
  sink.write("</CellData>\n<Points>\n");
  writer.points();
  sink.write("</Points>\n<Polys>\n");
  writer.cells();
  sink.write("</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n");
}

}  // namespace gnomon::report
