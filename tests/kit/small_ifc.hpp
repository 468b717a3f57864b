// A small IFC4 model, written instance by instance: a room of 5 m x 4 m x 3 m with a door in its
// east wall, a table, a luminaire and an exit sign, in millimetres or feet, at any position. One
// thread per object.
#pragma once

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace luxodus::test {

class SmallIfc {
 public:
  bool feet = false;
  glm::dvec3 site{0};  // position of the building [m]
  double floor_m = 1;  // height of its storey
  bool with_ceiling = true;
  std::string lamp_name = "Lamp 1";
  double wall_volume_m3 = 0;  // quantity of the north wall in the file; 0: none

  std::string text() {
    data_.clear();
    next_ = 1;
    const std::string unit = units();
    const std::string context =
        add("IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05," + place({0, 0, 0}) + ",$)");
    body_ = add("IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Body','Model',*,*,*,*," + context +
                ",$,.MODEL_VIEW.,$)");
    const std::string project =
        add("IFCPROJECT(" + guid() + ",$,'A small house',$,$,$,$,(" + context + ")," + unit + ")");
    const std::string at_site = local("$", site);
    const std::string site_id =
        add("IFCSITE(" + guid() + ",$,'Site',$,$," + at_site + ",$,$,.ELEMENT.,$,$,$,$,$)");
    storey_place_ = local(at_site, {0, 0, floor_m});
    storey_ = add("IFCBUILDINGSTOREY(" + guid() + ",$,'Ground \\X2\\00E4\\X0\\',$,$," +
                  storey_place_ + ",$,$,.ELEMENT.,0.)");
    add("IFCRELAGGREGATES(" + guid() + ",$,$,$," + project + ",(" + site_id + "))");
    add("IFCRELAGGREGATES(" + guid() + ",$,$,$," + site_id + ",(" + storey_ + "))");
    walls_and_slabs();
    door();
    furniture_and_lights();
    space();
    std::string elements;
    for (const std::string& id : contained_) elements += (elements.empty() ? "" : ",") + id;
    add("IFCRELCONTAINEDINSPATIALSTRUCTURE(" + guid() + ",$,$,$,(" + elements + ")," + storey_ +
        ")");
    contained_.clear();
    return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
           "FILE_NAME('small.ifc','',(''),(''),'','','');\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;"
           "\n" +
           data_ + "ENDSEC;\nEND-ISO-10303-21;\n";
  }

  std::string door_guid, lamp_guid, sign_guid, space_guid, north_guid;

 private:
  std::string add(const std::string& what) {
    const std::string id = fmt::format("#{}", next_++);
    data_ += id + "=" + what + ";\n";
    return id;
  }
  std::string guid() { return fmt::format("'{:022d}'", next_); }
  std::string named_guid(std::string& keep) {
    keep = fmt::format("{:022d}", next_);
    return "'" + keep + "'";
  }
  /// A length [m] converted to the model's unit.
  std::string in(double m) const { return fmt::format("{:.9f}", m / (feet ? 0.3048 : 0.001)); }

  std::string units() {
    std::string length;
    if (feet) {
      const std::string metre = add("IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)");
      const std::string measure = add("IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(0.3048)," + metre + ")");
      const std::string powers = add("IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0)");
      length = add("IFCCONVERSIONBASEDUNIT(" + powers + ",.LENGTHUNIT.,'FOOT'," + measure + ")");
    } else {
      length = add("IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)");
    }
    const std::string volume = add("IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.)");
    return add("IFCUNITASSIGNMENT((" + length + "," + volume + "))");
  }

  std::string place(const glm::dvec3& p) {
    const std::string at =
        add(fmt::format("IFCCARTESIANPOINT(({},{},{}))", in(p.x), in(p.y), in(p.z)));
    return add("IFCAXIS2PLACEMENT3D(" + at + ",$,$)");
  }
  std::string local(const std::string& in_what, const glm::dvec3& p) {
    const std::string at = place(p);
    return add("IFCLOCALPLACEMENT(" + in_what + "," + at + ")");
  }
  /// A box from the origin of its product.
  std::string box(const glm::dvec3& size) {
    const std::string middle =
        add(fmt::format("IFCCARTESIANPOINT(({},{}))", in(size.x / 2), in(size.y / 2)));
    const std::string flat = add("IFCAXIS2PLACEMENT2D(" + middle + ",$)");
    const std::string profile =
        add("IFCRECTANGLEPROFILEDEF(.AREA.,$," + flat + "," + in(size.x) + "," + in(size.y) + ")");
    const std::string up = add("IFCDIRECTION((0.,0.,1.))");
    const std::string origin = place({0, 0, 0});
    const std::string solid =
        add("IFCEXTRUDEDAREASOLID(" + profile + "," + origin + "," + up + "," + in(size.z) + ")");
    return add("IFCSHAPEREPRESENTATION(" + body_ + ",'Body','SweptSolid',(" + solid + "))");
  }
  std::string shape(const std::string& representations) {
    return add("IFCPRODUCTDEFINITIONSHAPE($,$,(" + representations + "))");
  }
  /// An instance of `type` with a box; `rest` follows the tag.
  std::string product(const std::string& type, const std::string& id, const std::string& name,
                      const glm::dvec3& at, const glm::dvec3& size, const std::string& rest) {
    const std::string where = local(storey_place_, at);
    const std::string looks = shape(box(size));
    contained_.push_back(
        add(type + "(" + id + ",$,'" + name + "',$,$," + where + "," + looks + ",$" + rest + ")"));
    return contained_.back();
  }
  void properties(const std::string& of, const std::string& set, const std::string& all) {
    const std::string id = add("IFCPROPERTYSET(" + guid() + ",$,'" + set + "',$,(" + all + "))");
    add("IFCRELDEFINESBYPROPERTIES(" + guid() + ",$,$,$,(" + of + ")," + id + ")");
  }

  void walls_and_slabs() {
    product("IFCWALL", guid(), "South", {-0.2, -0.2, 0}, {5.4, 0.2, 3}, ",$");
    const std::string id = named_guid(north_guid);
    const std::string north = product("IFCWALL", id, "North", {-0.2, 4, 0}, {5.4, 0.2, 3}, ",$");
    product("IFCWALL", guid(), "West", {-0.2, 0, 0}, {0.2, 4, 3}, ",$");
    east_ = product("IFCWALL", guid(), "East", {5, 0, 0}, {0.2, 4, 3}, ",$");
    product("IFCSLAB", guid(), "Floor", {-0.2, -0.2, -0.2}, {5.4, 4.4, 0.2}, ",.FLOOR.");
    if (with_ceiling)
      product("IFCSLAB", guid(), "Ceiling", {-0.2, -0.2, 3}, {5.4, 4.4, 0.2}, ",.ROOF.");
    const std::string material = add("IFCMATERIAL('Brick',$,$)");
    add("IFCRELASSOCIATESMATERIAL(" + guid() + ",$,$,$,(" + north + ")," + material + ")");
    if (!(wall_volume_m3 > 0)) return;
    const std::string volume =
        add(fmt::format("IFCQUANTITYVOLUME('NetVolume',$,$,{:.6f},$)", wall_volume_m3));
    const std::string set =
        add("IFCELEMENTQUANTITY(" + guid() + ",$,'Qto_WallBaseQuantities',$,$,(" + volume + "))");
    add("IFCRELDEFINESBYPROPERTIES(" + guid() + ",$,$,$,(" + north + ")," + set + ")");
  }

  /// Width along local x, as the schema requires, rotated into the east wall: it opens to the west.
  void door() {
    const std::string corner = local(storey_place_, {5, 1.5, 0});
    const std::string hole = shape(box({0.2, 1, 2.1}));
    const std::string opening = add("IFCOPENINGELEMENT(" + guid() + ",$,'Hole',$,$," + corner +
                                    "," + hole + ",$,.OPENING.)");
    add("IFCRELVOIDSELEMENT(" + guid() + ",$,$,$," + east_ + "," + opening + ")");
    const std::string at =
        add(fmt::format("IFCCARTESIANPOINT(({},{},{}))", in(5.125), in(1.5), in(0)));
    const std::string z = add("IFCDIRECTION((0.,0.,1.))"), x = add("IFCDIRECTION((0.,1.,0.))");
    const std::string axes = add("IFCAXIS2PLACEMENT3D(" + at + "," + z + "," + x + ")");
    const std::string where = add("IFCLOCALPLACEMENT(" + storey_place_ + "," + axes + ")");
    const std::string leaf = shape(box({1, 0.05, 2.1}));
    const std::string id = named_guid(door_guid);
    const std::string door = add("IFCDOOR(" + id + ",$,'Exit',$,$," + where + "," + leaf + ",$," +
                                 in(2.1) + "," + in(1) + ",.DOOR.,.SINGLE_SWING_LEFT.,$)");
    contained_.push_back(door);
    add("IFCRELFILLSELEMENT(" + guid() + ",$,$,$," + opening + "," + door + ")");
    const std::string exit = add("IFCPROPERTYSINGLEVALUE('FireExit',$,IFCBOOLEAN(.T.),$)");
    properties(door, "Pset_DoorCommon", exit);
  }

  void furniture_and_lights() {
    product("IFCFURNITURE", guid(), "Table", {1, 1, 0}, {1.6, 0.8, 0.74}, ",.TABLE.");
    const std::string lamp_id = named_guid(lamp_guid);
    const std::string lamp = product("IFCLIGHTFIXTURE", lamp_id, lamp_name, {2.4, 1.9, 2.9},
                                     {0.2, 0.2, 0.1}, ",.POINTSOURCE.");
    const std::string type = add("IFCLIGHTFIXTURETYPE(" + guid() +
                                 ",$,'Lamp',$,$,$,$,$,$,"
                                 ".POINTSOURCE.)");
    add("IFCRELDEFINESBYTYPE(" + guid() + ",$,$,$,(" + lamp + ")," + type + ")");
    const std::string sign_id = named_guid(sign_guid);
    const std::string sign = product("IFCLIGHTFIXTURE", sign_id, "Exit sign", {4.95, 1.85, 2.3},
                                     {0.05, 0.3, 0.15}, ",.SECURITYLIGHTING.");
    const std::string kind = add(
        "IFCPROPERTYENUMERATEDVALUE('SecurityLightingType',$,(IFCLABEL('EMERGENCYEXITLIGHT')),$)");
    properties(sign, "Pset_LightFixtureTypeSecurityLighting", kind);
  }

  void space() {
    const std::string where = local(storey_place_, {0, 0, 0});
    const std::string looks = shape(box({5, 4, 3}));
    const std::string id = named_guid(space_guid);
    const std::string room = add("IFCSPACE(" + id + ",$,'1',$,$," + where + "," + looks +
                                 ",'Hall',.ELEMENT.,.INTERNAL.,0.)");
    add("IFCRELAGGREGATES(" + guid() + ",$,$,$," + storey_ + ",(" + room + "))");
  }

  std::string data_, body_, storey_, storey_place_, east_;
  std::vector<std::string> contained_;
  int next_ = 1;
};

}  // namespace luxodus::test
