// The one-sided Hausdorff distance of two triangle meshes by CGAL.
//
// hausdorff A.bin B.bin ERROR_BOUND: prints the distance and the seconds that
// it took, without reading. A file is two int64 counts, then the vertices as
// 3 float64 each, then the triangles as 3 int64 each.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

static Mesh read(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::int64_t counts[2];
  file.read(reinterpret_cast<char*>(counts), sizeof counts);
  std::vector<double> points(3 * counts[0]);
  std::vector<std::int64_t> corners(3 * counts[1]);
  file.read(reinterpret_cast<char*>(points.data()), points.size() * sizeof(double));
  file.read(reinterpret_cast<char*>(corners.data()), corners.size() * sizeof(std::int64_t));
  if (!file) throw std::runtime_error("cannot read a mesh");
  Mesh mesh;
  const auto vertex = [&](std::int64_t i) {
    return mesh.add_vertex({points[3 * i], points[3 * i + 1], points[3 * i + 2]});
  };
  std::vector<Mesh::Vertex_index> vertices(counts[0]);
  for (std::int64_t i = 0; i < counts[0]; ++i) vertices[i] = vertex(i);
  for (std::int64_t i = 0; i < counts[1]; ++i) {
    const std::int64_t* corner = &corners[3 * i];
    if (mesh.add_face(vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]) == Mesh::null_face())
      // Where the surface's mesh is not a manifold, the triangle gets vertices of its own.
      mesh.add_face(vertex(corner[0]), vertex(corner[1]), vertex(corner[2]));
  }
  return mesh;
}

int main(int count, char** arguments) {
  if (count != 4) return 2;
  const Mesh a = read(arguments[1]), b = read(arguments[2]);
  const double bound = std::atof(arguments[3]);
  const auto start = std::chrono::steady_clock::now();
  const double distance =
      CGAL::Polygon_mesh_processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(a, b, bound);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::printf("{\"value\":%.17g,\"seconds\":%.9g}\n", distance, seconds.count());
}
