// A small model of a luminaire (L3D), which tests of its reading and import vary. One thread per
// object.
#pragma once

#include <string>

#include "tests/kit/zip_kit.hpp"

namespace luxodus::test {

/// A box in millimetres, 200 along x, 100 along y, 40 along z, from its lower corner.
inline const std::string box_obj =
    "# a box\nmtllib absent.mtl\no Body\n"
    "v 0 0 0\nv 200 0 0\nv 200 100 0\nv 0 100 0\nv 0 0 40\nv 200 0 40\nv 200 100 40\nv 0 100 40\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// The box with three sides of the material "white", and three of "red".
inline std::string coloured_box_obj(const std::string& library) {
  std::string out = box_obj;
  out.replace(out.find("absent.mtl"), 10, library);
  out.insert(out.find("f 2 3 7 6"), "usemtl red\n");
  return out.insert(out.find("f 1 4 3 2"), "usemtl white\n");
}

struct SmallL3d {
  std::string units = "mm";
  std::string position = R"(<Position x="-0.1" y="-0.05" z="0.5"/>)";
  std::string rotation = R"(<Rotation x="0" y="0" z="0"/>)";
  std::string reference = "box";
  std::string joints;    // below the part
  std::string measured;  // its includedInMeasurement; "" for none
  std::string obj = box_obj;
  std::string library;  // material library, as paint box.mtl; "": none
  std::string before = R"(<?xml version="1.0" encoding="utf-8"?>)";

  std::string xml() const {
    return before + R"(<Luminaire><GeometryDefinitions><GeometryFileDefinition id="box" )" +
           R"(filename="box.obj" units=")" + units +
           R"("/></GeometryDefinitions><Structure><Geometry partName="housing")" +
           (measured.empty() ? "" : " includedInMeasurement=\"" + measured + "\"") + ">" +
           position + rotation + R"(<GeometryReference geometryId=")" + reference + R"("/>)" +
           joints +
           R"(<LightEmittingObjects><LightEmittingObject partName="leo">)"
           R"(<Position x="0.1" y="0.05" z="0"/><Rotation x="0" y="0" z="0"/>)"
           R"(<Rectangle sizeX="0.2" sizeY="0.1"/></LightEmittingObject></LightEmittingObjects>)"
           "</Geometry></Structure></Luminaire>";
  }
  std::string bytes() const {
    if (library.empty()) return zip_of({{"structure.xml", xml()}, {"box/box.obj", obj}});
    return zip_of({{"structure.xml", xml()}, {"box/box.obj", obj}, {"box/paint box.mtl", library}});
  }
};

/// A joint at (0, 0, 0.1), rotated about z by 90 degrees by default, with a part of the same box.
inline std::string joint_with(const std::string& inner) {
  return R"(<Joints><Joint partName="arm"><Position x="0" y="0" z="0.1"/>)"
         R"(<Rotation x="0" y="0" z="0"/><DefaultRotation x="0" y="0" z="90"/><Geometries>)"
         R"(<Geometry partName="head"><Position x="1" y="0" z="0"/><Rotation x="0" y="0" z="0"/>)"
         R"(<GeometryReference geometryId="box"/>)" +
         inner + "</Geometry></Geometries></Joint></Joints>";
}

}  // namespace luxodus::test
