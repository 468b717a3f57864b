// Small IFC models, written instance by instance in millimetres: a project, a storey, and products
// whose shapes a test makes of points, profiles and solids. One thread per object.
#pragma once

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace luxodus::test {

class StepText {
 public:
  enum class Angles { degrees, radians, unstated };

  explicit StepText(std::string schema = "IFC4", Angles angles = Angles::degrees)
      : schema_(std::move(schema)) {
    const std::string length = add("IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)");
    const std::string angle = angle_unit(angles);
    const std::string units = add("IFCUNITASSIGNMENT((" + length + angle + "))");
    context_ =
        add("IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5," + axes({0, 0, 0}) + ",$)");
    body = view("Body", "MODEL_VIEW");
    const std::string project =
        add("IFCPROJECT(" + guid() + ",$,'P',$,$,$,$,(" + context_ + ")," + units + ")");
    site_place = local("$", {0, 0, 0});
    site_ = add("IFCSITE(" + guid() + ",$,'Site',$,$," + site_place + ",$,$,.ELEMENT.,$,$,$,$,$)");
    add("IFCRELAGGREGATES(" + guid() + ",$,$,$," + project + ",(" + site_ + "))");
    storey_place = local(site_place, {0, 0, 0});
    storey = add_storey("Level 1", storey_place);
  }

  std::string body, site_place, storey_place, storey;

  std::string add(const std::string& what) {
    const std::string id = fmt::format("#{}", next_++);
    data_ += id + "=" + what + ";\n";
    return id;
  }
  std::string guid() { return "'" + guid_text(next_) + "'"; }
  static std::string guid_text(int number) { return fmt::format("{:022d}", number); }
  /// The GlobalId of a product that was added.
  static std::string guid_of(const std::string& id) { return guid_text(std::stoi(id.substr(1))); }

  std::string view(const std::string& name, const std::string& target) {
    return add("IFCGEOMETRICREPRESENTATIONSUBCONTEXT('" + name + "','Model',*,*,*,*," + context_ +
               ",$,." + target + ".,$)");
  }
  std::string add_storey(const std::string& name, const std::string& place) {
    const std::string id = add("IFCBUILDINGSTOREY(" + guid() + ",$,'" + name + "',$,$," + place +
                               ",$,$,.ELEMENT.,0.)");
    add("IFCRELAGGREGATES(" + guid() + ",$,$,$," + site_ + ",(" + id + "))");
    return id;
  }

  static std::string numbers(const glm::dvec3& p) {
    return fmt::format("({:.9f},{:.9f},{:.9f})", p.x, p.y, p.z);
  }
  std::string point(const glm::dvec3& p) { return add("IFCCARTESIANPOINT(" + numbers(p) + ")"); }
  std::string point(const glm::dvec2& p) {
    return add(fmt::format("IFCCARTESIANPOINT(({:.9f},{:.9f}))", p.x, p.y));
  }
  std::string direction(const glm::dvec3& d) { return add("IFCDIRECTION(" + numbers(d) + ")"); }
  std::string axes(const glm::dvec3& at) {
    return add("IFCAXIS2PLACEMENT3D(" + point(at) + ",$,$)");
  }
  std::string axes(const glm::dvec3& at, const glm::dvec3& z) {
    const std::string origin = point(at), axis = direction(z);
    return add("IFCAXIS2PLACEMENT3D(" + origin + "," + axis + ",$)");
  }
  std::string local(const std::string& above, const glm::dvec3& at) {
    return add("IFCLOCALPLACEMENT(" + above + "," + axes(at) + ")");
  }

  std::string polyline(const std::vector<glm::dvec2>& points) {
    std::string all;
    for (const glm::dvec2& p : points) all += point(p) + ",";
    all += "#" + std::to_string(next_ - static_cast<int>(points.size()));
    return add("IFCPOLYLINE((" + all + "))");
  }
  std::string rectangle(const glm::dvec2& low, const glm::dvec2& size) {
    const std::string at = add("IFCAXIS2PLACEMENT2D(" + point(low + size / 2.0) + ",$)");
    return add(
        fmt::format("IFCRECTANGLEPROFILEDEF(.AREA.,$,{},{:.9f},{:.9f})", at, size.x, size.y));
  }
  std::string extruded(const std::string& profile, double height,
                       const glm::dvec3& at = {0, 0, 0}) {
    const std::string place = axes(at), up = direction({0, 0, 1});
    return add(fmt::format("IFCEXTRUDEDAREASOLID({},{},{},{:.9f})", profile, place, up, height));
  }
  std::string box(const glm::dvec3& low, const glm::dvec3& size) {
    return extruded(rectangle({low.x, low.y}, {size.x, size.y}), size.z, {0, 0, low.z});
  }
  /// What is above a plane, to be cut off.
  std::string above(const glm::dvec3& at, const glm::dvec3& normal) {
    return add("IFCHALFSPACESOLID(" + add("IFCPLANE(" + axes(at, normal) + ")") + ",.F.)");
  }
  std::string without(const std::string& first, const std::string& second) {
    return add("IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.," + first + "," + second + ")");
  }

  std::string representation(const std::string& context, const std::string& name,
                             const std::string& items) {
    return add("IFCSHAPEREPRESENTATION(" + context + ",'" + name + "','',(" + items + "))");
  }
  std::string shape(const std::string& representations) {
    return add("IFCPRODUCTDEFINITIONSHAPE($,$,(" + representations + "))");
  }
  /// A product on the storey; `shape` may be "$".
  std::string product(const std::string& type, const std::string& name, const std::string& place,
                      const std::string& shape, const std::string& rest = ",$") {
    const std::string id = add(type + "(" + guid() + ",$,'" + name + "',$,$," + place + "," +
                               shape + ",$" + rest + ")");
    contained_ += (contained_.empty() ? "" : ",") + id;
    return id;
  }
  std::string wall(const std::string& item, const glm::dvec3& at = {0, 0, 0}) {
    const std::string place = local(storey_place, at);
    return product("IFCWALL", "W", place, shape(representation(body, "Body", item)));
  }

  /// The whole file. Nothing may be added after it.
  std::string text() {
    if (!contained_.empty())
      add("IFCRELCONTAINEDINSPATIALSTRUCTURE(" + guid() + ",$,$,$,(" + contained_ + ")," + storey +
          ")");
    contained_.clear();
    return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
           "FILE_NAME('t.ifc','',(''),(''),'','','');\nFILE_SCHEMA(('" +
           schema_ + "'));\nENDSEC;\nDATA;\n" + data_ + "ENDSEC;\nEND-ISO-10303-21;\n";
  }

 private:
  /// ",#NUMBER" of the unit of plane angles.
  std::string angle_unit(Angles angles) {
    if (angles == Angles::unstated) return "";
    const std::string radian = add("IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.)");
    if (angles == Angles::radians) return "," + radian;
    const std::string size =
        add("IFCMEASUREWITHUNIT(IFCPLANEANGLEMEASURE(0.0174532925)," + radian + ")");
    const std::string none = add("IFCDIMENSIONALEXPONENTS(0,0,0,0,0,0,0)");
    return "," + add("IFCCONVERSIONBASEDUNIT(" + none + ",.PLANEANGLEUNIT.,'DEGREE'," + size + ")");
  }

  std::string schema_, data_, context_, site_, contained_;
  int next_ = 1;
};

}  // namespace luxodus::test
