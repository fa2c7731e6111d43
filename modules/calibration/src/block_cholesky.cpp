// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block_cholesky.h"

#include <algorithm>
#include <numeric>

#include <Eigen/OrderingMethods>

#include <pcl_als/adjustment/dense_products.h>
#include <pcl_als/common/parallel.h>

namespace pcl_als {
namespace {

constexpr int kBlock = BlockColumns::kBlock;
using Block = Eigen::Matrix<double, kBlock, kBlock>;
using Sparse = Eigen::SparseMatrix<double>;

/// Neighbours of every block, itself included, increasing.
std::vector<std::vector<int>> neighboursOf(const KnotBlocks& blocks, const Sparse& prior) {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(prior.rows() / kBlock));
  for (const auto& [knots, block] : blocks) {
    neighbours[static_cast<std::size_t>(knots.first)].push_back(knots.second);
    neighbours[static_cast<std::size_t>(knots.second)].push_back(knots.first);
  }
  for (int column = 0; column < prior.cols();
       column += kBlock) {  // the others have the same blocks
    for (Sparse::InnerIterator entry(prior, column); entry; ++entry)
      neighbours[static_cast<std::size_t>(entry.row() / kBlock)].push_back(column / kBlock);
  }
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

/// Places of the blocks in an order of approximate minimum degree.
std::vector<int> minimumDegree(const std::vector<std::vector<int>>& neighbours) {
  const auto size = static_cast<int>(neighbours.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) {
    for (const int j : neighbours[static_cast<std::size_t>(i)]) entries.emplace_back(i, j, 1.0);
  }
  Sparse graph(size, size);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  std::vector<int> place(neighbours.size());
  for (int i = 0; i < size; ++i) place[static_cast<std::size_t>(order.indices()[i])] = i;
  return place;
}

/// Block rows below the diagonal of the columns of the factor, by place.
std::vector<std::vector<int>> factorRows(const std::vector<std::vector<int>>& neighbours,
                                         const std::vector<int>& place) {
  std::vector<std::vector<int>> rows(place.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    for (const int j : neighbours[i]) {
      const int below = place[static_cast<std::size_t>(j)];
      if (below > place[i]) rows[static_cast<std::size_t>(place[i])].push_back(below);
    }
  }
  for (auto& own : rows) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (own.empty()) continue;
    // Elimination of a column couples its rows: the first of them inherits the others.
    std::vector<int>& next = rows[static_cast<std::size_t>(own.front())];
    next.insert(next.end(), own.begin() + 1, own.end());
  }
  return rows;
}

/// New places that follow the elimination tree in postorder, so that supernodes are successive.
std::vector<int> postorder(const std::vector<std::vector<int>>& rows) {
  const auto size = rows.size();
  std::vector<std::vector<std::size_t>> children(size + 1);
  for (std::size_t i = 0; i < size; ++i)
    children[rows[i].empty() ? size : static_cast<std::size_t>(rows[i].front())].push_back(i);
  std::vector<int> place(size);
  int next = 0;
  std::vector<std::pair<std::size_t, std::size_t>> path{{size, 0}};  // node, its next child
  while (!path.empty()) {
    auto& [node, child] = path.back();
    if (child < children[node].size()) {
      path.emplace_back(children[node][child++], 0);
      continue;
    }
    if (node < size) place[node] = next++;
    path.pop_back();
  }
  return place;
}

}  // namespace

Eigen::Index BlockColumns::Supernode::rowOf(int block) const {
  if (block < first) return -1;
  if (block < first + count) return Eigen::Index{kBlock} * (block - first);
  const auto at = std::lower_bound(rows.begin(), rows.end(), block);
  if (at == rows.end() || *at != block) return -1;
  return width() + kBlock * (at - rows.begin());
}

BlockColumns::BlockColumns(const KnotBlocks& blocks, const Sparse& prior) {
  const auto neighbours = neighboursOf(blocks, prior);
  place = minimumDegree(neighbours);
  const std::vector<int> post = postorder(factorRows(neighbours, place));
  for (int& at : place) at = post[static_cast<std::size_t>(at)];
  form(factorRows(neighbours, place));
}

void BlockColumns::form(const std::vector<std::vector<int>>& rows) {
  owner.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int column = static_cast<int>(i);
    const bool joins = i > 0 && !rows[i - 1].empty() && rows[i - 1].front() == column &&
                       rows[i - 1].size() == rows[i].size() + 1;
    if (!joins) {
      supernodes.emplace_back();
      supernodes.back().first = column;
    }
    ++supernodes.back().count;
    supernodes.back().rows = rows[i];
    owner[i] = static_cast<int>(supernodes.size()) - 1;
  }
  for (Supernode& node : supernodes) node.panel.setZero(node.width() + node.height(), node.width());
}

template <class Visit>
void BlockColumns::visitPairs(const Supernode& from, const Visit& visit) {
  std::vector<Eigen::Index> at(from.rows.size());
  for (std::size_t column = 0; column < from.rows.size(); ++column) {
    const int block = from.rows[column];
    Supernode& to = supernodes[static_cast<std::size_t>(owner[static_cast<std::size_t>(block)])];
    if (column == 0 || from.rows[column - 1] < to.first) {
      for (std::size_t row = column; row < from.rows.size(); ++row)
        at[row] = to.rowOf(from.rows[row]);
    }
    const Eigen::Index from_column = Eigen::Index{kBlock} * (block - to.first);
    for (std::size_t row = column; row < from.rows.size(); ++row)
      visit(static_cast<Eigen::Index>(row) * kBlock, static_cast<Eigen::Index>(column) * kBlock,
            to.panel.block<kBlock, kBlock>(at[row], from_column));
  }
}

double InverseEntries::operator()(Eigen::Index row, Eigen::Index column) const {
  int a = columns_.place[static_cast<std::size_t>(row / kBlock)];
  int b = columns_.place[static_cast<std::size_t>(column / kBlock)];
  Eigen::Index in_a = row % kBlock, in_b = column % kBlock;
  if (a < b) std::swap(a, b), std::swap(in_a, in_b);
  const auto& node =
      columns_.supernodes[static_cast<std::size_t>(columns_.owner[static_cast<std::size_t>(b)])];
  const Eigen::Index at = node.rowOf(a);
  return at < 0 ? 0.0 : node.panel(at + in_a, Eigen::Index{kBlock} * (b - node.first) + in_b);
}

Block InverseEntries::block(int row, int column) const {
  const int a = columns_.place[static_cast<std::size_t>(row)];
  const int b = columns_.place[static_cast<std::size_t>(column)];
  if (a < b) return block(column, row).transpose();
  const auto& node =
      columns_.supernodes[static_cast<std::size_t>(columns_.owner[static_cast<std::size_t>(b)])];
  const Eigen::Index at = node.rowOf(a);
  if (at < 0) return Block::Zero();
  return node.panel.block<kBlock, kBlock>(at, Eigen::Index{kBlock} * (b - node.first));
}

double InverseEntries::traceOfProduct(const Sparse& matrix) const {
  double trace = 0.0;
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
      trace += entry.value() * (*this)(entry.row(), column);
  }
  return trace;
}

double InverseEntries::traceOfProduct(const KnotBlocks& blocks) const {
  double trace = 0.0;
  for (const auto& [knots, block] : blocks) {
    const int first = columns_.place[static_cast<std::size_t>(knots.first)];
    const int second = columns_.place[static_cast<std::size_t>(knots.second)];
    const int a = std::max(first, second), b = std::min(first, second);
    const auto& node =
        columns_.supernodes[static_cast<std::size_t>(columns_.owner[static_cast<std::size_t>(b)])];
    const auto entries =
        node.panel.block<kBlock, kBlock>(node.rowOf(a), Eigen::Index{kBlock} * (b - node.first));
    const double sum = first >= second ? block.cwiseProduct(entries).sum()
                                       : block.cwiseProduct(entries.transpose()).sum();
    trace += a == b ? sum : 2.0 * sum;
  }
  return trace;
}

BlockCholesky::BlockCholesky(const KnotBlocks& blocks, const Sparse& prior)
    : columns_(blocks, prior) {
  assemble(blocks, prior);
  factorise();
}

void BlockCholesky::assemble(const KnotBlocks& blocks, const Sparse& prior) {
  const auto panelOf = [this](int column) -> BlockColumns::Supernode& {
    return columns_
        .supernodes[static_cast<std::size_t>(columns_.owner[static_cast<std::size_t>(column)])];
  };
  for (const auto& [knots, block] : blocks) {
    const int first = columns_.place[static_cast<std::size_t>(knots.first)];
    const int second = columns_.place[static_cast<std::size_t>(knots.second)];
    const int a = std::max(first, second), b = std::min(first, second);
    BlockColumns::Supernode& node = panelOf(b);
    auto entries =
        node.panel.block<kBlock, kBlock>(node.rowOf(a), Eigen::Index{kBlock} * (b - node.first));
    if (first >= second)
      entries += block;
    else
      entries += block.transpose();
  }
  for (int column = 0; column < prior.cols(); ++column) {
    const int b = columns_.place[static_cast<std::size_t>(column / kBlock)];
    BlockColumns::Supernode& node = panelOf(b);
    for (Sparse::InnerIterator entry(prior, column); entry; ++entry) {
      const int a = columns_.place[static_cast<std::size_t>(entry.row() / kBlock)];
      if (a >= b)
        node.panel(node.rowOf(a) + entry.row() % kBlock,
                   Eigen::Index{kBlock} * (b - node.first) + column % kBlock) += entry.value();
    }
  }
}

void BlockCholesky::factorise() {
  for (BlockColumns::Supernode& node : columns_.supernodes) {
    const auto own = node.panel.topRows(node.width());
    dense::factorise(own);
    if (node.rows.empty()) continue;
    const auto below = node.panel.bottomRows(node.height());
    dense::solveLowerFromRight(own, below);
    Eigen::MatrixXd update = Eigen::MatrixXd::Zero(node.height(), node.height());
    dense::addSquare(below, update);
    columns_.visitPairs(node, [&](Eigen::Index row, Eigen::Index column, auto block) {
      block -= update.block<kBlock, kBlock>(row, column);
    });
  }
}

Eigen::MatrixXd BlockCholesky::solve(const Eigen::MatrixXd& right) const {
  const auto blocks = columns_.place.size();
  Eigen::MatrixXd x(right.rows(), right.cols());
  for (std::size_t i = 0; i < blocks; ++i)
    x.middleRows<kBlock>(Eigen::Index{kBlock} * columns_.place[i]) =
        right.middleRows<kBlock>(static_cast<Eigen::Index>(i) * kBlock);
  for (const auto& node : columns_.supernodes) {
    auto own = x.middleRows(Eigen::Index{kBlock} * node.first, node.width());
    node.panel.topRows(node.width()).triangularView<Eigen::Lower>().solveInPlace(own);
    const Eigen::MatrixXd change = node.panel.bottomRows(node.height()) * own;
    for (std::size_t i = 0; i < node.rows.size(); ++i)
      x.middleRows<kBlock>(Eigen::Index{kBlock} * node.rows[i]) -=
          change.middleRows<kBlock>(static_cast<Eigen::Index>(i) * kBlock);
  }
  for (auto node = columns_.supernodes.rbegin(); node != columns_.supernodes.rend(); ++node) {
    Eigen::MatrixXd below(node->height(), right.cols());
    for (std::size_t i = 0; i < node->rows.size(); ++i)
      below.middleRows<kBlock>(static_cast<Eigen::Index>(i) * kBlock) =
          x.middleRows<kBlock>(Eigen::Index{kBlock} * node->rows[i]);
    auto own = x.middleRows(Eigen::Index{kBlock} * node->first, node->width());
    own -= node->panel.bottomRows(node->height()).transpose() * below;
    node->panel.topRows(node->width()).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  Eigen::MatrixXd solution(right.rows(), right.cols());
  for (std::size_t i = 0; i < blocks; ++i)
    solution.middleRows<kBlock>(static_cast<Eigen::Index>(i) * kBlock) =
        x.middleRows<kBlock>(Eigen::Index{kBlock} * columns_.place[i]);
  return solution;
}

double BlockCholesky::logDeterminant() const {
  double sum = 0.0;
  for (const auto& node : columns_.supernodes)
    sum += 2.0 * node.panel.diagonal().array().log().sum();
  return sum;
}

namespace {

/// Calls \a body with the first column and the number of columns of every part of a matrix. The
/// parts do not depend on the number of threads, as the rounding of products may depend on sizes.
template <class Body>
void forColumns(Eigen::Index columns, int threads, const Body& body) {
  constexpr Eigen::Index kPart = 64;
  const auto parts = static_cast<std::size_t>((columns + kPart - 1) / kPart);
  const auto call = [&](std::size_t part) {
    const Eigen::Index first = static_cast<Eigen::Index>(part) * kPart;
    body(first, std::min(kPart, columns - first));
  };
  if (parts == 1)
    call(0);
  else
    parallelFor(parts, threads, call);
}

/// The inverse of a lower triangular matrix.
Eigen::MatrixXd lowerInverse(const Eigen::Ref<const Eigen::MatrixXd>& lower, int threads) {
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(lower.rows(), lower.cols());
  forColumns(lower.cols(), threads, [&](Eigen::Index first, Eigen::Index count) {
    const Eigen::Index rest = lower.rows() - first;
    dense::solveLower(lower.bottomRightCorner(rest, rest),
                      inverse.block(first, first, rest, count));
  });
  return inverse;
}

}  // namespace

InverseEntries BlockCholesky::inverse(int threads) const {
  // With the part W of the inverse that belongs to the rows below a supernode, and its columns
  // (D, B) of the factor, Y = B D^-1, the inverse's columns are ((D D')^-1 + Y' W Y, -W Y).
  BlockColumns inverse = columns_;
  for (auto node = inverse.supernodes.rbegin(); node != inverse.supernodes.rend(); ++node) {
    const Eigen::Index width = node->width(), height = node->height();
    Eigen::MatrixXd known(height, height);
    inverse.visitPairs(*node, [&](Eigen::Index row, Eigen::Index column, auto block) {
      known.block<kBlock, kBlock>(row, column) = block;
      if (row > column) known.block<kBlock, kBlock>(column, row) = block.transpose();
    });
    const Eigen::MatrixXd own = lowerInverse(node->panel.topRows(width), threads);
    Eigen::MatrixXd ratio(height, width), product(height, width);
    forColumns(width, threads, [&](Eigen::Index first, Eigen::Index count) {
      const Eigen::Index rest = width - first;  // the inverse of D is a lower triangular matrix
      dense::multiply(node->panel.bottomRightCorner(height, rest),
                      own.block(first, first, rest, count), ratio.middleCols(first, count));
      dense::multiply(known, ratio.middleCols(first, count), product.middleCols(first, count));
    });
    forColumns(width, threads, [&](Eigen::Index first, Eigen::Index count) {
      const Eigen::Index rest = width - first;
      auto part = node->panel.block(first, first, rest, count);
      part.setZero();
      dense::addTransposedProduct(own.bottomRightCorner(rest, rest),
                                  own.block(first, first, rest, count), part);
      dense::addTransposedProduct(ratio.rightCols(rest), product.middleCols(first, count), part);
    });
    auto top = node->panel.topRows(width);
    top.triangularView<Eigen::StrictlyUpper>() = top.transpose();
    node->panel.bottomRows(height) = -product;
  }
  return InverseEntries(std::move(inverse));
}

}  // namespace pcl_als
