// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/visualization/image.h>

namespace pcl_als {

std::vector<std::uint8_t> encodePng(const Image& image) {
  if (image.width < 1 || image.height < 1) throw UsageError("an image without pixels");
  const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(),
                                  [](const Color& color) { return color.a == 255; });
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, opaque ? 3 : 4);
  auto* out = static_cast<std::uint8_t*>(data->GetScalarPointer());
  for (int y = image.height - 1; y >= 0; --y) {  // VTK's rows run up
    for (int x = 0; x < image.width; ++x) {
      const Color& color = image.at(x, y);
      *out++ = color.r;
      *out++ = color.g;
      *out++ = color.b;
      if (!opaque) *out++ = color.a;
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->WriteToMemoryOn();
  writer->SetCompressionLevel(6);
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  const std::uint8_t* first = bytes->GetPointer(0);
  return {first, first + bytes->GetNumberOfValues()};
}

void writePng(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::uint8_t> bytes = encodePng(image);
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

Image readPng(const std::filesystem::path& path) {
  vtkNew<vtkPNGReader> reader;
  if (!std::filesystem::is_regular_file(path) || reader->CanReadFile(path.c_str()) == 0) {
    throw InputError(path.string() + ": is no PNG file that can be read");
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  const int* size = data->GetDimensions();
  const int channels = data->GetNumberOfScalarComponents();
  if (data->GetScalarType() != VTK_UNSIGNED_CHAR || channels < 1 || size[0] < 1) {
    throw InputError(path.string() + ": is no PNG of 8 bit per channel");
  }
  Image image(size[0], size[1]);
  const auto* in = static_cast<const std::uint8_t*>(data->GetScalarPointer());
  for (int y = size[1] - 1; y >= 0; --y) {
    for (int x = 0; x < size[0]; ++x, in += channels) {
      Color& color = image.at(x, y);
      const bool gray = channels < 3;
      color = {in[0], gray ? in[0] : in[1], gray ? in[0] : in[2], 255};
      if (channels == 2 || channels == 4) color.a = in[channels - 1];
    }
  }
  return image;
}

}  // namespace pcl_als
