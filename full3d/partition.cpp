// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/partition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "full3d/cell_work.hpp"
#include "full3d/petsc.hpp"

namespace tunica::full3d {

namespace {

/// Cells that share a face with each cell, ascending.
std::vector<std::vector<int>> neighbours(const Mesh& mesh) {
  std::map<std::array<int, 4>, int> open;
  std::vector<std::vector<int>> neighbours(mesh.cells.size());
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (int face = 0; face < element::solid::faces(mesh.shape); ++face) {
      std::array<int, 4> key{-1, -1, -1, -1};
      int k = 0;
      for (const int corner : element::solid::face_nodes(mesh.shape, Basis::linear, face))
        key[k++] = mesh.node(cell, Basis::linear, corner);
      std::sort(key.begin(), key.end());
      const auto [other, is_new] = open.try_emplace(key, cell);
      if (is_new) continue;
      neighbours[cell].push_back(other->second);
      neighbours[other->second].push_back(cell);
      open.erase(other);
    }
  for (auto& list : neighbours) std::sort(list.begin(), list.end());
  return neighbours;
}

PetscInt* petsc_array(int size) {
  PetscInt* array = nullptr;
  check(PetscMallocA(1, PETSC_FALSE, __LINE__, __func__, __FILE__, size * sizeof(PetscInt), &array),
        "PetscMalloc");
  return array;
}

}  // namespace

std::vector<int> partition(const Problem& problem, const Ranks& ranks) {
  const int cells = static_cast<int>(problem.mesh.cells.size());
  std::vector<int> owner(cells, 0);
  if (ranks.size() == 1) return owner;
  const auto adjacent = neighbours(problem.mesh);
  const auto begin_of = [&](int rank) {
    return static_cast<int>(static_cast<long>(cells) * rank / ranks.size());
  };
  const int begin = begin_of(ranks.rank()), end = begin_of(ranks.rank() + 1);
  int count = 0;
  for (int cell = begin; cell < end; ++cell) count += static_cast<int>(adjacent[cell].size());
  // The matrix and the partitioning free these.
  PetscInt* const starts = petsc_array(end - begin + 1);
  PetscInt* const columns = petsc_array(std::max(count, 1));
  PetscInt* const weights = petsc_array(std::max(end - begin, 1));
  starts[0] = 0;
  for (int cell = begin, next = 0; cell < end; ++cell) {
    for (const int other : adjacent[cell]) columns[next++] = other;
    starts[cell - begin + 1] = next;
    weights[cell - begin] = static_cast<PetscInt>(std::lround(100 * relative_cost(problem, cell)));
  }
  OwnedMatrix graph;
  check(MatCreateMPIAdj(ranks.communicator(), end - begin, cells, starts, columns, nullptr, graph.put()),
        "MatCreateMPIAdj");
  OwnedPartitioning partitioning;
  check(MatPartitioningCreate(ranks.communicator(), partitioning.put()), "MatPartitioningCreate");
  check(MatPartitioningSetAdjacency(partitioning.get(), graph.get()), "MatPartitioningSetAdjacency");
  check(MatPartitioningSetVertexWeights(partitioning.get(), weights), "MatPartitioningSetVertexWeights");
  check(MatPartitioningSetType(partitioning.get(), MATPARTITIONINGPTSCOTCH), "MatPartitioningSetType");
  check(MatPartitioningSetNParts(partitioning.get(), ranks.size()), "MatPartitioningSetNParts");
  OwnedIndices parts, all;
  check(MatPartitioningApply(partitioning.get(), parts.put()), "MatPartitioningApply");
  check(ISAllGather(parts.get(), all.put()), "ISAllGather");
  const PetscInt* found = nullptr;
  check(ISGetIndices(all.get(), &found), "ISGetIndices");
  std::copy(found, found + cells, owner.begin());
  check(ISRestoreIndices(all.get(), &found), "ISRestoreIndices");
  return owner;
}

}  // namespace tunica::full3d
