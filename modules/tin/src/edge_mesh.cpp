// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "edge_mesh.h"

namespace pcl_als::tin {
namespace {

/// One edge that leaves each vertex.
std::vector<Edge> firstEdges(const EdgeMesh& mesh, std::size_t vertices) {
  std::vector<Edge> first(vertices, kNoEdge);
  for (Edge e = 0; e < mesh.end(); ++e)
    if (!mesh.isRemoved(e)) first[mesh.destination(twin(e))] = e;
  return first;
}

}  // namespace

std::vector<Tin::Triangle> trianglesOf(EdgeMesh& mesh, Edge outer, std::size_t vertices) {
  for (Edge e = outer; !mesh.hasFace(e);) {
    const Edge after = mesh.aroundFace(e);
    mesh.setFace(e, Tin::kNone);
    e = after;
  }
  std::vector<Tin::Triangle> triangles;
  triangles.reserve(2 * vertices);
  for (const Edge first : firstEdges(mesh, vertices)) {
    Edge a = first;
    do {
      if (!mesh.hasFace(a)) {
        const Edge b = mesh.aroundFace(a), c = mesh.aroundFace(b);
        for (const Edge e : {a, b, c}) mesh.setFace(e, static_cast<std::int32_t>(triangles.size()));
        // Neighbours hold the edge seen from across until all faces have a number.
        triangles.push_back({{mesh.destination(c), mesh.destination(a), mesh.destination(b)},
                             {twin(b), twin(c), twin(a)}});
      }
      a = mesh.next(a);
    } while (a != first);
  }
  for (Tin::Triangle& t : triangles)
    for (std::int32_t& n : t.neighbour) n = mesh.face(n);
  return triangles;
}

}  // namespace pcl_als::tin
