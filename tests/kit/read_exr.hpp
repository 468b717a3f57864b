// Reads back what write_exr wrote. For tests: it trusts the file, and throws if that is wrong. Any
// thread.
#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "scenes/formats/images/write_image.hpp"

namespace luxodus::test {

/// `text` gets the attributes of type string, `numbers` those of type double.
inline void read_exr_attributes(const Imf::Header& header, ExrImage& image) {
  image.unit.clear();
  for (auto it = header.begin(); it != header.end(); ++it) {
    const std::string name = it.name();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute())) {
      if (name == "unit")
        image.unit = text->value();
      else if (name != "type" && name != "name" && name != "view")  // the library's own
        image.text.emplace_back(name, text->value());
    } else if (const auto* number = dynamic_cast<const Imf::DoubleAttribute*>(&it.attribute())) {
      image.numbers.emplace_back(name, number->value());
    }
  }
  if (Imf::hasChromaticities(header)) {
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    const auto a = [](const Imath::V2f& v) { return std::array<float, 2>{v.x, v.y}; };
    image.chromaticities = {a(c.red), a(c.green), a(c.blue), a(c.white)};
  }
  if (Imf::hasWhiteLuminance(header)) image.white_luminance_cd_m2 = Imf::whiteLuminance(header);
}

inline ExrImage read_exr(const std::filesystem::path& path) {
  Imf::InputFile file(path.c_str(), 0);
  const Imath::Box2i window = file.header().dataWindow();
  ExrImage image;
  image.width = window.max.x - window.min.x + 1;
  image.height = window.max.y - window.min.y + 1;
  const auto width = static_cast<size_t>(image.width);
  const size_t pixels = width * static_cast<size_t>(image.height);
  read_exr_attributes(file.header(), image);
  Imf::FrameBuffer frame;
  const Imf::ChannelList& list = file.header().channels();
  image.half = true;
  for (auto it = list.begin(); it != list.end(); ++it) {
    image.half = image.half && it.channel().type == Imf::HALF;
    ExrChannel& channel = image.channels.emplace_back();
    channel.name = it.name();
    channel.values.resize(pixels);
    frame.insert(channel.name,
                 Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(channel.values.data()),
                            sizeof(float), sizeof(float) * width));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace luxodus::test
