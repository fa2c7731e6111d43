// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <pcl_als/tin/tin.h>

namespace pcl_als::tin {

using Vertex = std::int32_t;
using Edge = std::int32_t;  ///< a directed edge; the two directions are 2k and 2k + 1
inline constexpr Edge kNoEdge = -1;

inline Edge twin(Edge e) {
  return e ^ 1;
}

/** \brief Directed edges of a planar graph, each in a ring of those that leave the same vertex.
 *
 * 24 bytes per edge; a planar graph of n vertices never has more than 3n edges, so the storage is
 * reserved once.
 */
class EdgeMesh {
 public:
  explicit EdgeMesh(std::size_t vertices) : edges_(new Record[6 * vertices]) {}

  Vertex destination(Edge e) const { return edges_[e].destination; }
  Edge next(Edge e) const { return edges_[e].next; }          ///< counter-clockwise in the ring
  Edge previous(Edge e) const { return edges_[e].previous; }  ///< clockwise in the ring
  /// The next edge around the face to the left of e.
  Edge aroundFace(Edge e) const { return edges_[twin(e)].previous; }

  /// A new edge from a to b, in no ring yet.
  Edge add(Vertex a, Vertex b) {
    Edge e = free_;
    if (e != kNoEdge) {
      free_ = edges_[e].next;
    } else {
      e = used_;
      used_ += 2;
    }
    edges_[e].destination = b;
    edges_[twin(e)].destination = a;
    return e;
  }
  void startRing(Edge e) { edges_[e].next = edges_[e].previous = e; }
  void insertBefore(Edge e, Edge at) { link(edges_[at].previous, e, at); }
  void insertAfter(Edge e, Edge at) { link(at, e, edges_[at].next); }

  /// Takes an edge out of both rings.
  void remove(Edge e) {
    unlink(e);
    unlink(twin(e));
    e &= ~1;
    edges_[e].destination = kRemoved;
    edges_[e].next = free_;
    free_ = e;
  }
  bool isRemoved(Edge e) const { return edges_[e & ~1].destination == kRemoved; }
  Edge end() const { return used_; }

  /// When faces are collected aroundFace(e) is asked once for each edge; its place then holds the
  /// number of the face to the left of e.
  void setFace(Edge e, std::int32_t face) { edges_[twin(e)].previous = kFaceBase - face; }
  bool hasFace(Edge e) const { return edges_[twin(e)].previous < 0; }
  std::int32_t face(Edge e) const { return kFaceBase - edges_[twin(e)].previous; }

 private:
  static constexpr Vertex kRemoved = -1;
  static constexpr std::int32_t kFaceBase = -2;  ///< negative also for a face of Tin::kNone
  struct Record {
    Vertex destination;
    Edge next, previous;
  };

  void link(Edge before, Edge e, Edge after) {
    edges_[e].previous = before, edges_[e].next = after;
    edges_[before].next = edges_[after].previous = e;
  }
  void unlink(Edge e) {
    const Record& r = edges_[e];
    edges_[r.previous].next = r.next;
    edges_[r.next].previous = r.previous;
  }

  std::unique_ptr<Record[]> edges_;  ///< not initialised: pages are touched when they are needed
  Edge used_ = 0, free_ = kNoEdge;
};

/// The faces of a triangulation except the one to the left of \a outer, in the order of their first
/// vertex; vertices are numbered as in the mesh. Uses the mesh up.
std::vector<Tin::Triangle> trianglesOf(EdgeMesh& mesh, Edge outer, std::size_t vertices);

}  // namespace pcl_als::tin
