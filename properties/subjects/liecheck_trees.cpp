#include <subjects/liecheck_tree.hpp>
#include <subjects/liecheck_trees.hpp>

namespace liecheck::properties {

template <class S>
TreeOperations<S> liecheck_tree(const Tree<S>& tree) {
  return LiecheckTree<S>::bind(tree);
}
template <class S>
Model<S> liecheck_model(const Tree<S>& tree) {
  return LiecheckTree<S>::model(tree);
}
template Model<float> liecheck_model(const Tree<float>&);
template Model<double> liecheck_model(const Tree<double>&);
template TreeOperations<float> liecheck_tree(const Tree<float>&);
template TreeOperations<double> liecheck_tree(const Tree<double>&);

}  // namespace liecheck::properties
