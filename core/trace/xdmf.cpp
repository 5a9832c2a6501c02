#include "core/trace/xdmf.hpp"

#include <cstdio>

namespace broadside::core {
namespace {

std::string text_of(std::uint64_t n) {
  return std::to_string(n);
}

// Escapes characters of file names that are reserved in XML.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

class Text {
 public:
  Text(const std::string& file, std::uint64_t frames) : file_(escaped(file)), frames_(frames) {}

  // A whole dataset, or part of it when rows = "|start:stride:count:size". For points, the reader of ParaView 5.11
  // accepts this form, but not an item of type HyperSlab.
  [[nodiscard]] std::string dataset(const std::string& path, const std::string& dimensions, const char* type, int bytes,
                                    const std::string& rows = "") const {
    return "<DataItem Format=\"HDF\" Dimensions=\"" + dimensions + "\" NumberType=\"" + type + "\" Precision=\"" +
           std::to_string(bytes) + "\">" + file_ + ":" + path + rows + "</DataItem>";
  }
  // Frame k of a dataset that has `rows` rows of three floats per frame.
  [[nodiscard]] std::string slab(const std::string& path, std::uint64_t k, std::uint64_t rows) const {
    const std::string count = text_of(rows) + " 3";
    return dataset(path, count, "Float", 4,
                   "|" + text_of(k * rows) + " 0:1 1:" + count + ":" + text_of(frames_ * rows) + " 3");
  }

 private:
  std::string file_;
  std::uint64_t frames_;
};

}  // namespace

std::string xdmf_text(const std::string& file, const VtkTopology& topology, const std::vector<XdmfFrame>& frames,
                      bool has_velocity) {
  const Text text(file, frames.size());
  const std::string cells = text_of(topology.cells());
  const std::string kind = topology.cell == VtkCell::kTriangle ? "Triangle" : "Hexahedron";
  const std::string cell_data =
      "<Topology TopologyType=\"" + kind + "\" NumberOfElements=\"" + cells + "\">" +
      text.dataset("/VTKHDF/Connectivity", cells + " " + text_of(points_per_cell(topology.cell)), "Int", 8) +
      "</Topology>\n<Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Cell\">" +
      text.dataset("/VTKHDF/CellData/body", cells, "UInt", 4) + "</Attribute>\n";
  std::string xml =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\"><Domain>\n"
      "<Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::uint64_t k = 0; k < frames.size(); ++k) {
    char time[32];
    std::snprintf(time, sizeof time, "%.17g", frames[k].time_s);
    xml += "<Grid Name=\"step " + text_of(frames[k].step) + "\" GridType=\"Uniform\"><Time Value=\"" + time + "\"/>\n" +
           cell_data + "<Geometry GeometryType=\"XYZ\">" + text.slab("/VTKHDF/Points", k, topology.points) +
           "</Geometry>\n";
    if (has_velocity)
      xml += "<Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Cell\">" +
             text.slab("/VTKHDF/CellData/velocity", k, topology.cells()) + "</Attribute>\n";
    xml += "</Grid>\n";
  }
  return xml + "</Grid>\n</Domain></Xdmf>\n";
}

}  // namespace broadside::core
