// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/foreign_formats.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "scene/files/readers.h"

namespace gnomon {

namespace {

struct Beginning {
  std::string_view bytes, name;
};

/// What such files begin with, in the very bytes.
constexpr Beginning kBeginnings[] = {
    {"ISO-10303-21", "STEP (such as IFC)"},
    {"HEADER;FILE_DESCRIPTION", "STEP (such as IFC)"},
    {"Kaydara FBX Binary", "FBX"},
    {"; FBX", "FBX"},
    {"PK\x03\x04", "a ZIP archive (such as 3MF, KMZ or USDZ)"},
    {"\x1F\x8B", "a gzip archive"},
    {"BLENDER", "Blender's own format"},
    {"\xFF\xFE\xFF\x0E", "SketchUp's own format"},
    {"3D Geometry File Format", "Rhino's own format"},
    {"#VRML", "VRML"},
    {"#usda", "USD"},
    {"PXR-USDC", "USD"},
    {"# vtk DataFile", "VTK"},
    {"$MeshFormat", "Gmsh"},
    {"MeshVersionFormatted", "Medit"},
    {"LASF", "LAS (points)"},
    {"%PDF", "PDF"},
    {"\x89PNG", "a picture"},
    {"\xFF\xD8\xFF", "a picture"},
    {"\x89HDF", "HDF5"},
    {"SQLite format 3", "SQLite"},
    {"ply\xE2", "PLY with a broken first line"},
    {"AC10", "DWG"},
    {"LOCATION,", "weather data (EPW)"},
};

struct Mark {
  std::string_view mark, name;
};

/// Root elements, with or without a prefix.
constexpr Mark kXmlMarks[] = {
    {"CityModel", "CityGML"}, {"COLLADA", "COLLADA"},
    {"X3D", "X3D"},           {"ifcXML", "ifcXML"},
    {"kml", "KML"},           {"svg", "SVG"},
    {"html", "HTML"},         {"HTML", "HTML"},
    {"amf", "AMF"},           {"FeatureCollection", "GML"},
    {"Indoor", "IndoorGML"},  {"VTKFile", "VTK"},
    {"model", "3MF's model"},
};

/// Pairs of key and value, or keys alone, written without blanks. The first that is there counts.
constexpr Mark kJsonMarks[] = {
    {R"("type":"CityJSONFeature")", "CityJSON (a feature without the file that it is of)"},
    {R"("type":"FeatureCollection")", "GeoJSON"},
    {R"("type":"Topology")", "TopoJSON"},
};

/// Words of texts that are neither XML nor JSON, where a line begins.
constexpr Mark kLineMarks[] = {
    {"SimulationControl,", "an IDF without surfaces"},
    {"OS:Version", "OpenStudio (OSM)"},
    {"SECTION", "DXF"},
    {"#include", "POV-Ray, or a program"},
    {"newmtl", "materials of OBJ (MTL)"},
};

constexpr std::size_t kFarEnough = std::size_t{1} << 16;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string without_blanks(std::string_view text) {
  std::string result;
  std::ranges::copy_if(text, std::back_inserter(result), [](char c) { return !is_blank(c); });
  return result;
}

/// Is there an element of that name, with or without a prefix?
bool has_element(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != std::string_view::npos;
       at = text.find(name, at + 1)) {
    if (at == 0 || at + name.size() >= text.size()) continue;
    const char after = text[at + name.size()];
    if (!is_blank(after) && after != '>' && after != '/') continue;
    const std::size_t open = text.find_last_of("<>&\" ", at - 1);
    if (open != std::string_view::npos && text[open] == '<') return true;
  }
  return false;
}

std::string_view xml_format(std::string_view text) {
  for (const Mark& known : kXmlMarks) {
    if (has_element(text, known.mark)) return known.name;
  }
  return "XML";
}

std::optional<std::string_view> json_format(std::string_view text) {
  const std::string dense = without_blanks(text);
  if (dense.find(R"("format":"gnomon-)") != std::string::npos) return std::nullopt;
  for (const Mark& known : kJsonMarks) {
    if (dense.find(known.mark) != std::string::npos) return known.name;
  }
  return std::nullopt;
}

std::optional<std::string_view> format_by_lines(std::string_view text) {
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    for (const Mark& known : kLineMarks) {
      if (line.starts_with(known.mark)) return known.name;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string_view> foreign_format(std::string_view text) {
  text = first_word_on(text.substr(0, kFarEnough));
  for (const Beginning& known : kBeginnings) {
    if (text.starts_with(known.bytes)) return known.name;
  }
  if (text.starts_with("<")) return xml_format(text);
  if (text.starts_with("{") || text.starts_with("[")) return json_format(text);
  return format_by_lines(text);
}

}  // namespace gnomon
